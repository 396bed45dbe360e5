#include "model/effects/effect.h"

namespace howl {

std::string_view LoopBlockName(LoopBlock block) {
  switch (block) {
    case LoopBlock::kAcoustics:
      return "acoustics";
    case LoopBlock::kFlame:
      return "flame";
    case LoopBlock::kDelay:
      return "delay";
    case LoopBlock::kSource:
      return "source";
    case LoopBlock::kPressureInstrument:
      return "p_instrument";
    case LoopBlock::kHeatReleaseInstrument:
      return "q_instrument";
    case LoopBlock::kOperatingPoint:
      break;
  }
  return "operating_point";
}

std::vector<double> NullValues(const Effect& effect) {
  std::vector<double> values;
  for (const EffectParameter& parameter : effect.parameters()) {
    values.push_back(parameter.null_value);
  }
  return values;
}

}  // namespace howl

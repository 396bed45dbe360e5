#include "estimation/joint_records/loop_names.h"

#include <sstream>

namespace howl {

const char* FlameInputName(FlameInput input) {
  switch (input) {
    case FlameInput::kPressureRate:
      return "pressure_rate";
    case FlameInput::kPressure:
      return "pressure";
    case FlameInput::kVelocity:
      break;
  }
  return "velocity";
}

const char* DelaySpreadName(DelaySpread spread) {
  switch (spread) {
    case DelaySpread::kNone:
      return "none";
    case DelaySpread::kNormal:
      return "normal";
    case DelaySpread::kGamma:
      break;
  }
  return "gamma";
}

PointStructure AsStated(PointStructure structure) {
  if (structure.further_modes > 0) structure.ratio.reset();
  if (structure.further_modes > 0 || structure.modes == 1) structure.own_damping = true;
  structure.further_modes = 0;
  return structure;
}

std::string ModelLine(const PointStructure& of, FlameInput input) {
  const PointStructure structure = AsStated(of);
  std::ostringstream out;
  out << "model: {modes: " << structure.modes << ", ratio: ";
  if (structure.ratio) {
    out << *structure.ratio;
  } else {
    out << "free";
  }
  out << ", damping: " << (structure.own_damping ? "own" : "shared")
      << ", residue: " << (structure.complex_residues ? "complex" : "real")
      << ", flame_input: " << FlameInputName(input)
      << ", delay_spread: " << DelaySpreadName(structure.delay_spread)
      << ", delay_paths: " << (structure.second_path ? 2 : 1) << "}";
  return out.str();
}

}  // namespace howl

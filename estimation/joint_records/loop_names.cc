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

std::string ModelLine(const PointStructure& structure, FlameInput input) {
  std::ostringstream out;
  out << "model: {modes: " << structure.modes << ", ratio: ";
  // A config has no modes that are tied beside others that are not.
  const bool free = structure.further_modes > 0;
  if (structure.ratio && !free) {
    out << *structure.ratio;
  } else {
    out << "free";
  }
  out << ", damping: " << (structure.own_damping || free ? "own" : "shared")
      << ", residue: " << (structure.complex_residues ? "complex" : "real")
      << ", flame_input: " << FlameInputName(input)
      << ", delay_spread: " << DelaySpreadName(structure.delay_spread)
      << ", delay_paths: " << (structure.second_path ? 2 : 1) << "}";
  return out.str();
}

}  // namespace howl

// Which loop is fitted to records: the acoustics' modes, and what the flame answers to.
#ifndef HOWL_ESTIMATION_JOINT_RECORDS_RECORD_LOOP_SPEC_H_
#define HOWL_ESTIMATION_JOINT_RECORDS_RECORD_LOOP_SPEC_H_

#include <optional>

#include "estimation/record_fit/loop/loop_point.h"
#include "estimation/record_fit/spectra/record_spectra.h"

namespace howl {

inline constexpr int kMostModes = 8;

struct RecordLoopSpec {
  int modes = 2;
  bool choose_modes = false;    // by what the data say of 1 .. kMostModes
  std::optional<double> ratio;  // as in PointStructure
  bool own_damping = true;
  bool complex_residues = true;
  FlameInput flame_input = FlameInput::kPressureRate;
  bool choose_flame_input = false;  // by what the data say of the three
  DelaySpread delay_spread = DelaySpread::kNone;
  bool second_path = false;
  bool line_errors = true;  // loop_point.h
};

// Noise is that of rigs: combustion's, the duct's, both sensors' and a background that both
// channels show, with smooth spectra of their own.
PointStructure StructureOf(const RecordLoopSpec& spec, int modes);

}  // namespace howl

#endif  // HOWL_ESTIMATION_JOINT_RECORDS_RECORD_LOOP_SPEC_H_

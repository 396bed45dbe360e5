#include "estimation/joint_records/record_loop_spec.h"

namespace howl {
namespace {

// Coefficients of ln S over the band of five octaves: about one an octave for noise that turbulence
// shapes, fewer for what electronics adds. bench/joint_records_study compares them.
constexpr Eigen::Index kOfTurbulence = 6;
constexpr Eigen::Index kOfSensors = 4;

}  // namespace

PointStructure StructureOf(const RecordLoopSpec& spec, int modes) {
  PointStructure out;
  out.modes = modes;
  out.ratio = spec.ratio;
  out.own_damping = spec.own_damping;
  out.complex_residues = spec.complex_residues;
  out.delay_spread = spec.delay_spread;
  out.second_path = spec.second_path;
  if (spec.line_errors) out.acoustic_lines = out.flame_lines = kCycleLines;
  out.noise = {{LoopNoise::kCombustion, kOfTurbulence},
               {LoopNoise::kPressureSensor, kOfSensors},
               {LoopNoise::kHeatReleaseSensor, kOfSensors},
               {LoopNoise::kDuct, kOfTurbulence},
               {LoopNoise::kBackground, kOfSensors}};
  return out;
}

}  // namespace howl

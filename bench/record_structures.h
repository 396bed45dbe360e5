// The structures of a loop that studies of measured records compare, each with the one before in
// it.
#ifndef HOWL_BENCH_RECORD_STRUCTURES_H_
#define HOWL_BENCH_RECORD_STRUCTURES_H_

#include <string>
#include <vector>

#include "estimation/record_fit/loop/loop_point.h"

namespace howl {

struct NamedStructure {
  std::string name;
  PointStructure structure;
};

inline std::vector<NoiseTerm> RecordNoise(Eigen::Index combustion, Eigen::Index sensors,
                                          Eigen::Index duct, Eigen::Index background = 0) {
  std::vector<NoiseTerm> out = {{LoopNoise::kCombustion, combustion},
                                {LoopNoise::kPressureSensor, sensors},
                                {LoopNoise::kHeatReleaseSensor, sensors}};
  if (duct > 0) out.push_back({LoopNoise::kDuct, duct});
  if (background > 0) out.push_back({LoopNoise::kBackground, background});
  return out;
}

inline std::vector<NamedStructure> RecordStructures() {
  PointStructure loop;
  loop.modes = 2;
  loop.ratio = 3.0;
  loop.own_damping = false;
  loop.complex_residues = false;
  loop.noise = RecordNoise(6, 1, 0);
  std::vector<NamedStructure> out = {{"the paper's loop", loop}};
  loop.noise = RecordNoise(6, 4, 0);
  out.push_back({"coloured sensors", loop});
  loop.noise = RecordNoise(6, 4, 0, 4);
  out.push_back({"background", loop});
  loop.noise = RecordNoise(6, 4, 6, 4);
  out.push_back({"duct's noise", loop});
  loop.ratio.reset();
  loop.own_damping = true;
  out.push_back({"free modes", loop});
  loop.complex_residues = true;
  out.push_back({"complex residues", loop});
  loop.flame_lines = kCycleLines;
  out.push_back({"flame's lines", loop});
  loop.acoustic_lines = kCycleLines;
  out.push_back({"acoustics' lines", loop});
  loop.delay_spread = DelaySpread::kGamma;
  out.push_back({"spread delays", loop});
  loop.second_path = true;
  out.push_back({"two paths", loop});
  loop.modes = 3;
  out.push_back({"three modes", loop});
  loop.modes = 4;
  out.push_back({"four modes", loop});
  loop.noise = RecordNoise(12, 8, 12, 8);
  out.push_back({"finer noise", loop});
  return out;
}

}  // namespace howl

#endif  // HOWL_BENCH_RECORD_STRUCTURES_H_

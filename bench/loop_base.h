// From where studies of the loops' budget begin: a config's records, and its loop.
#ifndef HOWL_BENCH_LOOP_BASE_H_
#define HOWL_BENCH_LOOP_BASE_H_

#include <vector>

#include "bench/measured_rig.h"
#include "diagnosis/cuts/make_cut_records.h"
#include "diagnosis/loop_budget/loop_records.h"
#include "estimation/joint_records/record_loop_spec.h"
#include "io/config/reading/config_reading.h"

namespace howl {

inline LoopForm PaperBase() {
  RecordLoopSpec spec;
  spec.ratio = 3.0;
  spec.own_damping = false;
  spec.complex_residues = false;
  return LeastForm(spec);
}

// The loop of the config's model, or the paper's where it states no other.
inline LoopForm LoopBaseOf(const Config& config) {
  return config.record_loop ? LeastForm(*config.record_loop) : PaperBase();
}

inline std::vector<LoopRecord> LoopRecordsOf(const MeasuredRig& rig) {
  const std::vector<CutRecord> cuts = MakeCutRecords(rig);
  std::vector<LoopRecord> out;
  for (std::size_t e = 0; e < rig.size(); ++e) {
    out.push_back({rig[e].name, rig[e].phi, cuts[e].at.cycle_frequency_hz, rig[e].record});
  }
  return out;
}

}  // namespace howl

#endif  // HOWL_BENCH_LOOP_BASE_H_

// The records of a rig as diagnoses of loops take them.
#ifndef HOWL_BENCH_RIG_LOOP_RECORDS_H_
#define HOWL_BENCH_RIG_LOOP_RECORDS_H_

#include <cstddef>
#include <vector>

#include "diagnosis/cuts/make_cut_records.h"
#include "estimation/joint_records/loop_record.h"

namespace howl {

// With the cycle's frequency of each record. Nothing keeps them from being cut
// (make_cut_records.h).
inline std::vector<LoopRecord> LoopRecordsOf(const std::vector<DiagnosisExperiment>& experiments) {
  const std::vector<CutRecord> cuts = MakeCutRecords(experiments);
  std::vector<LoopRecord> out;
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    out.push_back({experiments[e].name, experiments[e].phi, cuts[e].at.cycle_frequency_hz,
                   experiments[e].record});
  }
  return out;
}

}  // namespace howl

#endif  // HOWL_BENCH_RIG_LOOP_RECORDS_H_

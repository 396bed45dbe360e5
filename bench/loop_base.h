// From where studies of the loops' budget begin: a config's loop.
#ifndef HOWL_BENCH_LOOP_BASE_H_
#define HOWL_BENCH_LOOP_BASE_H_

#include "diagnosis/loop_budget/forms/loop_form.h"
#include "estimation/joint_records/record_loop_spec.h"
#include "io/config/reading/config_reading.h"

namespace howl {

// The loop of the config's model, or the paper's where it states no other.
inline LoopForm LoopBaseOf(const Config& config) {
  return config.record_loop ? LeastForm(*config.record_loop) : PapersForm();
}

}  // namespace howl

#endif  // HOWL_BENCH_LOOP_BASE_H_

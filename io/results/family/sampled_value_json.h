// A value that a family's members have, as JSON: null where none has one.
#ifndef HOWL_IO_RESULTS_FAMILY_SAMPLED_VALUE_JSON_H_
#define HOWL_IO_RESULTS_FAMILY_SAMPLED_VALUE_JSON_H_

#include <cmath>
#include <nlohmann/json.hpp>

#include "estimation/family/answers/predict/predict_points.h"

namespace howl {

inline nlohmann::ordered_json NumberOrNull(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

inline nlohmann::ordered_json SampledValueJson(const SampledValue& value) {
  return {{"value", NumberOrNull(value.median)},
          {"lo", NumberOrNull(value.lo)},
          {"hi", NumberOrNull(value.hi)}};
}

}  // namespace howl

#endif  // HOWL_IO_RESULTS_FAMILY_SAMPLED_VALUE_JSON_H_

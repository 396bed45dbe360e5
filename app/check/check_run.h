// The findings of `howl check` before they are printed and written. There is no fit or search in
// it, and nothing random.
#ifndef HOWL_APP_CHECK_CHECK_RUN_H_
#define HOWL_APP_CHECK_CHECK_RUN_H_

#include <cstddef>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/command_line/options.h"
#include "estimation/health/finding.h"
#include "io/user_error.h"

namespace howl {

// A command, and what it can do with this config.
struct Ability {
  std::string command;
  bool possible = false;
  std::string text;                // what it does, or why it cannot
  nlohmann::ordered_json details;  // of fit and family: residuals, parameters, conditions
};

struct CheckedExperiment {
  std::string name;
  double phi = std::numeric_limits<double>::quiet_NaN();  // NaN: still to be filled in
  bool has_record = false;
  bool has_heat_release = false;
  std::size_t samples = 0;
  double sampling_hz = 0.0;
  double duration_s = 0.0;
  std::string state;  // as in characteristics.csv; empty without a record
  double frequency_hz = std::numeric_limits<double>::quiet_NaN();
};

struct CheckReport {
  std::string config;
  std::string operating_parameter = "phi";
  std::size_t experiments = 0;  // in the config; those with an error are not among `rows`
  std::vector<UserError> errors;
  Health warnings;
  std::vector<CheckedExperiment> rows;
  std::vector<Ability> abilities;  // empty where the config has nothing left to judge
};

CheckReport RunCheck(const Options& options);

}  // namespace howl

#endif  // HOWL_APP_CHECK_CHECK_RUN_H_

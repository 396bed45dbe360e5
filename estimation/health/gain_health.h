// Finds experiments whose gains |p| / |q| are in different units, as where one record of p is in Pa
// and the others are in kPa. A fit cannot find them: N of each experiment takes the factor up.
//
// Units differ by a factor of 1000. Sorted, two gains next to one another are nearer to such a
// factor than to none where their ratio exceeds sqrt(1000).
#ifndef HOWL_ESTIMATION_HEALTH_GAIN_HEALTH_H_
#define HOWL_ESTIMATION_HEALTH_GAIN_HEALTH_H_

#include <string>
#include <vector>

#include "estimation/analysis/loop/experiment.h"
#include "estimation/health/finding.h"

namespace howl {

struct NamedGain {
  std::string name;
  double gain = 0.0;  // not finite or not positive: not looked at
};

// The least of the two groups between which the largest ratio lies is named; of equal ones, the
// group of larger gains.
Health CheckGains(std::vector<NamedGain> gains);

// Of a table.
Health CheckGains(const std::vector<Experiment>& experiments);

}  // namespace howl

#endif  // HOWL_ESTIMATION_HEALTH_GAIN_HEALTH_H_

// What each of a point's parameters (loop_point.h) is, so that those of one structure are found
// again in another.
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_FORMS_PARAMETER_LABELS_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_FORMS_PARAMETER_LABELS_H_

#include <string>
#include <vector>

#include "estimation/record_fit/loop/loop_point.h"
#include "estimation/record_fit/loop/point_prior.h"

namespace howl {

// `flame`: how many coefficients the flame has.
std::vector<std::string> ParameterLabels(const PointStructure& structure, Eigen::Index flame);

// `prior`, with the means and deviations that `known` has of the same parameters.
PointPrior WithKnown(PointPrior prior, const std::vector<std::string>& labels,
                     const PointPrior& known, const std::vector<std::string>& known_labels);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_FORMS_PARAMETER_LABELS_H_

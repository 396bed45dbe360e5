// d quantity / d coordinates (estimation/family/local/local_coordinates.h) by central differences;
// one experiment is rebuilt at a time, so that only the experiments that it depends on cost time.
#ifndef HOWL_ESTIMATION_FAMILY_LOCAL_QUANTITY_GRADIENT_H_
#define HOWL_ESTIMATION_FAMILY_LOCAL_QUANTITY_GRADIENT_H_

#include <Eigen/Core>

#include "estimation/family/local/local_coordinates.h"
#include "estimation/family/local/local_state.h"
#include "estimation/family/problem/member_quantity.h"

namespace howl {

// False where the state or a neighbour is no model, or the result is not finite.
bool QuantityGradient(const LocalCoordinates& c, const LocalState& state,
                      const MemberQuantity& quantity, double& value, Eigen::VectorXd& gradient);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_LOCAL_QUANTITY_GRADIENT_H_

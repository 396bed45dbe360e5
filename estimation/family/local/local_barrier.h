// The interior-point search: along the central path t -> infinity of
//
//   t s - sum ln(slack) - sum ln(room in a coordinate's box)                    with has_s, or
//   -t sign quantity / scale - sum ln(slack) - sum ln(room)                     without,
//
// by Newton steps with Gauss-Newton curvature of the rows
// (estimation/family/local/local_conditions.h) and halved steps, so that every iterate keeps the
// rows and boxes strictly. With has_s a quantity may be pinned: it is then driven to the value
// `at`.
#ifndef HOWL_ESTIMATION_FAMILY_LOCAL_LOCAL_BARRIER_H_
#define HOWL_ESTIMATION_FAMILY_LOCAL_LOCAL_BARRIER_H_

#include <limits>

#include "estimation/family/local/local_conditions.h"
#include "estimation/family/local/local_coordinates.h"
#include "estimation/family/local/local_state.h"
#include "estimation/family/problem/member_quantity.h"

namespace howl {

struct BarrierTask {
  SoftConditions soft;
  bool has_s = false;                                        // minimise s; else the quantity counts
  double enough = -std::numeric_limits<double>::infinity();  // s at which to stop
  const MemberQuantity* quantity = nullptr;
  double sign = 1.0;   // of the quantity that is maximised
  double scale = 1.0;  // of the quantity
  bool pinned = false;
  double at = 0.0;
};

// Moves `state`, which must keep the rows, to where the task ends. False where the state is not
// inside, or a step cannot be taken; `state` is then the last iterate.
bool FollowCentralPath(const LocalCoordinates& coordinates, const BarrierTask& task,
                       LocalState& state);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_LOCAL_LOCAL_BARRIER_H_

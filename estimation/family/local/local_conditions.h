// The conditions of a local search as rows, with slopes in its coordinates
// (estimation/family/local/local_coordinates.h):
//
//   slack = weight s + value > 0,
//
// where a soft condition has weight 1 and the value minus its violation (error over tolerance), so
// that s bounds the violations; a hard one has weight 0 and the value 1 minus its violation.
#ifndef HOWL_ESTIMATION_FAMILY_LOCAL_LOCAL_CONDITIONS_H_
#define HOWL_ESTIMATION_FAMILY_LOCAL_LOCAL_CONDITIONS_H_

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "estimation/family/local/local_coordinates.h"
#include "estimation/family/local/local_state.h"

namespace howl {

inline constexpr std::size_t kMostSlopes = 2 * static_cast<std::size_t>(kLocals);

struct ConditionRow {
  double value = 0.0;
  double weight = 0.0;
  int count = 0;
  std::array<int, kMostSlopes> index{};
  std::array<double, kMostSlopes> slope{};
  // Of a transfer's distance, whose curvature is all that holds a step along the ellipsoid: minus
  // the second derivatives, over the coordinates of experiment `owner`.
  int owner = -1;
  Eigen::Matrix<double, kLocals, kLocals> curvature =
      Eigen::Matrix<double, kLocals, kLocals>::Zero();

  double Slack(double s) const { return weight * s + value; }
};

// The violations that are minimised; all other conditions are kept.
struct SoftConditions {
  ConditionSet conditions;
  bool domain = false;
};

// False where a state is no model; the roots are left in `state`.
bool ConditionRows(const LocalCoordinates& c, LocalState& state, const SoftConditions& soft,
                   std::vector<ConditionRow>* rows);

// The largest violation of the soft conditions, at least zero; infinite where the state is no
// model.
double LargestViolation(const LocalCoordinates& c, LocalState& state, const SoftConditions& soft);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_LOCAL_LOCAL_CONDITIONS_H_

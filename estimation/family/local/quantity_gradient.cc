#include "estimation/family/local/quantity_gradient.h"

#include <cmath>

namespace howl {

bool QuantityGradient(const LocalCoordinates& c, const LocalState& state,
                      const MemberQuantity& quantity, double& value, Eigen::VectorXd& gradient) {
  constexpr double kStep = 1e-6;
  gradient = Eigen::VectorXd::Zero(c.size);
  LocalState at = state;
  Member member;
  if (!MemberOf(c, at, member)) return false;
  value = quantity.value(member);
  if (!std::isfinite(value)) return false;
  for (const std::size_t i : quantity.experiments) {
    const LoopModel kept = member[i];
    for (std::size_t k = 0; k < kLocals; ++k) {
      const int column = c.index[i][k];
      if (column < 0) continue;
      double ends[2];
      for (const int side : {0, 1}) {
        LocalState moved = at;
        moved.local[i][k] += side == 0 ? -kStep : kStep;
        if (!ModelOf(c, i, moved, member[i])) return false;
        ends[side] = quantity.value(member);
      }
      member[i] = kept;
      gradient(column) += (ends[1] - ends[0]) / (2.0 * kStep);
    }
  }
  return gradient.allFinite();
}

}  // namespace howl

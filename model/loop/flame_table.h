// A flame's curve as a table, q against u = k v, v the delayed rate of change of pressure and k the
// slope at rest: monotone piecewise cubic between the points (F. N. Fritsch and R. E. Carlson, SIAM
// J. Numer. Anal. 17:238, 1980, with the slopes of F. N. Fritsch and J. Butland, SIAM J. Sci. Stat.
// Comput. 5:300, 1984: with d_i the rise per unit of u in an interval of width h_i,
//
//   m_i = d_(i-1) d_i / (w d_i + (1 - w) d_(i-1)),     w = (h_(i-1) + 2 h_i) / (3 (h_(i-1) + h_i))
//
// where both rise, else zero), and constant beyond them. It never overshoots its points, and its
// slope is continuous.
//
// As an effect (loop_effect.h) it makes of a linear flame, q = k v, the flame of the table.
#ifndef HOWL_MODEL_LOOP_FLAME_TABLE_H_
#define HOWL_MODEL_LOOP_FLAME_TABLE_H_

#include <memory>
#include <vector>

#include "model/loop/loop_effect.h"

namespace howl {

class FlameTable {
 public:
  // u rises; q does not fall. Two points at least.
  FlameTable(std::vector<double> u, std::vector<double> q);

  double Value(double u) const;
  double Slope(double u) const;
  double lowest() const { return q_.front(); }
  double highest() const { return q_.back(); }

 private:
  std::size_t IntervalOf(double u) const;

  std::vector<double> u_, q_, slope_;
};

// For a rig whose flame is FlameShape::kLinear.
std::shared_ptr<const LoopEffect> MakeTableEffect(FlameTable table);

}  // namespace howl

#endif  // HOWL_MODEL_LOOP_FLAME_TABLE_H_

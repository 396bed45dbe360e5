#include "estimation/joint_records/small_signal_loop.h"

#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>

#include "estimation/record_fit/loop/return_difference.h"

namespace howl {
namespace {

using C = std::complex<double>;

constexpr int kNewtonSteps = 60;
constexpr double kDifference = 1e-5;
constexpr double kRootFound = 1e-10;

struct Root {
  C s;
  double gain = 0.0;
};

class Loop {
 public:
  Loop(const RecordSpectra& record, const LoopPoint& point)
      : record_(record), point_(point), slope_(record.rest_slopes.dot(point.flame)) {}

  C At(C s) const { return slope_ * OpenLoop(record_, point_, s); }

  std::optional<Root> Find() const {
    C s(0.0, 1.0);
    for (int i = 0; i < kNewtonSteps; ++i) {
      const C value = At(s) - 1.0;
      const C rise = (At(s + kDifference) - At(s - kDifference)) / (2.0 * kDifference);
      C step = -value / rise;
      const double longest = 0.1;
      if (std::abs(step) > longest) step *= longest / std::abs(step);
      s += step;
      if (!std::isfinite(std::abs(s))) return std::nullopt;
      if (std::abs(step) > kRootFound) continue;
      // No logarithm of a root on the real axis is within it.
      if (!(std::abs(std::log2(s.imag())) <= 0.5)) return std::nullopt;
      return Root{s, std::abs(At(C(0.0, s.imag())))};
    }
    return std::nullopt;
  }

 private:
  const RecordSpectra& record_;
  const LoopPoint& point_;
  double slope_;
};

std::optional<std::array<double, 3>> Values(const RecordSpectra& record,
                                            const PointStructure& structure,
                                            const Eigen::VectorXd& parameters) {
  const LoopPoint point = ToPoint(structure, record.flame.cols(), parameters);
  const std::optional<Root> root = Loop(record, point).Find();
  if (!root) return std::nullopt;
  const double turn = 2.0 * std::numbers::pi * record.scale.cycle_hz;
  return {{root->s.imag() * record.scale.cycle_hz, root->s.real() * turn, root->gain}};
}

}  // namespace

SmallSignalLoop SmallSignalLoopOf(const RecordSpectra& record, const PointStructure& structure,
                                  const PointFit& fit) {
  SmallSignalLoop out;
  const std::optional<std::array<double, 3>> at = Values(record, structure, fit.parameters);
  if (!at) return out;
  const Eigen::MatrixXd covariance = fit.Covariance();
  Eigen::MatrixXd slopes(fit.parameters.size(), 3);
  for (Eigen::Index i = 0; i < fit.parameters.size(); ++i) {
    // A hundredth of a standard deviation: the values are linear over it.
    const double step = 0.01 * std::sqrt(covariance(i, i));
    Eigen::VectorXd moved = fit.parameters;
    moved[i] += step;
    const auto up = Values(record, structure, moved);
    moved[i] -= 2.0 * step;
    const auto down = Values(record, structure, moved);
    if (!up || !down) return out;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const auto j = static_cast<std::size_t>(k);
      slopes(i, k) = ((*up)[j] - (*down)[j]) / (2.0 * step);
    }
  }
  const auto std_of = [&](Eigen::Index k) {
    return std::sqrt(slopes.col(k).dot(covariance * slopes.col(k)));
  };
  out.frequency_hz = {(*at)[0], std_of(0)};
  out.growth_rate_1_s = {(*at)[1], std_of(1)};
  out.loop_gain = {(*at)[2], std_of(2)};
  out.found = true;
  return out;
}

}  // namespace howl

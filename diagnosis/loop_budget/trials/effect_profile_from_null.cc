// Where the search over two values begins of which the second tells nothing at the first's null.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "diagnosis/loop_budget/trials/effect_profile.h"

namespace howl {
namespace {

// The second parameter's values: of a delay that is later by two periods some twelve a period.
constexpr std::size_t kScanned = 26;
constexpr double kLongestBegin = 0.5;  // of the first parameter's range
// The first parameter's values far from the null, over its range.
constexpr double kFar = 0.25;
constexpr std::array<double, 2> kFurther = {0.5, 0.75};
constexpr double kLeastTau = 0.5;  // radians of the cycle

// The places of those that are better than both beside them, at most `count`, the best first.
std::vector<std::size_t> TopsOf(const std::vector<double>& row, std::size_t count) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < row.size(); ++i) {
    const bool is_top =
        (i == 0 || row[i] >= row[i - 1]) && (i + 1 == row.size() || row[i] > row[i + 1]);
    if (is_top) out.push_back(i);
  }
  std::ranges::stable_sort(out, std::ranges::greater(), [&](std::size_t i) { return row[i]; });
  out.resize(std::min(out.size(), count));
  return out;
}

}  // namespace

bool EffectProfile::HasFarFromNull() const {
  return span_.size() > 1 && std::isfinite(effect().parameters()[0].null_value);
}

Eigen::VectorXd EffectProfile::Far(double first, std::size_t second) const {
  const EffectParameter& parameter = effect().parameters()[1];
  const double low = FromSearch(parameter, low_[1]);
  const double way = static_cast<double>(second) / static_cast<double>(kScanned - 1);
  Eigen::VectorXd u = NullEnd();
  u[0] = std::min(u[0] + first * span_[0], high_[0]);
  // Evenly over the values themselves: maxima of a delay lie a period apart.
  u[1] = ToSearch(parameter, low + way * (FromSearch(parameter, high_[1]) - low));
  return u;
}

std::vector<EffectPoint> EffectProfile::BeginFromNull(const EffectPoint& null) {
  struct Beside {
    Eigen::VectorXd u;
    std::vector<Eigen::VectorXd> starts;
  };
  std::vector<Beside> tried(kScanned);
  std::vector<double> gains(kScanned, 0.0);
  for (std::size_t i = 0; i < kScanned; ++i) {
    EffectPoint at = null;
    at.u = Far(0.0, i);
    const std::vector<Slopes> slopes = SlopesAt(at, 1);
    double slope = 0.0;
    double curvature = 0.0;
    for (const Slopes& each : slopes) {
      slope += each.slope[0];
      curvature += each.curvature(0, 0);
    }
    if (!(curvature < 0.0)) continue;
    const double to = std::clamp(at.u[0] - slope / curvature, low_[0], high_[0]);
    const double step =
        std::clamp(to - at.u[0], -kLongestBegin * span_[0], kLongestBegin * span_[0]);
    gains[i] = step * (slope + 0.5 * step * curvature);
    tried[i].u = at.u;
    tried[i].u[0] += step;
    tried[i].starts = ParametersOf(null.fits);
    for (std::size_t e = 0; e < slopes.size(); ++e) {
      tried[i].starts[e] += step * slopes[e].by.col(0);
    }
  }
  std::vector<EffectPoint> out;
  for (const std::size_t i : TopsOf(gains, kMostFollowed)) {
    if (gains[i] > 0.0) out.push_back(At(tried[i].u, tried[i].starts));
  }
  if (out.empty()) out.push_back(null);
  return out;
}

std::vector<EffectPoint> EffectProfile::BeginFarFromNull(
    const std::vector<Eigen::VectorXd>& at_null) {
  std::vector<EffectPoint> best;
  for (const double half_period : {0.0, -std::numbers::pi, std::numbers::pi}) {
    const std::vector<Eigen::VectorXd> starts = Later(half_period, at_null);
    // Where all delays are too short for an earlier one its row would be the first once more, and
    // each top stand twice among the best.
    if (half_period != 0.0 && starts == at_null) continue;
    const EffectPoint there = At(NullEnd(), starts, kToCompare, RecordExtent::kMiddle);
    std::vector<EffectPoint> row;
    std::vector<double> posteriors;
    for (std::size_t i = 0; i < kScanned; ++i) {
      row.push_back(At(Far(kFar, i), ParametersOf(there.fits), kToCompare, RecordExtent::kMiddle));
      posteriors.push_back(row.back().log_posterior);
    }
    for (const std::size_t i : TopsOf(posteriors, kMostFollowed)) {
      best.push_back(Higher(std::move(row[i]), i));
    }
  }
  KeepBest(&best);
  return OnWholeRecords(best);
}

EffectPoint EffectProfile::Higher(EffectPoint top, std::size_t second) {
  for (const double far : kFurther) {
    const EffectPoint below = top;
    const std::size_t first = second == 0 ? 0 : second - 1;
    const std::size_t last = std::min(second + 1, kScanned - 1);
    for (std::size_t i = first; i <= last; ++i) {
      EffectPoint next =
          At(Far(far, i), ParametersOf(below.fits), kToCompare, RecordExtent::kMiddle);
      if (!(next.log_posterior > top.log_posterior)) continue;
      top = std::move(next);
      second = i;
    }
    if (top.u == below.u) break;
  }
  return top;
}

std::vector<Eigen::VectorXd> EffectProfile::Later(double radians,
                                                  std::vector<Eigen::VectorXd> starts) const {
  for (std::size_t e = 0; e < starts.size(); ++e) {
    double& log_tau = starts[e][form_.structure.Delay()];
    const double tau = std::exp(log_tau) + radians;
    if (radians == 0.0 || tau < kLeastTau) continue;
    log_tau = std::log(tau);
    const Eigen::Index terms = records_.FlameTerms(form_.flame_input, e);
    starts[e].segment(form_.structure.Flame(), terms) *= -1.0;
  }
  return starts;
}

}  // namespace howl

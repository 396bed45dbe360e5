#include "estimation/analysis/instruments/draw_clipped.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "estimation/analysis/instruments/autoregression.h"
#include "estimation/analysis/instruments/cycle_span.h"
#include "estimation/analysis/instruments/present_autocovariance.h"
#include "estimation/analysis/instruments/response_by_least_squares.h"
#include "model/noise/random_stream.h"

namespace howl {
namespace {

// The variance that so many draws tell errs by a quarter.
constexpr int kDrawsOfErrors = 16;
// Runs of lost samples are shorter than half a period, and forget how they began as soon.
constexpr int kSweeps = 30;
// Of e, from the ends of the range: beyond it lies one in 740.
constexpr double kInside = 3.0;
constexpr double kLeastNoise = 1e-9;  // of the range
// The first choice of times still knows e, the next ones do not.
constexpr int kChoices = 3;

std::vector<double> Less(std::vector<double> x, const std::vector<double>& y) {
  for (std::size_t t = 0; t < x.size(); ++t) x[t] -= y[t];
  return x;
}

// Normal with mean zero and variance one, given that it is at least `least`: an exponential that is
// thinned (Robert 1995).
double NormalFrom(double least, RandomStream* random) {
  if (least <= 0.0) {
    while (true) {
      const double z = random->Normal();
      if (z >= least) return z;
    }
  }
  const double rate = 0.5 * (least + std::sqrt(least * least + 4.0));
  while (true) {
    const double z = least - std::log1p(-random->Uniform()) / rate;
    if (random->Uniform() <= std::exp(-0.5 * (z - rate) * (z - rate))) return z;
  }
}

class ClippedDraws {
 public:
  ClippedDraws(const std::vector<double>& p, const std::vector<double>& q, const RangeEnds& ends,
               const CycleSpan& span)
      : p_(p), ends_(ends), span_(span) {
    for (std::size_t t = First(); t < End(); ++t) {
      if (IsLost(t)) lost_.push_back(t - First());
    }
    std::vector<double> told(p.size());
    std::vector<bool> used(p.size());
    double variance = 0.0;
    for (const bool second : {false, true}) AddHalf(second, q, &told, &used, &variance);
    told_ = Between(told);
    can_be_told_ = can_be_told_ && std::isfinite(variance);
    if (can_be_told_) process_.emplace(CovarianceOf(used, variance));
  }

  // Whether there are times enough that tell h.
  bool can_be_told() const { return can_be_told_; }

  std::size_t First() const { return span_.response.back; }
  std::size_t End() const { return p_.size() - span_.response.ahead; }
  double LostShare() const {
    return static_cast<double>(lost_.size()) / static_cast<double>(End() - First());
  }
  std::vector<double> Between(const std::vector<double>& x) const {
    return {x.begin() + static_cast<std::ptrdiff_t>(First()),
            x.begin() + static_cast<std::ptrdiff_t>(End())};
  }

  // From First() to End().
  std::vector<double> Draw(RandomStream* random) const {
    std::vector<double> drawn = Between(p_);
    std::vector<double> rest = Less(drawn, told_);
    for (const std::size_t i : lost_) rest[i] = Beyond(i, told_[i]) - told_[i];
    const double deviation = process_->deviation();
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      for (const std::size_t i : lost_) {
        const double mean = process_->GivenAllOthers(rest, i);
        const double side = IsAbove(i) ? 1.0 : -1.0;
        const double least = side * (EndAt(i) - told_[i] - mean) / deviation;
        rest[i] = mean + side * deviation * NormalFrom(least, random);
      }
    }
    for (const std::size_t i : lost_) drawn[i] = Beyond(i, told_[i] + rest[i]);
    return drawn;
  }

  // What an error of h makes of them: it is in what q tells, and what is left beside them of its
  // error takes back a part.
  std::vector<double> DrawError(RandomStream* random) const {
    const std::vector<double> noise = process_->Draw(p_.size(), random);
    std::vector<double> error(p_.size());
    for (const bool second : {false, true}) {
      CopyHalf(second, responses_[second ? 1 : 0].Predict(noise), &error);
    }
    error = Between(error);
    std::vector<double> rest = error;
    for (double& value : rest) value = -value;
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      for (const std::size_t i : lost_) rest[i] = process_->GivenAllOthers(rest, i);
    }
    std::vector<double> out(error.size(), 0.0);
    for (const std::size_t i : lost_) out[i] = error[i] + rest[i];
    return out;
  }

 private:
  bool IsLost(std::size_t t) const { return p_[t] <= ends_.lower || p_[t] >= ends_.upper; }
  // Of sample i between the ends.
  bool IsAbove(std::size_t i) const { return p_[First() + i] >= ends_.upper; }
  double EndAt(std::size_t i) const { return IsAbove(i) ? ends_.upper : ends_.lower; }
  double Beyond(std::size_t i, double value) const {
    return IsAbove(i) ? std::max(value, ends_.upper) : std::min(value, ends_.lower);
  }

  // As HalfOf has them, of what is between the ends.
  std::size_t Middle() const { return First() + (End() - First()) / 2; }
  bool IsIn(bool second, std::size_t t) const { return (t >= Middle()) == second; }
  template <typename Values>
  void CopyHalf(bool second, const Values& from, Values* to) const {
    for (std::size_t t = second ? Middle() : First(); t < (second ? End() : Middle()); ++t) {
      (*to)[t] = from[t];
    }
  }

  // Fits h to one half; of its times sets what q tells and which are in use, adds a half of the
  // variance of e.
  void AddHalf(bool second, const std::vector<double>& q, std::vector<double>* told,
               std::vector<bool>* used, double* variance) {
    std::vector<bool> used_here(p_.size());
    for (std::size_t t = 0; t < p_.size(); ++t) used_here[t] = IsIn(second, t) && !IsLost(t);
    ResponseByLeastSquares response(q, used_here, span_.response);
    std::vector<double> told_here = response.Predict(p_);
    const auto variance_here = [&] {
      double sum = 0.0;
      for (std::size_t t = First(); t < End(); ++t) {
        if (used_here[t]) sum += (p_[t] - told_here[t]) * (p_[t] - told_here[t]);
      }
      return sum / std::max(response.DegreesOfFreedom(), 1.0);
    };
    for (int choice = 1; choice < kChoices; ++choice) {
      const double reach = kInside * std::sqrt(variance_here());
      for (std::size_t t = 0; t < p_.size(); ++t) {
        used_here[t] = IsIn(second, t) && !IsLost(t) && told_here[t] > ends_.lower + reach &&
                       told_here[t] < ends_.upper - reach;
      }
      response = ResponseByLeastSquares(q, used_here, span_.response);
      told_here = response.Predict(p_);
    }
    *variance += 0.5 * variance_here();
    can_be_told_ = can_be_told_ && response.DegreesOfFreedom() > 0.0;
    CopyHalf(second, told_here, told);
    CopyHalf(second, used_here, used);
    responses_.push_back(std::move(response));
  }

  std::vector<double> CovarianceOf(const std::vector<bool>& used, double variance) const {
    const std::vector<double> rest = Less(Between(p_), told_);
    const std::vector<bool> present(used.begin() + static_cast<std::ptrdiff_t>(First()),
                                    used.begin() + static_cast<std::ptrdiff_t>(End()));
    std::vector<double> out =
        PresentAutocovariance(rest, present, std::min(4 * span_.beside, rest.size()));
    // Fits of h have taken a share of it.
    const double scale = out[0] > 0.0 ? variance / out[0] : 0.0;
    for (double& value : out) value *= scale;
    out.resize(span_.beside + 1);
    // What q tells all of has no noise.
    const auto [least, most] = std::ranges::minmax(p_);
    out[0] += std::pow(kLeastNoise * (most - least), 2);
    return out;
  }

  const std::vector<double>& p_;
  RangeEnds ends_;
  CycleSpan span_;
  std::vector<ResponseByLeastSquares> responses_;  // of either half
  std::optional<Autoregression> process_;
  std::vector<double> told_;
  std::vector<std::size_t> lost_;
  bool can_be_told_ = true;
};

}  // namespace

Record WithClippedDrawn(Record record, const RangeEnds& pressure, double cycle_hz,
                        std::uint64_t seed) {
  CHECK_GT(cycle_hz, 0.0);
  CHECK_EQ(record.pressure.size(), record.heat_release.size());
  const CycleSpan span = SpanOfCycle(record.pressure.size(), record.sampling_hz / cycle_hz);
  const ClippedDraws draws(record.pressure, record.heat_release, pressure, span);
  if (!draws.can_be_told()) return record;
  RandomStream random(seed);
  record.pressure_errors.clear();
  for (int draw = 0; draw < kDrawsOfErrors; ++draw) {
    record.pressure_errors.push_back(draws.DrawError(&random));
  }
  std::vector<double> drawn = draws.Draw(&random);
  record.heat_release = draws.Between(record.heat_release);
  record.pressure = std::move(drawn);
  record.lost_share = 1.0 - (1.0 - record.lost_share) * (1.0 - draws.LostShare());
  return record;
}

}  // namespace howl

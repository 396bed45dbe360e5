#include "estimation/joint_records/loop_prediction.h"

#include <array>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>

#include "estimation/analysis/spectra/half_width.h"
#include "model/numerics/units.h"

namespace howl {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// Of ln f, sigma / omega and ln g: ten times by how much a rig's points are expected to scatter
// about a straight line (parameter_law.cc), before they show by how much they do. The paper's four
// reliable points (configs/r228.yaml) scatter by 0.9 % in frequency and 1.4 % in the loop's gain;
// that is one rig, and a gain depends on all else: 5 % are taken. With a damping of 0.1 these are
// 0.005 in sigma / omega.
constexpr std::array<double, 3> kDeviation = {0.1, 0.05, 0.5};

Eigen::Vector3d Carried(const SmallSignalLoop& loop) {
  const double turn = kRadPerSPerHz * loop.frequency_hz.value;
  return {std::log(loop.frequency_hz.value), loop.growth_rate_1_s.value / turn,
          std::log(loop.loop_gain.value)};
}

Eigen::Vector3d ErrorsOf(const SmallSignalLoop& loop) {
  const double turn = kRadPerSPerHz * loop.frequency_hz.value;
  return {loop.frequency_hz.std / loop.frequency_hz.value, loop.growth_rate_1_s.std / turn,
          loop.loop_gain.std / loop.loop_gain.value};
}

bool IsUsable(const SmallSignalLoop& loop) {
  const Eigen::Vector3d errors = ErrorsOf(loop);
  return loop.found && loop.loop_gain.value > 0.0 && Carried(loop).allFinite() &&
         errors.allFinite() && errors.minCoeff() > 0.0;
}

PredictedValue Around(const Estimate& estimate) {
  const double half = HalfWidth95(estimate);
  return {estimate.value, estimate.value - half, estimate.value + half};
}

}  // namespace

RestLoopPrediction NoPrediction() {
  const PredictedValue none{kNone, kNone, kNone};
  return {std::nullopt, none, none, none, kNone};
}

LoopPredictor::LoopPredictor(std::span<const OnsetPoint> points)
    : points_(points.begin(), points.end()) {
  std::vector<const OnsetPoint*> usable;
  for (const OnsetPoint& point : points_) {
    if (IsUsable(point.loop)) usable.push_back(&point);
  }
  const auto count = static_cast<double>(usable.size());
  for (const OnsetPoint* point : usable) mean_ += point->operating_parameter / count;
  for (const OnsetPoint* point : usable) {
    deviation_ += std::pow(point->operating_parameter - mean_, 2) / count;
  }
  deviation_ = std::sqrt(deviation_);
  if (!(deviation_ > 0.0)) return;
  PointPrior base{
      Eigen::VectorXd::Zero(3), Eigen::Map<const Eigen::Vector3d>(kDeviation.data()), {}};
  std::vector<ParameterEvidence> evidence;
  for (const OnsetPoint* point : usable) {
    const Eigen::VectorXd precision = ErrorsOf(point->loop).array().square().inverse();
    const Eigen::VectorXd value = Carried(point->loop);
    base.mean += value / count;
    evidence.push_back({(point->operating_parameter - mean_) / deviation_,
                        Eigen::MatrixXd(precision.asDiagonal()), precision.cwiseProduct(value)});
  }
  law_ = FitParameterLaw(evidence, base);
}

RestLoopPrediction LoopPredictor::Measured(std::size_t e) const {
  const SmallSignalLoop& loop = points_[e].loop;
  RestLoopPrediction out = NoPrediction();
  out.measured = e;
  if (!IsUsable(loop)) return out;
  out.frequency_hz = Around(loop.frequency_hz);
  out.growth_rate_1_s = Around(loop.growth_rate_1_s);
  out.loop_gain = Around(loop.loop_gain);
  out.share_unstable = boost::math::cdf(boost::math::normal(),
                                        loop.growth_rate_1_s.value / loop.growth_rate_1_s.std);
  return out;
}

RestLoopPrediction LoopPredictor::Elsewhere(double operating_parameter) const {
  RestLoopPrediction out = NoPrediction();
  if (!law_) return out;
  const PointPrior there = law_->PredictionAt((operating_parameter - mean_) / deviation_);
  // The middle one of a value, the lower and the upper end of its interval.
  const auto quantiles = [&](Eigen::Index i) {
    const boost::math::students_t student(there.degrees[i]);
    const double half = boost::math::quantile(student, 0.975) * there.deviation[i];
    return PredictedValue{there.mean[i], there.mean[i] - half, there.mean[i] + half};
  };
  const auto exponential = [](const PredictedValue& log) {
    return PredictedValue{std::exp(log.value), std::exp(log.lo), std::exp(log.hi)};
  };
  out.frequency_hz = exponential(quantiles(0));
  out.loop_gain = exponential(quantiles(2));
  // That of f is far smaller than sigma's own.
  const double turn = kRadPerSPerHz * out.frequency_hz.value;
  const PredictedValue growth = quantiles(1);
  out.growth_rate_1_s = {turn * growth.value, turn * growth.lo, turn * growth.hi};
  out.share_unstable = boost::math::cdf(boost::math::students_t(there.degrees[1]),
                                        there.mean[1] / there.deviation[1]);
  return out;
}

RestLoopPrediction LoopPredictor::At(double operating_parameter) const {
  for (std::size_t e = 0; e < points_.size(); ++e) {
    if (points_[e].operating_parameter == operating_parameter) return Measured(e);
  }
  return Elsewhere(operating_parameter);
}

}  // namespace howl

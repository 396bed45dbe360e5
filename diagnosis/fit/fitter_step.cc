#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "diagnosis/fit/bin_gram.h"
#include "diagnosis/fit/fitter.h"
#include "diagnosis/numerics/scaled_solve.h"

namespace howl {
namespace {

constexpr double kLargestLogStep = 0.6;
constexpr double kLargestLinearStep = 0.15;  // of the bounds' distance
constexpr double kDifferenceStep = 1e-5;
constexpr double kLeastDamping = 1e-10;
constexpr int kLocalIterations = 6;
constexpr std::size_t kFurtherStarts = 3;
constexpr double kSameModeLogRatio = 0.3;
constexpr int kRestartIterations = 4;
constexpr double kRestartGain = 2.0;
// Two modes of which the lower has no weight are one mode with one parameter more, which gains a
// nat or two.
constexpr double kSecondModeGain = 20.0;
constexpr int kSecondModeIterations = 8;  // the grid is farther from there

double Span(const EffectParameter& p) { return p.high - p.low; }

}  // namespace

double DifferenceStep(const EffectParameter& p, double x) {
  return kDifferenceStep * (p.scale == ParameterScale::kLogarithmic ? x : 0.1 * Span(p));
}

double SteppedValue(const EffectParameter& p, double x, double step) {
  if (p.scale == ParameterScale::kLogarithmic) {
    x *= std::exp(std::clamp(step, -kLargestLogStep, kLargestLogStep));
  } else {
    const double most = kLargestLinearStep * Span(p);
    x += std::clamp(step, -most, most);
  }
  return std::clamp(x, p.low, p.high);
}

double Fitter::LeakJacobian(EffectValues x, const AcousticLocals& locals, std::size_t e) const {
  const CutRecord& record = records_[e];
  if (effect_.PressureLeak(record.at.cycle_frequency_hz, record.at, x) == 0.0) return 0.0;
  const Eigen::VectorXcd r = RecordedTransfer(record, effect_, x, locals);
  double sum = 0.0;
  for (Eigen::Index k = 0; k < record.flame_count; ++k) {
    const Response leak = effect_.PressureLeak(record.frequency(k), record.at, x);
    sum -= record.flame_share[k] * std::log(std::norm(1.0 - leak * r[k + kTapReach]));
  }
  return sum / kBinCorrelation;
}

Fitter::System Fitter::Linearise(const EffectFit& fit) const {
  const auto d = static_cast<Eigen::Index>(fit.values.size());
  Eigen::VectorXd steps(d);
  Eigen::VectorXd to_u(d);
  for (Eigen::Index j = 0; j < d; ++j) {
    const EffectParameter& p = effect_.parameters()[static_cast<std::size_t>(j)];
    const double x = fit.values[static_cast<std::size_t>(j)];
    to_u[j] = ScaleOf(p, x);
    steps[j] = DifferenceStep(p, x);
  }
  System system;
  system.gradient = Eigen::VectorXd::Zero(1 + d);
  system.curvature = Eigen::MatrixXd::Zero(1 + d, 1 + d);
  for (std::size_t e = 0; e < records_.size(); ++e) {
    const ExperimentFit& at = fit.experiments[e];
    Reduced out;
    out.reduced_gradient = Eigen::VectorXd::Zero(1 + d);
    out.reduced_curvature = Eigen::MatrixXd::Zero(1 + d, 1 + d);
    if (acoustic_) {
      Eigen::MatrixXcd j = AcousticJacobian(records_[e], effect_, fit.values, at.acoustics,
                                            at.acoustic_residual, steps);
      for (Eigen::Index i = 0; i < d; ++i) j.col(4 + i) *= to_u[i];
      const Eigen::MatrixXd h = BinGram(j, weights_a_[e], j);
      const Eigen::VectorXd g = BinGram(j, weights_a_[e], at.acoustic_residual);
      out.local_curvature = h.topLeftCorner(4, 4);
      out.local_gradient = g.head(4);
      out.mixed = h.topRightCorner(4, d);
      const Eigen::MatrixXd inner = SolveScaled(out.local_curvature, out.mixed, 1e-10);
      out.reduced_curvature.bottomRightCorner(d, d) +=
          h.bottomRightCorner(d, d) - out.mixed.transpose() * inner;
      out.reduced_gradient.tail(d) += g.tail(d) - inner.transpose() * out.local_gradient;
      // Half the slope, as g is.
      const double leak_now = LeakJacobian(fit.values, at.acoustics, e);
      std::vector<double> moved = fit.values;
      for (Eigen::Index i = 0; i < d; ++i) {
        const auto which = static_cast<std::size_t>(i);
        moved[which] += steps[i];
        const double leak = LeakJacobian(moved, at.acoustics, e);
        out.reduced_gradient[1 + i] += 0.5 * (leak - leak_now) / steps[i] * to_u[i];
        moved[which] = fit.values[which];
      }
    }
    if (flame_) {
      Eigen::MatrixXcd j = FlameJacobian(records_[e], effect_, fit.values, fit.DelayOf(e),
                                         columns_[e], solutions_[e], steps);
      j.col(0) *= std::exp(at.log_delay);
      for (Eigen::Index i = 0; i < d; ++i) j.col(1 + i) *= to_u[i];
      const Eigen::MatrixXd h = BinGram(j, weights_b_[e], j);
      const Eigen::VectorXd g = BinGram(j, weights_b_[e], at.flame_residual);
      const Eigen::MatrixXcd& c = solutions_[e].columns;
      const Eigen::MatrixXd local = BinGram(c, weights_b_[e], c);
      const Eigen::MatrixXd mixed = BinGram(c, weights_b_[e], j);
      Eigen::MatrixXd curvature = h - mixed.transpose() * SolveScaled(local, mixed, 1e-10);
      Eigen::VectorXd gradient = g;
      EliminateDelay(fit, e, &curvature, &gradient, &out);
      out.reduced_curvature += curvature;
      out.reduced_gradient += gradient;
    }
    system.gradient += out.reduced_gradient;
    system.curvature += out.reduced_curvature;
    system.experiments.push_back(std::move(out));
  }
  return system;
}

Fitter::Score Fitter::ScoreOf(EffectFit* fit, std::size_t parameter) {
  Evaluate(fit);
  const System system = Linearise(*fit);
  const auto j = static_cast<Eigen::Index>(parameter) + 1;
  Eigen::Matrix2d h = Eigen::Matrix2d::Zero();
  Eigen::Vector2d g = Eigen::Vector2d::Zero();
  for (const Reduced& part : system.experiments) {
    const Eigen::MatrixXd& c = part.reduced_curvature;
    h += (Eigen::Matrix2d() << c(j, j), c(j, 0), c(0, j), c(0, 0)).finished();
    g += Eigen::Vector2d(part.reduced_gradient[j], part.reduced_gradient[0]);
  }
  if (!flame_) {
    h(1, 1) = 1.0;
    g[1] = 0.0;
  }
  const Eigen::Vector2d move = -SolveScaled(h, g, 1e-9);
  return {-g.dot(move), fit->values[parameter] + move[0]};
}

Eigen::VectorXd Fitter::SharedStep(const System& system, double damping) const {
  const Eigen::MatrixXd& h = system.curvature;
  const Eigen::VectorXd& g = system.gradient;
  const Eigen::Index d = g.size() - 1;
  Eigen::VectorXd step = Eigen::VectorXd::Zero(1 + d);
  if (flame_) {
    step = -SolveScaled(h, g, damping);
  } else if (d > 0) {
    step.tail(d) = -SolveScaled(h.bottomRightCorner(d, d), g.tail(d), damping);
  }
  return step;
}

double Fitter::Decrement(const System& system) const {
  double sum = -system.gradient.dot(SharedStep(system, kLeastDamping));
  for (const Reduced& part : system.experiments) {
    if (acoustic_) {
      sum += part.local_gradient.dot(
          SolveScaled(part.local_curvature, part.local_gradient, kLeastDamping).col(0));
    }
    if (part.delay_curvature > 0.0) {
      sum += part.delay_gradient * part.delay_gradient / part.delay_curvature;
    }
  }
  return sum;
}

void Fitter::Step(const System& system, double damping, EffectFit* fit) const {
  const auto d = static_cast<Eigen::Index>(fit->values.size());
  Eigen::VectorXd step = SharedStep(system, damping);
  const double largest_tau = 0.05 / records_[0].at.cycle_frequency_hz;
  step[0] = std::clamp(step[0], -largest_tau, largest_tau);
  Eigen::VectorXd taken(d);
  for (Eigen::Index j = 0; j < d; ++j) {
    const EffectParameter& p = effect_.parameters()[static_cast<std::size_t>(j)];
    double& x = fit->values[static_cast<std::size_t>(j)];
    const double was = x;
    x = SteppedValue(p, x, step[1 + j]);
    taken[j] = p.scale == ParameterScale::kLogarithmic ? std::log(x / was) : x - was;
  }
  const double tau_was_s = fit->tau_s;
  fit->tau_s = std::max(fit->tau_s + step[0], 0.0);
  Eigen::VectorXd shared(1 + d);
  shared << fit->tau_s - tau_was_s, taken;
  for (std::size_t e = 0; e < records_.size(); ++e) {
    StepDelay(system.experiments[e], shared, &fit->experiments[e]);
  }
  if (!acoustic_) return;
  for (std::size_t e = 0; e < records_.size(); ++e) {
    const Reduced& part = system.experiments[e];
    AcousticLocals move =
        -SolveScaled(part.local_curvature, part.local_gradient + part.mixed * taken, damping);
    move[0] = std::clamp(move[0], -0.1, 0.1);
    move[1] = std::clamp(move[1], -0.6, 0.6);
    fit->experiments[e].acoustics += move;
  }
}

double Fitter::DescendAcoustics(EffectFit* fit, std::size_t e, int iterations) const {
  ExperimentFit& at = fit->experiments[e];
  double cost = AcousticSquares(fit, e);
  for (int i = 0; i < iterations; ++i) {
    const Eigen::MatrixXcd jacobian = AcousticJacobian(
        records_[e], effect_, fit->values, at.acoustics, at.acoustic_residual, Eigen::VectorXd());
    const Eigen::MatrixXd h = BinGram(jacobian, weights_a_[e], jacobian);
    const Eigen::VectorXd g = BinGram(jacobian, weights_a_[e], at.acoustic_residual);
    const ExperimentFit before = at;
    at.acoustics -= SolveScaled(h, g, 1e-8);
    const double moved = AcousticSquares(fit, e);
    if (!(moved < cost)) {
      at = before;
      break;
    }
    const bool done = cost - moved < kDescentConverged;
    cost = moved;
    if (done) break;
  }
  return cost;
}

void Fitter::DescendLocals(EffectFit* fit, std::size_t e) {
  if (acoustic_) DescendAcoustics(fit, e, kLocalIterations);
  DescendDelay(fit, e);
  EvaluateOne(fit, e);
}

bool Fitter::RestartLocals(EffectFit* fit) {
  if (!acoustic_) return false;
  bool better = false;
  for (std::size_t e = 0; e < records_.size(); ++e) {
    std::vector<AcousticLocals> starts =
        AcousticStarts(records_[e], effect_, fit->values, kFurtherStarts);
    // Starts at the other experiments' acoustics, moved by the ratio of the cycles' frequencies.
    for (std::size_t other = 0; other < records_.size(); ++other) {
      if (other == e) continue;
      AcousticLocals start = fit->experiments[other].acoustics;
      const double ratio =
          records_[e].at.cycle_frequency_hz / records_[other].at.cycle_frequency_hz;
      // Cycles that are farther apart are cycles of two different modes.
      if (std::abs(std::log(ratio)) < kSameModeLogRatio) start[0] += std::log(ratio);
      starts.push_back(start);
    }
    double best = AcousticSquares(fit, e);
    const double was = best;
    const auto follow = [&](const AcousticLocals& start, int iterations, double least) {
      ExperimentFit& at = fit->experiments[e];
      const ExperimentFit kept = at;
      at.acoustics = start;
      const double cost = DescendAcoustics(fit, e, iterations);
      if (cost < best - least) {
        best = cost;
      } else {
        at = kept;
      }
    };
    for (const AcousticLocals& start : starts) follow(start, kRestartIterations, 0.0);
    for (const AcousticLocals& start :
         SecondModeStarts(records_[e], effect_, fit->values, kFurtherStarts)) {
      follow(start, kSecondModeIterations, kSecondModeGain);
    }
    better = better || best < was - kRestartGain;
  }
  return better;
}

}  // namespace howl

#include "diagnosis/effect_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>

#include "diagnosis/cut_noise.h"

namespace howl {
namespace {

constexpr int kFirstRoundIterations = 7;
constexpr int kLaterRoundIterations = 8;
constexpr int kRounds = 3;
constexpr std::size_t kStartsKept = 2;
constexpr double kConverged = 1e-3;  // of the cost, in units of a log-likelihood
constexpr double kLargestLogStep = 0.6;
constexpr double kLargestLinearStep = 0.15;  // of the bounds' distance
constexpr double kDifferenceStep = 1e-5;

class NoEffect final : public NamedEffect {
 public:
  NoEffect() : NamedEffect("none", LoopBlock::kAcoustics, {}) {}
  bool ChangesAcousticCut() const override { return true; }
  bool ChangesFlameCut() const override { return true; }
};

double Span(const EffectParameter& p) { return p.high - p.low; }

// Search coordinate u: log x or x.
double ScaleOf(const EffectParameter& p, double x) {
  return p.scale == ParameterScale::kLogarithmic ? x : 1.0;
}

double Squares(const Eigen::VectorXcd& residual, const Eigen::VectorXd& weight) {
  return residual.cwiseAbs2().dot(weight) / kBinCorrelation;
}

Eigen::MatrixXd Gram(const Eigen::MatrixXcd& a, const Eigen::VectorXd& w,
                     const Eigen::MatrixXcd& b) {
  return ((w.asDiagonal() * a).adjoint() * b).real() / kBinCorrelation;
}

class Fitter {
 public:
  Fitter(const std::vector<CutRecord>& records, const Effect& effect,
         const std::vector<FlameColumns>* base_columns)
      : records_(records),
        effect_(effect),
        acoustic_(effect.ChangesAcousticCut()),
        flame_(effect.ChangesFlameCut()),
        own_columns_(effect.ChangesFlameInput() || effect.ModulatesDelay() || !base_columns),
        columns_(records.size()) {
    if (!own_columns_) columns_ = *base_columns;
  }

  void SetNoise(const EffectFit& fit) {
    weights_a_.clear();
    weights_b_.clear();
    for (std::size_t e = 0; e < records_.size(); ++e) {
      weights_a_.push_back(AcousticWeights(records_[e], fit.experiments[e].acoustic_noise));
      weights_b_.push_back(FlameWeights(records_[e], fit.experiments[e].flame_noise));
    }
  }

  // Residuals at the fit's parameters; the flame's coefficients are solved for.
  double Evaluate(EffectFit* fit) {
    double cost = 0.0;
    for (std::size_t e = 0; e < records_.size(); ++e) cost += EvaluateOne(fit, e);
    return cost;
  }

  double EvaluateOne(EffectFit* fit, std::size_t e) {
    ExperimentFit& at = fit->experiments[e];
    double cost = 0.0;
    if (acoustic_) {
      at.acoustic_residual = AcousticResidual(records_[e], effect_, fit->values, at.acoustics);
      cost += Squares(at.acoustic_residual, weights_a_[e]);
      cost += LeakJacobian(fit->values, at.acoustics, e);
    }
    if (flame_) {
      if (own_columns_) {
        columns_[e] = MakeFlameColumns(records_[e], effect_, fit->values, fit->tau_s);
      }
      solutions_.resize(records_.size());
      solutions_[e] =
          SolveFlame(records_[e], effect_, fit->values, fit->tau_s, columns_[e], weights_b_[e]);
      at.flame = solutions_[e].coefficients;
      at.flame_range = columns_[e].range;
      at.flame_residual = solutions_[e].residual;
      cost += Squares(at.flame_residual, weights_b_[e]);
    }
    return cost;
  }

  // Damped Gauss-Newton at fixed noise. Returns the squares' sum.
  double Descend(EffectFit* fit, int iterations) {
    double cost = Evaluate(fit);
    double damping = 1e-4;
    for (int i = 0; i < iterations; ++i) {
      const System system = Linearise(*fit);
      bool better = false;
      double gain = 0.0;
      for (int attempt = 0; attempt < 6 && !better; ++attempt) {
        EffectFit next = *fit;
        Step(system, damping, &next);
        const double moved = Evaluate(&next);
        if (moved < cost) {
          gain = cost - moved;
          *fit = std::move(next);
          cost = moved;
          damping = std::max(damping * 0.1, 1e-9);
          better = true;
        } else {
          damping *= 20.0;
        }
      }
      if (!better || gain < kConverged) break;
    }
    Evaluate(fit);
    return cost;
  }

  void RefitNoise(EffectFit* fit) {
    fit->acoustic_cost = 0.0;
    fit->flame_cost = 0.0;
    for (std::size_t e = 0; e < records_.size(); ++e) {
      ExperimentFit& at = fit->experiments[e];
      if (acoustic_) {
        const Eigen::VectorXcd r =
            RecordedTransfer(records_[e], effect_, fit->values, at.acoustics);
        at.acoustic_noise =
            FitAcousticNoise(records_[e], at.acoustic_residual,
                             r.segment(kTapReach, records_[e].acoustic_count).cwiseAbs2());
      }
      if (flame_) at.flame_noise = FitFlameNoise(records_[e], at.flame_residual);
      fit->acoustic_cost += AcousticCost(records_[e], at.acoustic_residual, at.acoustic_noise);
      fit->acoustic_cost += LeakJacobian(fit->values, at.acoustics, e);
      fit->flame_cost += FlameCost(records_[e], at.flame_residual, at.flame_noise);
    }
    SetNoise(*fit);
  }

  // The reduced gradients and curvatures, and standard errors from them.
  void Finish(EffectFit* fit, const EffectFit* base) {
    Evaluate(fit);
    const System system = Linearise(*fit);
    const Eigen::Index d = 1 + static_cast<Eigen::Index>(fit->values.size());
    Eigen::MatrixXd total = Eigen::MatrixXd::Zero(d, d);
    for (std::size_t e = 0; e < records_.size(); ++e) {
      ExperimentFit& at = fit->experiments[e];
      at.gradient = system.experiments[e].reduced_gradient;
      at.curvature = system.experiments[e].reduced_curvature;
      if (!flame_ && base) {
        at.gradient[0] += base->experiments[e].gradient[0];
        at.curvature(0, 0) += base->experiments[e].curvature(0, 0);
      }
      total += at.curvature;
    }
    // The cost is a sum of |E|^2 / V, twice the log-likelihood less a constant: its curvature over
    // two is the information.
    const Eigen::VectorXd scale = total.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    Eigen::MatrixXd scaled = scale.asDiagonal() * total * scale.asDiagonal();
    scaled.diagonal().array() += 1e-9;
    const Eigen::MatrixXd inverse = scaled.ldlt().solve(Eigen::MatrixXd::Identity(d, d));
    fit->standard_errors.assign(static_cast<std::size_t>(d), 0.0);
    for (Eigen::Index i = 0; i < d; ++i) {
      const double in_u = scale[i] * std::sqrt(0.5 * std::max(inverse(i, i), 0.0));
      const double to_x = i == 0 ? 1.0
                                 : ScaleOf(effect_.parameters()[static_cast<std::size_t>(i - 1)],
                                           fit->values[static_cast<std::size_t>(i - 1)]);
      fit->standard_errors[static_cast<std::size_t>(i)] = in_u * to_x;
    }
  }

  // The experiment's own parameters at fixed shared ones.
  void DescendLocals(EffectFit* fit, std::size_t e) {
    double cost = EvaluateOne(fit, e);
    if (!acoustic_) return;
    for (int i = 0; i < 6; ++i) {
      const ExperimentFit& at = fit->experiments[e];
      const Eigen::MatrixXcd jacobian = AcousticJacobian(
          records_[e], effect_, fit->values, at.acoustics, at.acoustic_residual, Eigen::VectorXd());
      const Eigen::MatrixXd h = Gram(jacobian, weights_a_[e], jacobian);
      const Eigen::VectorXd g = Gram(jacobian, weights_a_[e], at.acoustic_residual);
      EffectFit next = *fit;
      next.experiments[e].acoustics -= SolveScaled(h, g, 1e-8);
      const double moved = EvaluateOne(&next, e);
      if (!(moved < cost)) break;
      const bool done = cost - moved < kConverged;
      cost = moved;
      *fit = std::move(next);
      if (done) break;
    }
    EvaluateOne(fit, e);
  }

  const std::vector<FlameColumns>& columns() const { return columns_; }

 private:
  struct Reduced {
    Eigen::MatrixXd local_curvature;  // cut A's locals
    Eigen::VectorXd local_gradient;
    Eigen::MatrixXd mixed;  // locals x shared
    Eigen::VectorXd reduced_gradient;
    Eigen::MatrixXd reduced_curvature;
  };
  struct System {
    std::vector<Reduced> experiments;
  };

  // With a leak, the residuals are (E_A, E_B) = M (P, Q) with |det M| = |1 - leak R| instead of
  // one: recorded p stands on both sides. The likelihood needs - log |det M|^2, or the leak is
  // biased by what combustion noise sends to p at once.
  double LeakJacobian(EffectValues x, const AcousticLocals& locals, std::size_t e) const {
    const CutRecord& record = records_[e];
    if (effect_.PressureLeak(record.at.cycle_frequency_hz, record.at, x) == 0.0) return 0.0;
    const Eigen::VectorXcd r = RecordedTransfer(record, effect_, x, locals);
    double sum = 0.0;
    for (Eigen::Index k = 0; k < record.flame_count; ++k) {
      const Response leak = effect_.PressureLeak(record.frequency(k), record.at, x);
      const Eigen::VectorXd& share = record.reference.flame_share;
      sum -=
          (share.size() > 0 ? share[k] : 1.0) * std::log(std::norm(1.0 - leak * r[k + kTapReach]));
    }
    return sum / kBinCorrelation;
  }

  static Eigen::VectorXd SolveScaled(const Eigen::MatrixXd& h, const Eigen::VectorXd& g,
                                     double damping) {
    const Eigen::VectorXd scale = h.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    Eigen::MatrixXd scaled = scale.asDiagonal() * h * scale.asDiagonal();
    scaled.diagonal().array() += damping;
    return scale.cwiseProduct(scaled.ldlt().solve(scale.cwiseProduct(g)));
  }

  static Eigen::MatrixXd SolveScaledMany(const Eigen::MatrixXd& h, const Eigen::MatrixXd& g,
                                         double damping) {
    Eigen::MatrixXd out(g.rows(), g.cols());
    for (Eigen::Index j = 0; j < g.cols(); ++j) out.col(j) = SolveScaled(h, g.col(j), damping);
    return out;
  }

  System Linearise(const EffectFit& fit) const {
    const auto d = static_cast<Eigen::Index>(fit.values.size());
    Eigen::VectorXd steps(d);
    Eigen::VectorXd to_u(d);
    for (Eigen::Index j = 0; j < d; ++j) {
      const EffectParameter& p = effect_.parameters()[static_cast<std::size_t>(j)];
      const double x = fit.values[static_cast<std::size_t>(j)];
      to_u[j] = ScaleOf(p, x);
      steps[j] = kDifferenceStep * (p.scale == ParameterScale::kLogarithmic ? x : 0.1 * Span(p));
    }
    System system;
    for (std::size_t e = 0; e < records_.size(); ++e) {
      const ExperimentFit& at = fit.experiments[e];
      Reduced out;
      out.reduced_gradient = Eigen::VectorXd::Zero(1 + d);
      out.reduced_curvature = Eigen::MatrixXd::Zero(1 + d, 1 + d);
      if (acoustic_) {
        Eigen::MatrixXcd j = AcousticJacobian(records_[e], effect_, fit.values, at.acoustics,
                                              at.acoustic_residual, steps);
        for (Eigen::Index i = 0; i < d; ++i) j.col(4 + i) *= to_u[i];
        const Eigen::MatrixXd h = Gram(j, weights_a_[e], j);
        const Eigen::VectorXd g = Gram(j, weights_a_[e], at.acoustic_residual);
        out.local_curvature = h.topLeftCorner(4, 4);
        out.local_gradient = g.head(4);
        out.mixed = h.topRightCorner(4, d);
        const Eigen::MatrixXd inner = SolveScaledMany(out.local_curvature, out.mixed, 1e-10);
        out.reduced_curvature.bottomRightCorner(d, d) +=
            h.bottomRightCorner(d, d) - out.mixed.transpose() * inner;
        out.reduced_gradient.tail(d) += g.tail(d) - inner.transpose() * out.local_gradient;
        // Half the slope, as in g.
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
        Eigen::MatrixXcd j = FlameJacobian(records_[e], effect_, fit.values, fit.tau_s, columns_[e],
                                           solutions_[e], steps);
        for (Eigen::Index i = 0; i < d; ++i) j.col(1 + i) *= to_u[i];
        const Eigen::MatrixXd h = Gram(j, weights_b_[e], j);
        const Eigen::VectorXd g = Gram(j, weights_b_[e], at.flame_residual);
        const Eigen::MatrixXcd& c = solutions_[e].columns;
        const Eigen::MatrixXd local = Gram(c, weights_b_[e], c);
        const Eigen::MatrixXd mixed = Gram(c, weights_b_[e], j);
        out.reduced_curvature += h - mixed.transpose() * SolveScaledMany(local, mixed, 1e-10);
        out.reduced_gradient += g;
      }
      system.experiments.push_back(std::move(out));
    }
    return system;
  }

  void Step(const System& system, double damping, EffectFit* fit) const {
    const auto d = static_cast<Eigen::Index>(fit->values.size());
    Eigen::MatrixXd h = Eigen::MatrixXd::Zero(1 + d, 1 + d);
    Eigen::VectorXd g = Eigen::VectorXd::Zero(1 + d);
    for (const Reduced& part : system.experiments) {
      h += part.reduced_curvature;
      g += part.reduced_gradient;
    }
    Eigen::VectorXd step = Eigen::VectorXd::Zero(1 + d);
    if (flame_) {
      step = -SolveScaled(h, g, damping);
    } else if (d > 0) {
      step.tail(d) = -SolveScaled(h.bottomRightCorner(d, d), g.tail(d), damping);
    }
    const double largest_tau = 0.05 / records_[0].at.cycle_frequency_hz;
    step[0] = std::clamp(step[0], -largest_tau, largest_tau);
    Eigen::VectorXd taken(d);
    for (Eigen::Index j = 0; j < d; ++j) {
      const EffectParameter& p = effect_.parameters()[static_cast<std::size_t>(j)];
      double& x = fit->values[static_cast<std::size_t>(j)];
      if (p.scale == ParameterScale::kLogarithmic) {
        const double was = x;
        x = std::clamp(x * std::exp(std::clamp(step[1 + j], -kLargestLogStep, kLargestLogStep)),
                       p.low, p.high);
        taken[j] = std::log(x / was);
      } else {
        const double was = x;
        const double most = kLargestLinearStep * Span(p);
        x = std::clamp(x + std::clamp(step[1 + j], -most, most), p.low, p.high);
        taken[j] = x - was;
      }
    }
    fit->tau_s = std::max(fit->tau_s + step[0], 0.0);
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

  const std::vector<CutRecord>& records_;
  const Effect& effect_;
  bool acoustic_;
  bool flame_;
  bool own_columns_;
  std::vector<FlameColumns> columns_;
  std::vector<FlameSolution> solutions_;
  std::vector<Eigen::VectorXd> weights_a_;
  std::vector<Eigen::VectorXd> weights_b_;
};

std::vector<FlameColumns> BaseColumns(const std::vector<CutRecord>& records) {
  std::vector<FlameColumns> columns;
  const NoEffect none;
  for (const CutRecord& record : records) {
    columns.push_back(MakeFlameColumns(record, none, {}, 0.0));
  }
  return columns;
}

// The delay by which Phi(v) explains q best, on a grid that no resonance of the objective escapes.
double StartDelay(const std::vector<CutRecord>& records, const std::vector<FlameColumns>& columns) {
  const NoEffect none;
  if (records[0].reference.flame.size() > 0) return records[0].reference.tau_s;
  const double f0 = records[0].at.cycle_frequency_hz;
  const double high_hz = records[0].frequency(records[0].flame_count - 1);
  const double step = 0.12 / high_hz;
  double best = std::numeric_limits<double>::infinity();
  double best_tau = 0.0;
  const auto count = static_cast<int>(std::ceil(1.5 / f0 / step));
  for (int i = 0; i < count; ++i) {
    const double tau = 0.1 / f0 + i * step;
    double cost = 0.0;
    double falling = 0.0;
    for (std::size_t e = 0; e < records.size(); e += std::max<std::size_t>(records.size() / 2, 1)) {
      const Eigen::VectorXd weight =
          FlameWeights(records[e], Eigen::VectorXd::Ones(records[e].flame_count));
      const FlameSolution solution = SolveFlame(records[e], none, {}, tau, columns[e], weight);
      cost += std::log(solution.residual.cwiseAbs2().dot(weight));
      // Near v = 0, where all records have samples.
      falling += solution.coefficients[3] - solution.coefficients[6];
    }
    // Half a period away a rising flame fits nearly as well; heat release falls as v rises.
    if (falling <= 0.0) continue;
    if (cost < best) {
      best = cost;
      best_tau = tau;
    }
  }
  return best_tau;
}

// A lag that the effect adds moves tau the other way.
double CorrectedDelay(const std::vector<CutRecord>& records, const Effect& effect, EffectValues x,
                      double tau_s) {
  double factor = 0.0;
  for (const CutRecord& record : records) {
    factor += effect.DelayFactor(record.at, x) / static_cast<double>(records.size());
  }
  const EffectContext& at = records[0].at;
  const double f0 = at.cycle_frequency_hz;
  const Response added = effect.HeatReleaseInstrument(f0, x) * effect.FlameOut(f0, x) *
                         effect.FlameIn(f0, at, x) / effect.PressureInstrument(f0, x);
  return std::max((tau_s + std::arg(added) / (kRadPerSPerHz * f0)) / factor, 0.0);
}

std::vector<std::vector<double>> StartValues(const Effect& effect) {
  std::vector<std::vector<double>> starts = {{}};
  for (const EffectParameter& parameter : effect.parameters()) {
    std::vector<std::vector<double>> longer;
    for (const std::vector<double>& start : starts) {
      for (const double value : parameter.starts) {
        longer.push_back(start);
        longer.back().push_back(value);
      }
    }
    starts = std::move(longer);
  }
  return starts;
}

}  // namespace

EffectPointer BaseEffect() {
  static const EffectPointer base = std::make_shared<NoEffect>();
  return base;
}

EffectFit FitBase(const std::vector<CutRecord>& records) {
  EffectFit fit;
  fit.effect = BaseEffect();
  const std::vector<FlameColumns> columns = BaseColumns(records);
  fit.tau_s = StartDelay(records, columns);
  fit.experiments.resize(records.size());
  for (std::size_t e = 0; e < records.size(); ++e) {
    ExperimentFit& at = fit.experiments[e];
    at.acoustics = StartAcoustics(records[e], *fit.effect, {});
    at.acoustic_noise = Eigen::VectorXd::Ones(records[e].acoustic_count);
    at.flame_noise = Eigen::VectorXd::Ones(records[e].flame_count);
  }
  Fitter fitter(records, *fit.effect, &columns);
  fitter.SetNoise(fit);
  for (int round = 0; round <= kRounds; ++round) {
    fitter.Descend(&fit, kLaterRoundIterations);
    fitter.RefitNoise(&fit);
  }
  fitter.Finish(&fit, nullptr);
  return fit;
}

EffectFit FitEffect(const std::vector<CutRecord>& records, const EffectPointer& effect,
                    const EffectFit& base) {
  const std::vector<FlameColumns> columns =
      effect->ChangesFlameCut() ? BaseColumns(records) : std::vector<FlameColumns>(records.size());
  Fitter fitter(records, *effect, &columns);
  std::vector<EffectFit> candidates;
  for (const std::vector<double>& values : StartValues(*effect)) {
    EffectFit fit = base;
    fit.effect = effect;
    fit.values = values;
    if (effect->ChangesFlameCut()) {
      fit.tau_s = CorrectedDelay(records, *effect, values, base.tau_s);
    }
    if (effect->ChangesAcousticCut()) {
      for (std::size_t e = 0; e < records.size(); ++e) {
        fit.experiments[e].acoustics = StartAcoustics(records[e], *effect, values);
      }
    }
    fitter.SetNoise(fit);
    fitter.Descend(&fit, kFirstRoundIterations);
    fitter.RefitNoise(&fit);
    candidates.push_back(std::move(fit));
    std::sort(candidates.begin(), candidates.end(),
              [](const EffectFit& a, const EffectFit& b) { return a.cost() < b.cost(); });
    if (candidates.size() > kStartsKept) candidates.pop_back();
  }
  for (EffectFit& fit : candidates) {
    fitter.SetNoise(fit);
    for (int round = 1; round < kRounds; ++round) {
      fitter.Descend(&fit, kLaterRoundIterations);
      fitter.RefitNoise(&fit);
    }
  }
  EffectFit best =
      *std::min_element(candidates.begin(), candidates.end(),
                        [](const EffectFit& a, const EffectFit& b) { return a.cost() < b.cost(); });
  fitter.SetNoise(best);
  fitter.Finish(&best, &base);
  return best;
}

ExperimentFit HeldOut(const std::vector<CutRecord>& records, const EffectFit& fit,
                      std::size_t experiment) {
  EffectFit moved = fit;
  const Eigen::Index d = fit.experiments[0].gradient.size();
  Eigen::MatrixXd rest = Eigen::MatrixXd::Zero(d, d);
  for (std::size_t e = 0; e < records.size(); ++e) {
    if (e != experiment) rest += fit.experiments[e].curvature;
  }
  const Eigen::VectorXd scale = rest.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  Eigen::MatrixXd scaled = scale.asDiagonal() * rest * scale.asDiagonal();
  scaled.diagonal().array() += 1e-6;
  const Eigen::VectorXd shift = scale.cwiseProduct(
      scaled.ldlt().solve(scale.cwiseProduct(fit.experiments[experiment].gradient)));
  moved.tau_s += shift[0];
  for (std::size_t j = 0; j < fit.values.size(); ++j) {
    const EffectParameter& p = fit.effect->parameters()[j];
    const double by = shift[static_cast<Eigen::Index>(j) + 1];
    double& x = moved.values[j];
    x = p.scale == ParameterScale::kLogarithmic ? x * std::exp(std::clamp(by, -1.0, 1.0)) : x + by;
    x = std::clamp(x, p.low, p.high);
  }
  Fitter fitter(records, *fit.effect, nullptr);
  fitter.SetNoise(moved);
  // Its own parameters, in all cuts that the effect or the moved delay reach.
  fitter.DescendLocals(&moved, experiment);
  return moved.experiments[experiment];
}

}  // namespace howl

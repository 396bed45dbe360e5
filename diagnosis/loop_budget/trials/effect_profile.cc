#include "diagnosis/loop_budget/trials/effect_profile.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "diagnosis/loop_budget/forms/odds.h"
#include "estimation/parallel.h"
#include "estimation/record_fit/spectra/middle_part.h"

namespace howl {
namespace {

constexpr int kMostSteps = 20;
constexpr int kMostHalvings = 5;
// The first step, of the search's range, so that fits follow; where one gained at least half of
// what was foretold the next may be twice as long (Conn, Gould & Toint 2000, chapter 6).
constexpr double kFirstStep = 0.03;
constexpr double kAsForetold = 0.5;
// Nats over the range squared, below which a profile is flat: no step is to be foretold from it.
constexpr double kFlat = 1e-6;

}  // namespace

void EffectPoint::SumUp() {
  log_posterior = 0.0;
  log_evidence = 0.0;
  for (std::size_t e = 0; e < fits.size(); ++e) {
    log_posterior += fits[e].log_posterior + log_jacobian[e];
    log_evidence += fits[e].log_evidence + log_jacobian[e];
  }
}

Eigen::VectorXd ProfileMaximum::Deviations() const {
  const Eigen::LLT<Eigen::MatrixXd> root(information);
  if (root.info() != Eigen::Success) {
    return Eigen::VectorXd::Constant(at.u.size(), std::numeric_limits<double>::infinity());
  }
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(at.u.size(), at.u.size());
  return root.solve(identity).diagonal().cwiseSqrt();
}

double ProfileMaximum::LogShare(const Eigen::VectorXd& spans) const {
  const Eigen::MatrixXd in_spans = spans.asDiagonal() * information * spans.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(in_spans);
  double sum = 0.0;
  for (const double each : solver.eigenvalues()) {
    sum += 0.5 * std::log(2.0 * std::numbers::pi / std::max(each, 2.0 * std::numbers::pi));
  }
  return sum;
}

EffectProfile::EffectProfile(const LoopRecords& records, const LoopFit& from, const LoopItem& item,
                             MaximumKnown known, std::string key, const LoopBudgetOptions& options)
    : records_(records),
      from_(from),
      form_(With(Without(from.model, item, from.model), item)),
      known_(known),
      low_(RangeEnd(*item.effect, &EffectParameter::low, records)),
      high_(RangeEnd(*item.effect, &EffectParameter::high, records)),
      span_(high_ - low_),
      key_(std::move(key)),
      options_(options) {}

LoopForm EffectProfile::FormAt(const Eigen::VectorXd& u) const {
  LoopForm form = form_;
  std::vector<double>& values = form.effects.back().values;
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = FromSearch(effect().parameters()[i], u[static_cast<Eigen::Index>(i)]);
  }
  return form;
}

double EffectProfile::PosteriorWithout(std::size_t e) const {
  return from_.fit.points[e].log_posterior + records_.LogJacobianOfWhole(from_.model, e);
}

double EffectProfile::Known(double log_posterior) const {
  if (known_ == MaximumKnown::kClosely) return PointFitOptions{}.converged;
  double gained = log_posterior;
  for (std::size_t e = 0; e < records_.size(); ++e) gained -= PosteriorWithout(e);
  return std::max(kToTheMaximum.converged, UnknownOfTrial(gained));
}

EffectPoint EffectProfile::At(const Eigen::VectorXd& u,
                              const std::vector<Eigen::VectorXd>& starts) {
  return At(u, starts, {}, RecordExtent::kWhole);
}

EffectPoint EffectProfile::At(const Eigen::VectorXd& u, const std::vector<Eigen::VectorXd>& starts,
                              const PointFitOptions& options, RecordExtent extent) {
  const std::string key = key_ + std::to_string(evaluations_++) + "/";
  const LoopForm form = FormAt(u);
  EffectPoint out;
  out.u = u;
  out.fits.resize(records_.size());
  out.log_jacobian.resize(records_.size());
  RunUnits(records_.size(), options_.threads, [&](std::size_t e) {
    const bool of_middle = extent == RecordExtent::kMiddle;
    const RecordSpectra whole = of_middle ? records_.Whole(form, e) : records_.WholeAlone(form, e);
    const RecordSpectra& record = of_middle ? MiddleOf(whole) : whole;
    out.log_jacobian[e] = LogJacobian(record, form.effects);
    out.fits[e] = KeptFit(options_.units, key + std::to_string(e), [&] {
      const bool compared = known_ == MaximumKnown::kRoughly && !of_middle;
      return FitPoint(
          record, form.structure, PriorOfTrial(records_, from_, form, e, record), starts[e],
          compared ? ToCompareWith(PosteriorWithout(e) - out.log_jacobian[e]) : options);
    });
  });
  out.SumUp();
  return out;
}

Eigen::VectorXd EffectProfile::NullEnd() const {
  return ToSearch(effect(), NullValues(effect())).cwiseMin(high_);
}

Eigen::VectorXd EffectProfile::StepFrom(const Eigen::VectorXd& u, const Eigen::VectorXd& slope,
                                        const Eigen::MatrixXd& information,
                                        double longest_step) const {
  // A parameter at its range's end that would leave it stays, and the others go without it.
  Eigen::VectorXd free = span_;
  Eigen::VectorXd step = Eigen::VectorXd::Zero(u.size());
  for (Eigen::Index round = 0; round <= u.size(); ++round) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> in_spans(free.asDiagonal() * information *
                                                                  free.asDiagonal());
    const Eigen::VectorXd along =
        in_spans.eigenvectors().transpose() * free.cwiseProduct(slope).eval();
    const Eigen::VectorXd size = in_spans.eigenvalues().cwiseAbs().cwiseMax(kFlat);
    step = free.cwiseProduct(in_spans.eigenvectors() * along.cwiseQuotient(size));
    const double longest = step.cwiseQuotient(span_).cwiseAbs().maxCoeff();
    step *= std::min(1.0, longest_step / longest);
    bool leaves = false;
    for (Eigen::Index i = 0; i < u.size(); ++i) {
      const bool out = (u[i] <= low_[i] && step[i] < 0.0) || (u[i] >= high_[i] && step[i] > 0.0);
      if (out) free[i] = 0.0;
      leaves = leaves || out;
    }
    if (!leaves) break;
  }
  return (u + step).cwiseMax(low_).cwiseMin(high_) - u;
}

ProfileMaximum EffectProfile::From(EffectPoint best, double least) {
  ProfileMaximum out{std::move(best), Eigen::MatrixXd::Zero(span_.size(), span_.size())};
  double longest = kFirstStep;
  for (int i = 0; i < kMostSteps; ++i) {
    const std::vector<Slopes> slopes = SlopesAt(out.at, span_.size());
    Eigen::VectorXd slope = Eigen::VectorXd::Zero(span_.size());
    Eigen::MatrixXd information = Eigen::MatrixXd::Zero(span_.size(), span_.size());
    for (const Slopes& each : slopes) {
      slope += each.slope;
      information -= each.curvature;
    }
    if (!slope.allFinite() || !information.allFinite()) break;
    out.information = information;
    const Eigen::LLT<Eigen::MatrixXd> root(information);
    if (root.info() == Eigen::Success) {
      const double gain = 0.5 * slope.dot(root.solve(slope));
      if (gain < Known(out.at.log_posterior) || out.at.log_evidence + gain < least) break;
    }
    Eigen::VectorXd step = StepFrom(out.at.u, slope, information, longest);
    if (!(step.cwiseAbs().maxCoeff() > 0.0)) break;
    const Eigen::VectorXd from = out.at.u;
    const double before = out.at.log_posterior;
    bool as_foretold = false;
    for (int halved = 0; out.at.u == from && halved < kMostHalvings; ++halved, step *= 0.5) {
      std::vector<Eigen::VectorXd> starts = ParametersOf(out.at.fits);
      for (std::size_t e = 0; e < starts.size(); ++e) starts[e] += slopes[e].by * step;
      EffectPoint next = At(from + step, starts);
      const double gain = next.log_posterior - out.at.log_posterior;
      const double length = step.cwiseQuotient(span_).cwiseAbs().maxCoeff();
      as_foretold = gain > kAsForetold * step.dot(slope - 0.5 * information * step);
      longest = as_foretold ? std::max(longest, 2.0 * length) : length;
      if (gain > 0.0) out.at = std::move(next);
    }
    // Slopes tell fewer digits than values do, and foretell for ever what no step gains.
    if (!as_foretold && out.at.log_posterior < before + Known(before)) break;
  }
  return out;
}

}  // namespace howl

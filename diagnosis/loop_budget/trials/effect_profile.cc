#include "diagnosis/loop_budget/trials/effect_profile.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numbers>
#include <utility>

#include "diagnosis/loop_budget/forms/odds.h"
#include "estimation/parallel.h"
#include "estimation/record_fit/other_starts.h"
#include "estimation/record_fit/point_posterior.h"
#include "estimation/record_fit/spectra/middle_part.h"
#include "model/numerics/dense_algebra.h"

namespace howl {
namespace {

constexpr int kMostSteps = 20;
// A second parameter's values, as many as have a delay's maxima apart.
constexpr std::size_t kScanned = 24;
// How many of the best places are gone on from: to first order, or roughly fitted, they may be out
// of order. A resonance of p, of which the better of two starts was told by the last digits, ended
// with 250 nats from the one, with 2700 from the other.
constexpr std::size_t kMostFollowed = 2;
constexpr double kLongestBegin = 0.5;  // of the first parameter's range
constexpr int kMostHalvings = 5;
// The first step, of the search's range, so that fits follow; where one gained at least half of
// what was foretold the next may be twice as long (Conn, Gould & Toint 2000, chapter 6).
constexpr double kFirstStep = 0.03;
constexpr double kAsForetold = 0.5;
// Nats over the range squared, below which a profile is flat: no step is to be foretold from it.
constexpr double kFlat = 1e-6;
// Of the range: ten times as long differences see the third derivative, a tenth as long ones the
// last digits of sums over thousands of bins.
constexpr double kDifference = 1e-5;

// Of the cycles for which the catalogue's ranges and starts were made, those of the paper's rig: in
// seconds they go with the cycle's period, in Hz with its frequency.
constexpr double kCyclesOfCatalogue_hz = 210.0;

double FactorOf(const Effect& effect, const EffectParameter& parameter,
                const LoopRecords& records) {
  if (!effect.RangesGoWithCycle()) return 1.0;
  if (parameter.unit != "Hz" && parameter.unit != "s") return 1.0;
  double sum = 0.0;
  for (const double cycle_hz : records.cycle_hz()) sum += std::log(cycle_hz);
  const double cycles_hz = std::exp(sum / static_cast<double>(records.size()));
  return parameter.unit == "Hz" ? cycles_hz / kCyclesOfCatalogue_hz
                                : kCyclesOfCatalogue_hz / cycles_hz;
}

Eigen::VectorXd End(const LoopRecords& records, const Effect& effect,
                    double EffectParameter::*end) {
  std::vector<double> out;
  for (const EffectParameter& each : effect.parameters()) {
    out.push_back(FactorOf(effect, each, records) * each.*end);
  }
  return ToSearch(effect, out);
}

// Of each operating point the likelier fit, of two at the same values.
EffectPoint BetterAtEach(EffectPoint a, EffectPoint b) {
  for (std::size_t e = 0; e < a.fits.size(); ++e) {
    if (b.fits[e].log_posterior > a.fits[e].log_posterior) a.fits[e] = std::move(b.fits[e]);
  }
  a.SumUp();
  return a;
}

}  // namespace

double ToSearch(const EffectParameter& parameter, double value) {
  return parameter.scale == ParameterScale::kLogarithmic ? std::log(value) : value;
}

double FromSearch(const EffectParameter& parameter, double u) {
  return parameter.scale == ParameterScale::kLogarithmic ? std::exp(u) : u;
}

Eigen::VectorXd ToSearch(const Effect& effect, const std::vector<double>& values) {
  Eigen::VectorXd out(std::ssize(values));
  for (std::size_t i = 0; i < values.size(); ++i) {
    out[static_cast<Eigen::Index>(i)] = ToSearch(effect.parameters()[i], values[i]);
  }
  return out;
}

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
      form_(With(howl::Without(from.model, item, from.model), item)),
      known_(known),
      low_(End(records, *item.effect, &EffectParameter::low)),
      high_(End(records, *item.effect, &EffectParameter::high)),
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

double EffectProfile::Without(std::size_t e) const {
  return from_.fit.points[e].log_posterior + records_.LogJacobianOfWhole(from_.model, e);
}

double EffectProfile::Known(double log_posterior) const {
  if (known_ == MaximumKnown::kClosely) return PointFitOptions{}.converged;
  double gained = log_posterior;
  for (std::size_t e = 0; e < records_.size(); ++e) gained -= Without(e);
  return std::max(kToTheMaximum.converged, LeftByForms(gained));
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
    const RecordSpectra whole = records_.Whole(form, e);
    const RecordSpectra& record = extent == RecordExtent::kMiddle ? MiddleOf(whole) : whole;
    out.log_jacobian[e] = LogJacobian(record, form.effects);
    out.fits[e] = KeptFit(options_.units, key + std::to_string(e), [&] {
      const bool compared = known_ == MaximumKnown::kRoughly && extent == RecordExtent::kWhole;
      return FitPoint(record, form.structure, PriorOfTrial(records_, from_, form, e, record),
                      starts[e],
                      compared ? ToCompareWith(Without(e) - out.log_jacobian[e]) : options);
    });
  });
  out.SumUp();
  return out;
}

Eigen::VectorXd EffectProfile::NullEnd() const {
  return ToSearch(effect(), NullValues(effect())).cwiseMin(high_);
}

std::vector<EffectPoint> EffectProfile::Begin(const std::vector<Eigen::VectorXd>& at_null) {
  const Eigen::VectorXd null = NullEnd();
  const EffectParameter& parameter = effect().parameters()[0];
  if (null.size() > 1 && std::isfinite(parameter.null_value)) {
    return BeginFromNull(At(null, at_null));
  }
  std::vector<double> starts;
  const double factor = FactorOf(effect(), parameter, records_);
  for (const double start : parameter.starts) starts.push_back(ToSearch(parameter, factor * start));
  std::ranges::sort(starts, {}, [&](double u) { return std::abs(u - null[0]); });
  const auto roughly_at = [&](const Eigen::VectorXd& u, const std::vector<Eigen::VectorXd>& from) {
    return At(u, from, kToCompare, RecordExtent::kMiddle);
  };
  const EffectPoint at_rest = roughly_at(null, at_null);
  EffectPoint below = at_rest;
  EffectPoint above = at_rest;
  std::vector<EffectPoint> best;
  for (const double u : starts) {
    EffectPoint& last = u < null[0] ? below : above;
    Eigen::VectorXd beside = null;
    beside[0] = u;
    const bool is_first = last.u == null;
    last = roughly_at(beside, ParametersOf(last.fits));
    // From one value's loop the next value's may be missed: a low-pass of p was none where it had
    // 1400 nats, as the loops that came with its other starts were worse than that without it.
    if (!is_first) last = BetterAtEach(std::move(last), roughly_at(beside, at_null));
    if (last.log_posterior > at_rest.log_posterior) best.push_back(last);
  }
  if (best.empty()) return {At(null, at_null)};
  std::ranges::stable_sort(best, std::ranges::greater(), &EffectPoint::log_posterior);
  best.resize(std::min(best.size(), kMostFollowed));
  std::vector<std::vector<Eigen::VectorXd>> whole(best.size());
  for (std::size_t e = 0; e < records_.size(); ++e) {
    const RecordSpectra record = records_.Whole(form_, e);
    for (std::size_t k = 0; k < best.size(); ++k) {
      whole[k].push_back(BesideMiddle(record, form_.structure, best[k].fits[e].parameters));
    }
  }
  std::vector<EffectPoint> out;
  for (std::size_t k = 0; k < best.size(); ++k) {
    out.push_back(At(best[k].u, whole[k]));
    AgainFromNull(at_null, &out.back());
  }
  return out;
}

void EffectProfile::AgainFromNull(const std::vector<Eigen::VectorXd>& at_null, EffectPoint* point) {
  const LoopForm form = FormAt(point->u);
  const std::string key = key_ + "again/" + std::to_string(evaluations_) + "/";
  RunUnits(records_.size(), options_.threads, [&](std::size_t e) {
    PointFit& fit = point->fits[e];
    if (fit.log_posterior + point->log_jacobian[e] > Without(e) - kWorthAnother) return;
    PointFit again = KeptFit(options_.units, key + std::to_string(e), [&] {
      const RecordSpectra whole = records_.WholeAlone(form, e);
      return FitPoint(whole, form.structure, PriorOfTrial(records_, from_, form, e, whole),
                      at_null[e]);
    });
    if (again.log_posterior > fit.log_posterior) fit = std::move(again);
  });
  point->SumUp();
}

std::vector<EffectPoint> EffectProfile::BeginFromNull(const EffectPoint& null) {
  struct Beside {
    Eigen::VectorXd u;
    double gain = 0.0;
    std::vector<Eigen::VectorXd> starts;
  };
  std::vector<Beside> tried(kScanned);
  for (std::size_t i = 0; i < tried.size(); ++i) {
    EffectPoint at = null;
    const double way = static_cast<double>(i) / static_cast<double>(kScanned - 1);
    at.u[1] = low_[1] + way * span_[1];
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
    tried[i].gain = step * (slope + 0.5 * step * curvature);
    tried[i].u = at.u;
    tried[i].u[0] += step;
    tried[i].starts = ParametersOf(null.fits);
    for (std::size_t e = 0; e < slopes.size(); ++e) {
      tried[i].starts[e] += step * slopes[e].by.col(0);
    }
  }
  std::vector<Beside> best;
  for (std::size_t i = 0; i < tried.size(); ++i) {
    const bool top = (i == 0 || tried[i].gain >= tried[i - 1].gain) &&
                     (i + 1 == tried.size() || tried[i].gain > tried[i + 1].gain);
    if (top && tried[i].gain > 0.0) best.push_back(tried[i]);
  }
  std::ranges::stable_sort(best, std::ranges::greater(), &Beside::gain);
  best.resize(std::min(best.size(), kMostFollowed));
  std::vector<EffectPoint> out;
  for (const Beside& each : best) out.push_back(At(each.u, each.starts));
  if (out.empty()) out.push_back(null);
  return out;
}

EffectProfile::Slopes EffectProfile::SlopesOfPoint(const EffectPoint& point, std::size_t e,
                                                   Eigen::Index count) const {
  struct Beside {
    double value = 0.0;
    Eigen::VectorXd gradient;
  };
  const PointFit& fit = point.fits[e];
  const auto beside = [&](const Eigen::VectorXd& u, bool with_gradient) {
    const LoopForm form = FormAt(u);
    const RecordSpectra record = records_.WholeAlone(form, e);
    const PointPrior prior = PriorOfTrial(records_, from_, form, e, record);
    PointPosterior posterior(record, form.structure, prior);
    Beside out{posterior.Value(fit.parameters) + records_.LogJacobianOfWhole(form, e), {}};
    if (with_gradient) {
      out.gradient = posterior.Gradient(fit.parameters).cwiseQuotient(prior.deviation);
    }
    return out;
  };
  const Eigen::VectorXd steps = kDifference * span_;
  const double here = fit.log_posterior + records_.LogJacobianOfWhole(FormAt(point.u), e);
  Slopes out{Eigen::VectorXd(count), Eigen::MatrixXd(count, count), {}};
  Eigen::MatrixXd turns(fit.parameters.size(), count);
  Eigen::VectorXd uphill;
  std::vector<double> both(static_cast<std::size_t>(count));  // values on both sides
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::VectorXd step = steps[i] * Eigen::VectorXd::Unit(steps.size(), i);
    const Beside below = beside(point.u - step, true);
    const Beside above = beside(point.u + step, true);
    out.slope[i] = (above.value - below.value) / (2.0 * steps[i]);
    turns.col(i) = (above.gradient - below.gradient) / (2.0 * steps[i]);
    uphill = 0.5 * (above.gradient + below.gradient);
    both[static_cast<std::size_t>(i)] = above.value + below.value;
    out.curvature(i, i) = (above.value - 2.0 * here + below.value) / (steps[i] * steps[i]);
    for (Eigen::Index j = 0; j < i; ++j) {
      const Eigen::VectorXd along = step + steps[j] * Eigen::VectorXd::Unit(steps.size(), j);
      const double ends =
          beside(point.u + along, false).value + beside(point.u - along, false).value;
      out.curvature(i, j) = out.curvature(j, i) =
          (ends + 2.0 * here - both[static_cast<std::size_t>(i)] -
           both[static_cast<std::size_t>(j)]) /
          (2.0 * steps[i] * steps[j]);
    }
  }
  out.by = SolveSymmetric(fit.information, turns);
  out.slope += out.by.transpose() * uphill;
  out.curvature += turns.transpose() * out.by;
  return out;
}

std::vector<EffectProfile::Slopes> EffectProfile::SlopesAt(const EffectPoint& point,
                                                           Eigen::Index count) const {
  std::vector<Slopes> out(records_.size());
  RunUnits(out.size(), options_.threads,
           [&](std::size_t e) { out[e] = SlopesOfPoint(point, e, count); });
  return out;
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

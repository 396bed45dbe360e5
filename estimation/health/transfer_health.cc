#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "estimation/analysis/transfer/transfer_search.h"
#include "estimation/health/analysis_health.h"
#include "estimation/health/gain_health.h"
#include "estimation/health/mistake_search.h"
#include "estimation/health/number_words.h"
#include "estimation/parallel.h"

namespace howl {
namespace {

constexpr double kGoodFit = 2.0;  // chi-square a degree of freedom: no mistake is suspected below
constexpr double kNear = 1e-3;

enum class Undone : std::uint8_t { kSign, kOrder };

// -H or 1 / H. Errors turn and shrink as d(1 / H) = -dH / H^2 does.
Transfer WithoutMistake(Transfer transfer, Undone undone) {
  for (TransferPoint& point : transfer.points) {
    const std::complex<double> h(point.re, point.im);
    const std::complex<double> other = undone == Undone::kSign ? -h : 1.0 / h;
    const std::complex<double> slope =
        undone == Undone::kSign ? std::complex<double>(-1.0) : -other * other;
    Eigen::Matrix2d turn;
    turn << slope.real(), -slope.imag(), slope.imag(), slope.real();
    const Eigen::Matrix2d covariance = turn * point.Covariance() * turn.transpose();
    point.re = other.real();
    point.im = other.imag();
    point.variance_re = covariance(0, 0);
    point.variance_im = covariance(1, 1);
    point.covariance = covariance(0, 1);
    // The power of the channel that is then q.
    if (undone == Undone::kOrder) point.weight *= std::norm(h);
  }
  return transfer;
}

bool AtEnd(double xi) {
  return xi <= kTransferXiMin * (1.0 + kNear) || xi >= kTransferXiMax * (1.0 - kNear);
}

struct Costs {
  double given = 0.0;
  double sign = 0.0;
  double order = 0.0;

  void Add(const Costs& other) {
    given += other.given;
    sign += other.sign;
    order += other.order;
  }
};

// Half the chi-square.
double CostOf(const TransferFit& fit) {
  const auto fitted = std::ranges::count(fit.points, true, &TransferFitPoint::fitted);
  return fit.chi_square_per_dof * static_cast<double>(fitted);
}

// Infinite where there is no fit.
double CostWithout(const Transfer& transfer, Undone undone, const ModelSpec& model,
                   const TransferBand& band) {
  const TransferFit fit = FitTransfer(WithoutMistake(transfer, undone), model, band);
  const bool is_fit = fit.available && !AtEnd(fit.xi.value);
  return is_fit ? CostOf(fit) : std::numeric_limits<double>::infinity();
}

// The mistake without which the fit is far better, if there is one.
std::optional<Undone> Mistaken(const Costs& costs) {
  const auto better = [&](double after) {
    return costs.given - after > kMuchBetter && after < kMostLeft * costs.given;
  };
  if (better(costs.sign) && costs.sign <= costs.order) return Undone::kSign;
  if (better(costs.order)) return Undone::kOrder;
  return std::nullopt;
}

// `who`: one record, or empty for all.
Finding Accusation(const std::string& who, Undone undone, const Costs& costs) {
  const bool sign = undone == Undone::kSign;
  const double after = sign ? costs.sign : costs.order;
  return {FindingKind::kMistake,
          who,
          sign ? "inverted" : "p_and_q_swapped",
          costs.given,
          after,
          (who.empty() ? "the records look like " : who + " looks like ") +
              (sign ? "p or q with the wrong sign, as from an inverted transducer"
                    : "p and q taken for each other") +
              ": undone, the transfer's cost falls from " + NumberWord(costs.given) + " to " +
              NumberWord(after)};
}

// One finding for all records where every record with a transfer shows the same.
void AddMistakes(const AnalysisSet& set, std::span<const Costs> costs, Health& health) {
  for (const Undone undone : {Undone::kSign, Undone::kOrder}) {
    Costs all;
    bool every = true;
    Health single;
    for (std::size_t i = 0; i < costs.size(); ++i) {
      if (!set.analyses[i].transfer_fit) continue;
      all.Add(costs[i]);
      const bool mistaken = Mistaken(costs[i]) == undone;
      every = every && mistaken;
      if (mistaken) single.push_back(Accusation(set.analyses[i].name, undone, costs[i]));
    }
    if (every && !single.empty()) single = {Accusation({}, undone, all)};
    Append(std::move(single), health);
  }
}

// One finding for all records whose transfer the model misses.
void AddMisses(const AnalysisSet& set, const ModelSpec& model, Health& health) {
  double chi_least = std::numeric_limits<double>::infinity();
  double explained_least = chi_least;
  double chi_most = 0.0;
  double explained_most = 0.0;
  std::string only;
  int missed = 0;
  int fits = 0;
  for (const Analysis& analysis : set.analyses) {
    if (!analysis.transfer_fit) continue;
    ++fits;
    const TransferFit& fit = *analysis.transfer_fit;
    if (!(fit.chi_square_per_dof > kGoodFit)) continue;
    ++missed;
    only = analysis.name;
    chi_least = std::min(chi_least, fit.chi_square_per_dof);
    chi_most = std::max(chi_most, fit.chi_square_per_dof);
    explained_least = std::min(explained_least, fit.explained_power);
    explained_most = std::max(explained_most, fit.explained_power);
  }
  if (missed == 0) return;
  if (missed > 1) only.clear();
  const auto range = [&](double low, double high) {
    return NumberWord(low) + (missed > 1 ? " .. " + NumberWord(high) : "");
  };
  constexpr double kPerCent = 100.0;
  health.push_back({FindingKind::kResidual, only, "transfer", chi_most, kGoodFit,
                    (missed > 1 ? "the q-to-p transfers of " + std::to_string(missed) + " of " +
                                      std::to_string(fits) + " records are not those of "
                                : only + ": the q-to-p transfer is not that of ") +
                        (model.modes == 2 ? "two modes" : "one mode") + ": chi2/dof " +
                        range(chi_least, chi_most) + ", which is 1 where the model is right, and " +
                        range(kPerCent * explained_least, kPerCent * explained_most) +
                        " % explained; omega, xi and N of such a fit describe it, not the rig"});
}

}  // namespace

Health CheckTransfers(const AnalysisSet& set, const AnalysisOptions& options) {
  Health health;
  if (!options.model) return health;
  std::vector<Costs> costs(set.analyses.size());
  RunUnits(costs.size(), options.threads, [&](std::size_t i) {
    const Analysis& analysis = set.analyses[i];
    if (!analysis.transfer_fit) return;
    const TransferFit& fit = *analysis.transfer_fit;
    Costs& mine = costs[i];
    mine.given = CostOf(fit);
    mine.sign = mine.order = mine.given;
    if (fit.chi_square_per_dof < kGoodFit) return;
    const double f = analysis.characteristics.frequency_hz.value;
    const TransferBand band = std::isfinite(f) ? TransferBandOf(*options.model, f) : TransferBand{};
    mine.sign = CostWithout(*analysis.transfer, Undone::kSign, *options.model, band);
    mine.order = CostWithout(*analysis.transfer, Undone::kOrder, *options.model, band);
  });
  AddMistakes(set, costs, health);
  AddMisses(set, *options.model, health);
  for (const Analysis& analysis : set.analyses) {
    if (!analysis.transfer_fit || !AtEnd(analysis.transfer_fit->xi.value)) continue;
    const double xi = analysis.transfer_fit->xi.value;
    health.push_back({FindingKind::kGuardRail, analysis.name, "transfer.xi", xi,
                      xi < 1.0 ? kTransferXiMin : kTransferXiMax,
                      analysis.name + ": xi of the transfer stands at " + NumberWord(xi) +
                          ", where its search ends: this transfer holds no damping"});
  }
  return health;
}

Health CheckAnalysis(std::span<const NamedRecord> records, const AnalysisSet& set,
                     const AnalysisOptions& options, std::span<const RateSource> sources) {
  Health health = CheckTransfers(set, options);
  std::vector<Health> each(records.size());
  RunUnits(records.size(), options.threads, [&](std::size_t i) {
    const RateSource source = sources.empty() ? RateSource::kNumber : sources[i];
    each[i] = CheckSampling(records[i], set.analyses[i], options, source);
    Append(CheckState(set.analyses[i], options.characteristics), each[i]);
  });
  for (Health& one : each) Append(std::move(one), health);
  std::vector<NamedGain> gains;
  for (std::size_t i = 0; i < records.size(); ++i) {
    const Characteristics& cycle = set.analyses[i].characteristics;
    if (cycle.state == CycleState::kNoLimitCycle || records[i].record.heat_release.empty())
      continue;
    gains.push_back({records[i].name, cycle.gain.value});
  }
  Append(CheckGains(std::move(gains)), health);
  return health;
}

}  // namespace howl

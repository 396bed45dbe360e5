#include "diagnosis/fit/effect_fit.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "diagnosis/fit/delay_scatter.h"
#include "diagnosis/fit/fit_starts.h"
#include "diagnosis/fit/fitter.h"
#include "diagnosis/numerics/scaled_solve.h"

namespace howl {
namespace {

constexpr int kFirstRoundIterations = 7;
constexpr int kLaterRoundIterations = 8;
constexpr int kMostRounds = 30;
constexpr int kIdleRounds = 2;
constexpr int kMostRestarts = 3;
constexpr double kConverged = 0.1;  // nats between two rounds
constexpr std::size_t kStartsKept = 2;
constexpr int kPreliminaryIterations = 4;

class NoEffect final : public NamedEffect {
 public:
  NoEffect() : NamedEffect("none", LoopBlock::kAcoustics, {}) {}
  bool ChangesAcousticCut() const override { return true; }
  bool ChangesFlameCut() const override { return true; }
};

}  // namespace

EffectPointer BaseEffect() {
  static const EffectPointer base = std::make_shared<NoEffect>();
  return base;
}

namespace {

// Descents at fixed noise alternate with refits of the noise until neither lowers the cost. Where
// noise is a millionth of the signal, the first rounds still lower the cost by thousands. Where the
// model is far from the rig the cost may oscillate by some nats, because a descent lowers the
// squares alone and a refit the noise's cost alone; therefore the best of the rounds is kept.
// A round that leaves the cost where it was would leave it there again.
void Alternate(Fitter* fitter, EffectFit* fit) {
  EffectFit best = *fit;
  double least = std::numeric_limits<double>::infinity();
  int idle = 0;
  double before = std::numeric_limits<double>::infinity();
  for (int round = 0; round < kMostRounds && idle < kIdleRounds; ++round) {
    fitter->Descend(fit, kLaterRoundIterations);
    fitter->RefitScatter(fit);
    fitter->RefitNoise(fit);
    VLOG(3) << fit->effect->id() << ", round " << round << ": cost " << fit->cost();
    idle = fit->cost() < least - kConverged ? 0 : idle + 1;
    if (fit->cost() < least) {
      least = fit->cost();
      best = *fit;
    }
    if (std::abs(fit->cost() - before) < kDescentConverged) break;
    before = fit->cost();
  }
  *fit = std::move(best);
  fitter->SetNoise(*fit);
}

// Alternates until convergence from here and from further starts of the experiments' own
// parameters. The starts are judged by where they end, because a noise that was fitted at a bad
// start hides how bad it is. Where a start led to a better end the search is repeated, because
// other experiments may be better off there too.
void ConvergeLocals(Fitter* fitter, EffectFit* fit) {
  Alternate(fitter, fit);
  for (int restart = 0; restart < kMostRestarts; ++restart) {
    EffectFit other = *fit;
    if (!fitter->RestartLocals(&other)) break;
    fitter->RefitNoise(&other);
    Alternate(fitter, &other);
    if (!(other.cost() < fit->cost() - kConverged)) break;
    *fit = std::move(other);
  }
  fitter->SetNoise(*fit);
}

EffectFit ConvergedBase(const std::vector<CutRecord>& records,
                        const std::vector<FlameColumns>& columns, EffectFit fit) {
  Fitter fitter(records, *fit.effect, &columns);
  fitter.SetNoise(fit);
  fitter.Descend(&fit, kLaterRoundIterations);
  fitter.RefitNoise(&fit);
  ConvergeLocals(&fitter, &fit);
  fitter.Finish(&fit, nullptr);
  return fit;
}

EffectFit BaseFromGrid(const std::vector<CutRecord>& records,
                       const std::vector<FlameColumns>& columns) {
  EffectFit fit;
  fit.effect = BaseEffect();
  fit.tau_s = StartDelay(records, columns);
  fit.experiments.resize(records.size());
  for (std::size_t e = 0; e < records.size(); ++e) {
    ExperimentFit& at = fit.experiments[e];
    at.acoustics = AcousticStarts(records[e], *fit.effect, {}, 1)[0];
    at.acoustic_noise = Eigen::VectorXd::Ones(records[e].acoustic_count);
    at.flame_noise = Eigen::VectorXd::Ones(records[e].flame_count);
  }
  return ConvergedBase(records, columns, std::move(fit));
}

}  // namespace

// A model with two modes contains the model with one, so it must fit no worse, whatever the grid
// led to. It is therefore fitted from the one-mode fit as well, and takes that fit itself where no
// second mode is better.
EffectFit FitBase(const std::vector<CutRecord>& records) {
  const std::vector<FlameColumns> columns = BaseColumns(records);
  EffectFit fit = BaseFromGrid(records, columns);
  if (records[0].model.modes < 2) return fit;
  std::vector<CutRecord> one = records;
  for (CutRecord& record : one) record.model.modes = 1;
  EffectFit one_mode = BaseFromGrid(one, columns);
  for (const EffectFit& other : {ConvergedBase(records, columns, one_mode), one_mode}) {
    if (other.cost() < fit.cost() - kConverged) fit = other;
  }
  return fit;
}

namespace {

using EffectFits = std::vector<EffectFit>;

std::vector<FlameColumns> ColumnsFor(const std::vector<CutRecord>& records, const Effect& effect) {
  return effect.ChangesFlameCut() ? BaseColumns(records)
                                  : std::vector<FlameColumns>(records.size());
}

EffectFit StartOf(const std::vector<CutRecord>& records, const EffectPointer& effect,
                  const EffectFit& base, const std::vector<double>& values, bool own_locals) {
  EffectFit fit = base;
  fit.effect = effect;
  fit.values = values;
  if (effect->ChangesFlameCut()) {
    std::vector<EffectContext> points;
    for (const CutRecord& record : records) points.push_back(record.at);
    fit.tau_s = CorrectedDelay(points, *effect, values, base.tau_s);
  }
  if (effect->ChangesAcousticCut() && own_locals) {
    for (std::size_t e = 0; e < records.size(); ++e) {
      fit.experiments[e].acoustics = AcousticStarts(records[e], *effect, values, 1)[0];
    }
  }
  return fit;
}

bool Cheaper(const EffectFit& a, const EffectFit& b) { return a.cost() < b.cost(); }

void KeepBest(std::size_t count, EffectFits* fits) {
  std::sort(fits->begin(), fits->end(), Cheaper);
  if (fits->size() > count) fits->pop_back();
}

EffectFit ConvergeBest(EffectFits fits, const EffectFit& base, Fitter* fitter) {
  for (EffectFit& fit : fits) {
    fitter->SetNoise(fit);
    ConvergeLocals(fitter, &fit);
  }
  EffectFit best = *std::min_element(fits.begin(), fits.end(), Cheaper);
  fitter->SetNoise(best);
  fitter->Finish(&best, &base);
  return best;
}

}  // namespace

EffectFit FitEffect(const std::vector<CutRecord>& records, const EffectPointer& effect,
                    const EffectFit& base) {
  const std::vector<FlameColumns> columns = ColumnsFor(records, *effect);
  Fitter fitter(records, *effect, &columns);
  EffectFits kept;
  const auto follow = [&](const StartList& starts, bool own_locals) {
    for (const std::vector<double>& values : starts) {
      EffectFit fit = StartOf(records, effect, base, values, own_locals);
      fitter.SetNoise(base);
      fitter.Descend(&fit, kFirstRoundIterations);
      fitter.RefitScatter(&fit);
      fitter.RefitNoise(&fit);
      VLOG(2) << effect->id() << (own_locals ? ", a start: cost " : ", a scanned start: cost ")
              << fit.cost();
      kept.push_back(std::move(fit));
      KeepBest(kStartsKept, &kept);
    }
  };
  follow(StartValues(*effect, {}), true);
  // Scanned starts were found with all else at the base's values, which need not be refitted first.
  follow(ScannedStarts(effect, base, &fitter), false);
  return ConvergeBest(std::move(kept), base, &fitter);
}

double GainOver(const EffectFit& base, const EffectFit& fit) {
  return base.cost() - fit.cost() -
         UnearnedFreedom(base.freedom_cost, fit.freedom_cost, fit.experiments.size(),
                         fit.values.size());
}

EffectFit PreliminaryFit(const std::vector<CutRecord>& records, const EffectPointer& combined,
                         const EffectFit& base, const EffectFit& first) {
  const std::vector<FlameColumns> columns = ColumnsFor(records, *combined);
  Fitter fitter(records, *combined, &columns);
  EffectFits kept;
  for (const std::vector<double>& values : StartValues(*combined, first.values)) {
    fitter.SetNoise(first);
    EffectFit fit = StartOf(records, combined, base, values, true);
    // Where the second effect changes little, the first's fit has the nearer local parameters.
    EffectFit near = fit;
    near.experiments = first.experiments;
    if (fitter.Evaluate(&near) < fitter.Evaluate(&fit)) fit = std::move(near);
    fitter.Descend(&fit, kPreliminaryIterations);
    fitter.RefitScatter(&fit);
    fitter.RefitNoise(&fit);
    kept.push_back(std::move(fit));
    KeepBest(1, &kept);
  }
  return std::move(kept[0]);
}

EffectFit ConvergedFit(const std::vector<CutRecord>& records, const EffectFit& base,
                       const EffectFit& preliminary) {
  const std::vector<FlameColumns> columns = ColumnsFor(records, *preliminary.effect);
  Fitter fitter(records, *preliminary.effect, &columns);
  return ConvergeBest({preliminary}, base, &fitter);
}

namespace {

// Where the other experiments leave the shared parameters uncertain, their prediction is uncertain
// too: it has the covariance V + J C J', where C is that of the parameters from the others, and
//
//   r' (V + J C J')^-1 r = min over d of |r - J d|^2 / V + d' C^-1 d.
//
// The minimum is the fit to all experiments; the shift to it costs the others shift' rest shift.
// Returned is the fraction of the shift that costs the held-out experiment as much.
double Contradiction(const Eigen::MatrixXd& rest, const Eigen::MatrixXd& own,
                     const Eigen::VectorXd& shift) {
  const double to_the_rest = shift.dot(rest * shift);
  const double to_the_own = shift.dot(own * shift);
  return to_the_own > to_the_rest ? std::sqrt(std::max(to_the_rest, 0.0) / to_the_own) : 1.0;
}

}  // namespace

ExperimentFit HeldOut(const std::vector<CutRecord>& records, const EffectFit& fit,
                      std::size_t experiment) {
  EffectFit moved = fit;
  const Eigen::Index d = fit.experiments[0].gradient.size();
  Eigen::MatrixXd rest = Eigen::MatrixXd::Zero(d, d);
  for (std::size_t e = 0; e < records.size(); ++e) {
    if (e != experiment) rest += fit.experiments[e].curvature;
  }
  Eigen::VectorXd shift = SolveScaled(rest, fit.experiments[experiment].gradient, 1e-6);
  shift *= Contradiction(rest, fit.experiments[experiment].curvature, shift);
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
  // The experiment's own parameters are refitted in all cuts that the effect or the delay changes.
  fitter.DescendLocals(&moved, experiment);
  return moved.experiments[experiment];
}

std::vector<ExperimentFit> HoldOutEach(const std::vector<CutRecord>& records,
                                       const EffectFit& fit) {
  std::vector<ExperimentFit> out;
  for (std::size_t e = 0; e < records.size(); ++e) out.push_back(HeldOut(records, fit, e));
  return out;
}

}  // namespace howl

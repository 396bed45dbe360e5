#include "diagnosis/declip/unclipped_samples.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "diagnosis/cuts/acoustic_modulation.h"
#include "diagnosis/fit/fitter.h"
#include "diagnosis/numerics/scaled_solve.h"
#include "diagnosis/records/band_signal.h"
#include "estimation/parallel.h"

namespace howl {
namespace {

constexpr int kMostSteps = 40;
constexpr double kLeastProgress = 1e-3;  // of the cost
constexpr double kFirstDamping = 1e-3;
constexpr double kMostDamping = 1e6;
constexpr double kDifferenceStep = 1e-5;
constexpr Eigen::Index kLocals = 4;

// Each experiment is weighted by its own error.
double Cost(const std::vector<UnclippedSamples>& experiments, const std::vector<double>& squares) {
  double cost = 0.0;
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    cost += 0.5 * experiments[e].weight().sum() *
            std::log(std::max(squares[e], std::numeric_limits<double>::min()));
  }
  return cost;
}

struct Normal {
  Eigen::MatrixXd gram;
  Eigen::VectorXd right;
};

// Columns: the experiment's locals, then the effect's parameters in the search's coordinates.
Normal Linearise(const UnclippedSamples& at, const CutRecord& filled, const Effect& effect,
                 const std::vector<double>& values, const AcousticLocals& locals,
                 const Eigen::ArrayXd& error) {
  const Eigen::ArrayXd root = at.weight().sqrt();
  const auto d = static_cast<Eigen::Index>(values.size());
  Eigen::MatrixXd columns(error.size(), kLocals + d);
  for (Eigen::Index i = 0; i < kLocals; ++i) {
    if (!IsFree(filled.model, i)) {
      columns.col(i).setZero();
      continue;
    }
    const double step = kDifferenceStep * (i < 2 ? 1.0 : std::max(std::abs(locals[2]), 1e-12));
    AcousticLocals moved = locals;
    moved[i] += step;
    columns.col(i) = (at.Error(filled, effect, values, moved) - error) / step * root;
  }
  std::vector<double> moved = values;
  for (std::size_t j = 0; j < values.size(); ++j) {
    const EffectParameter& p = effect.parameters()[j];
    const double step = DifferenceStep(p, values[j]);
    moved[j] = values[j] + step;
    columns.col(kLocals + static_cast<Eigen::Index>(j)) =
        (at.Error(filled, effect, moved, locals) - error) / step * ScaleOf(p, values[j]) * root;
    moved[j] = values[j];
  }
  const double scale = at.weight().sum() / at.WeightedSquares(error);
  return {scale * columns.transpose() * columns,
          scale * columns.transpose() * (error * root).matrix()};
}

PlateauFit Stepped(const PlateauFit& at, const Effect& effect, const Eigen::VectorXd& step) {
  PlateauFit out = at;
  Eigen::Index first = 0;
  for (AcousticLocals& locals : out.locals) {
    AcousticLocals by = step.segment<kLocals>(first);
    by[0] = std::clamp(by[0], -0.1, 0.1);
    by[1] = std::clamp(by[1], -0.5, 0.5);
    locals += by;
    first += kLocals;
  }
  for (std::size_t j = 0; j < out.values.size(); ++j) {
    out.values[j] = SteppedValue(effect.parameters()[j], at.values[j],
                                 step[first + static_cast<Eigen::Index>(j)]);
  }
  return out;
}

}  // namespace

UnclippedSamples::UnclippedSamples(const CutRecord& recorded)
    : recorded_(recorded), plateaus_(FindPlateaus(recorded.pressure)) {
  const auto n = static_cast<double>(recorded.samples);
  weight_ = (Eigen::ArrayXd::LinSpaced(recorded.samples, 0.5, n - 0.5) * (std::numbers::pi / n))
                .sin()
                .square() *
            (1.0 - plateaus_.upper - plateaus_.lower);
}

Eigen::ArrayXd UnclippedSamples::Error(const CutRecord& filled, const Effect& effect,
                                       EffectValues x, const AcousticLocals& locals) const {
  Eigen::VectorXcd p =
      RecordedTransfer(filled, effect, x, locals).cwiseProduct(filled.driving_heat_release);
  const Eigen::VectorXcd moved = PressureOfMovement(filled, effect, x, locals);
  if (moved.size() > 0) p += moved;
  const Eigen::Index start = filled.first - kTapReach;
  for (Eigen::Index k = 0; k < filled.acoustic_count; ++k) {
    if (!filled.masked[static_cast<std::size_t>(k)]) continue;
    p[k + kTapReach] = filled.pressure_spectrum[start + k + kTapReach];
  }
  Eigen::ArrayXd error = recorded_.pressure.array() - InTime(filled, p).array();
  error -= (weight_ * error).sum() / weight_.sum();
  return error;
}

Eigen::VectorXd UnclippedSamples::Fill(const Eigen::ArrayXd& error) const {
  const Eigen::ArrayXd recorded = recorded_.pressure.array();
  const Eigen::ArrayXd model = recorded - error;
  const Eigen::ArrayXd filled =
      (1.0 - plateaus_.upper - plateaus_.lower) * recorded +
      plateaus_.upper * (model > plateaus_.upper_level).select(model, recorded) +
      plateaus_.lower * (model < plateaus_.lower_level).select(model, recorded);
  return filled - filled.mean();
}

PlateauFit FitUnclippedSamples(const std::vector<UnclippedSamples>& experiments,
                               const std::vector<CutRecord>& filled, const Effect& effect,
                               PlateauFit start, int threads) {
  const auto d = static_cast<Eigen::Index>(start.values.size());
  const auto shared = kLocals * static_cast<Eigen::Index>(experiments.size());
  std::vector<Eigen::ArrayXd> errors(experiments.size());
  std::vector<double> squares(experiments.size());
  const auto evaluate = [&](const PlateauFit& at, std::vector<Eigen::ArrayXd>* to) {
    RunUnits(experiments.size(), threads, [&](std::size_t e) {
      (*to)[e] = experiments[e].Error(filled[e], effect, at.values, at.locals[e]);
      squares[e] = experiments[e].WeightedSquares((*to)[e]);
    });
    return Cost(experiments, squares);
  };
  PlateauFit best = std::move(start);
  best.cost = evaluate(best, &errors);
  std::vector<Eigen::ArrayXd> next(experiments.size());
  double damping = kFirstDamping;
  for (int i = 0; i < kMostSteps && damping < kMostDamping; ++i) {
    std::vector<Normal> each(experiments.size());
    RunUnits(experiments.size(), threads, [&](std::size_t e) {
      each[e] =
          Linearise(experiments[e], filled[e], effect, best.values, best.locals[e], errors[e]);
    });
    Normal all{Eigen::MatrixXd::Zero(shared + d, shared + d), Eigen::VectorXd::Zero(shared + d)};
    for (std::size_t e = 0; e < experiments.size(); ++e) {
      const Normal& own = each[e];
      const Eigen::Index at = kLocals * static_cast<Eigen::Index>(e);
      all.gram.block(at, at, kLocals, kLocals) = own.gram.topLeftCorner(kLocals, kLocals);
      all.gram.block(at, shared, kLocals, d) = own.gram.topRightCorner(kLocals, d);
      all.gram.block(shared, at, d, kLocals) = own.gram.bottomLeftCorner(d, kLocals);
      all.gram.bottomRightCorner(d, d) += own.gram.bottomRightCorner(d, d);
      all.right.segment(at, kLocals) = own.right.head(kLocals);
      all.right.tail(d) += own.right.tail(d);
    }
    double progress = 0.0;
    while (damping < kMostDamping) {
      PlateauFit moved = Stepped(best, effect, -SolveScaled(all.gram, all.right, damping));
      moved.cost = evaluate(moved, &next);
      if (moved.cost < best.cost) {
        progress = best.cost - moved.cost;
        best = std::move(moved);
        std::swap(errors, next);
        damping = std::max(0.1 * damping, 1e-12);
        break;
      }
      damping *= 10.0;
    }
    if (progress < kLeastProgress) break;
  }
  return best;
}

}  // namespace howl

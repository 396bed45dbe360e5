#include "diagnosis/loop_budget/account/loop_held_out.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include "diagnosis/held_out/record_signals.h"
#include "estimation/parallel.h"
#include "estimation/record_fit/fit_under_prior.h"
#include "estimation/record_fit/loop/loop_residuals.h"
#include "estimation/unit_seed.h"
#include "model/noise/random_stream.h"
#include "model/numerics/dense_algebra.h"

namespace howl {
namespace {

constexpr int kDraws = 8;
constexpr double kStep = 1e-3;  // of a draw

// With what the modes hold at this record's ends: E_A is linear in it, so that one step is exact.
Eigen::VectorXd WithTransientsOf(const RecordSpectra& record, const PointStructure& structure,
                                 const PointPrior& prior, Eigen::VectorXd parameters) {
  const Eigen::Index first = structure.Transfer();
  const Eigen::Index count = structure.Transients();
  parameters.segment(first, count).setZero();
  const LoopPoint point = ToPoint(structure, record.flame.cols(), parameters);
  const LoopResiduals residuals = ResidualsOf(record, structure, point);
  const LoopDerivatives derivatives = DerivativesOf(record, structure, point);
  Eigen::MatrixXd information =
      WhittleInformation(structure.noise, record.share, residuals, derivatives)
          .block(first, first, count, count);
  information.diagonal() += prior.deviation.segment(first, count).cwiseAbs2().cwiseInverse();
  parameters.segment(first, count) = SolveSymmetric(
      information,
      WhittleGradient(structure.noise, record.share, residuals, derivatives).segment(first, count));
  return parameters;
}

// Of the signals as they were recorded, by which `record` moves so at each bin (ByRecorded): what
// an instrument takes out of one of them is foretold by no loop. `off`: of P, by bin.
void SetErrors(const RecordSpectra& record, const std::vector<Eigen::Matrix2cd>& by_recorded,
               const PointStructure& structure, const Eigen::VectorXd& parameters,
               const Eigen::VectorXcd& off, PredictedSignals* signals) {
  const LoopPoint point = ToPoint(structure, record.flame.cols(), parameters);
  const LoopResiduals residuals = ResidualsOf(record, structure, point);
  signals->pressure_error.resize(record.bins());
  signals->heat_release_error.resize(record.bins());
  for (Eigen::Index i = 0; i < record.bins(); ++i) {
    const Eigen::Matrix2cd w = NoiseCovariance(structure.noise, residuals, i).inverse();
    Eigen::Matrix2cd cuts;
    cuts << 1.0, -residuals.r[i], -residuals.f[i], 1.0;
    const Eigen::Matrix2cd by = cuts * by_recorded[static_cast<std::size_t>(i)];
    SetPredictionErrors(
        {residuals.acoustic[i] + off[i], residuals.flame[i] - residuals.f[i] * off[i]}, w,
        by.col(0), by.col(1), i, signals);
  }
}

// P's error where samples stand in the place of lost ones, as far as a free transfer foretells it:
// this half's, and at most as much again that parameters took from the other half's.
Eigen::VectorXcd DrawOff(const RecordSpectra& record, const Eigen::VectorXd& power,
                         RandomStream* random) {
  Eigen::VectorXcd out = Eigen::VectorXcd::Zero(record.bins());
  for (Eigen::Index i = 0; i < power.size(); ++i) {
    const double real = random->Normal();
    out[i] = std::sqrt(power[i]) * std::complex<double>(real, random->Normal()) /
             ValueAt(record.pressure_instrument, record.s[i]);
  }
  return out;
}

// The spread is that of parameters drawn from what the other half tells of them, and of samples in
// the place of lost ones, to first order: what moves a prediction but little is taken to move it in
// proportion.
std::vector<BandErrors> ErrorsOf(const RecordSpectra& recorded, const RecordSpectra& record,
                                 const LoopForm& form, const Eigen::VectorXd& at,
                                 const Eigen::MatrixXd& information,
                                 const Eigen::VectorXd& foretold_errors, std::uint64_t seed) {
  const PointStructure& structure = form.structure;
  std::vector<Eigen::Matrix2cd> by_recorded;
  for (const std::complex<double> s : record.s) {
    by_recorded.push_back(ByRecorded(form.effects, record.scale.cycle_hz, s));
  }
  PredictedSignals signals = SignalsOf(recorded);
  SetErrors(record, by_recorded, structure, at, Eigen::VectorXcd::Zero(record.bins()), &signals);
  PredictedSignals moved = signals;
  std::vector<BandErrors> out = ErrorsOverBands(signals);
  const Eigen::LLT<Eigen::MatrixXd> root(information);
  RandomStream random(seed);
  for (int draw = 0; draw < kDraws; ++draw) {
    Eigen::VectorXd step(at.size());
    for (double& each : step) each = random.Normal();
    root.matrixU().solveInPlace(step);
    // What this half holds at its ends is its own.
    step.segment(structure.Transfer(), structure.Transients()).setZero();
    const Eigen::VectorXcd off = kStep * DrawOff(record, foretold_errors, &random);
    SetErrors(record, by_recorded, structure, at + kStep * step, off, &moved);
    AddSpread(signals, moved, 1.0 / (kStep * kStep * kDraws), &out);
  }
  return out;
}

}  // namespace

HeldOutScore ScoreHeldOut(const LoopRecords& records, const LoopFit& fit, const std::string& key,
                          const LoopBudgetOptions& options) {
  const PointStructure& structure = fit.model.structure;
  const std::vector<PointPrior> prior =
      records.size() == 1 ? fit.fit.prior
                          : PriorsOfOthers(records.Points(fit.model), fit.fit, options.threads);
  LoopForm as_recorded = fit.model;
  as_recorded.effects.clear();
  HeldOutScore out;
  out.nats.resize(records.size());
  out.errors.resize(records.size());
  RunUnits(2 * records.size(), options.threads, [&](std::size_t i) {
    const std::size_t e = i / 2;
    const std::size_t half = i % 2;
    const PointFit of_other = KeptFit(
        options.units, key + "half/" + std::to_string(1 - half) + "/" + std::to_string(e), [&] {
          // As the whole record was: what one start alone misses would pass for a gap.
          return FitUnder(records.Half(fit.model, e, 1 - half), structure, prior[e],
                          fit.fit.points[e].parameters, records.size() > 1);
        });
    const RecordSpectra here = records.Half(fit.model, e, half);
    const Eigen::VectorXd at = WithTransientsOf(here, structure, prior[e], of_other.parameters);
    out.nats[e][half] =
        LogLikelihood(here, structure, at) + records.LogJacobianOfHalf(fit.model, e, half);
    out.errors[e][half] = ErrorsOf(records.Half(as_recorded, e, half), here, fit.model, at,
                                   of_other.information, records.ForetoldErrors(e, half),
                                   UnitSeed(options.seed, "errors of parameters", i));
  });
  return out;
}

}  // namespace howl

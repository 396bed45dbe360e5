#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <cmath>

#include "diagnosis/samples/sample_limits.h"
#include "diagnosis/structure/structure_fit.h"

namespace howl {
namespace {

constexpr double kEulerGamma = 0.57721566490153286;
// The quietest part of a spectrum may hold a white sensor's noise alone.
constexpr double kQuiet = 0.05;
constexpr double kFirstError = 0.02;
constexpr Eigen::Index kCombustionCoefficients = 6;

// Coefficients of the logarithm of a smooth spectrum, from one exponential draw in each bin, the
// mean of whose logarithm is too low by Euler's constant. Lines are left out, because each pass
// caps bins that exceed the fit of the pass before.
Eigen::VectorXd LogSpectrum(const JointBand& band, const Eigen::VectorXd& power,
                            Eigen::Index coefficients) {
  const Eigen::MatrixXd basis = ChebyshevColumns(band.log_frequency, coefficients);
  const Eigen::VectorXd logs = power.array().max(1e-300).log() + kEulerGamma;
  Eigen::VectorXd out = basis.colPivHouseholderQr().solve(logs);
  for (int pass = 0; pass < 4; ++pass) {
    const Eigen::VectorXd level = basis * out;
    const Eigen::VectorXd capped = logs.cwiseMin((level.array() + 2.0).matrix());
    out = basis.colPivHouseholderQr().solve(capped);
  }
  return out;
}

Eigen::VectorXd LeastSquaresFlame(const FlamePart& flame) {
  return (flame.columns.adjoint() * flame.columns)
      .real()
      .ldlt()
      .solve((flame.columns.adjoint() * flame.target).real());
}

void ScaleErrors(const JointResiduals& residuals, const Eigen::VectorXd& flame, JointBand* band) {
  band->acoustic_power = SmoothPower(band->pressure - residuals.acoustic->residual, kPowerReach);
  band->flame_power = SmoothPower(residuals.flame->columns * flame, kPowerReach);
}

}  // namespace

void SetErrorScale(const StructureFit& fit, std::vector<JointBand>* bands) {
  const EffectPointer joined = fit.structure.Joined();
  for (std::size_t e = 0; e < bands->size(); ++e) {
    JointBand& band = (*bands)[e];
    const JointResiduals residuals = MakeJointResiduals(band, *joined, fit.shared, fit.points[e]);
    ScaleErrors(residuals, LeastSquaresFlame(*residuals.flame), &band);
  }
}

std::vector<NoiseTerm> BaseNoise() {
  return {{LoopNoise::kCombustion, kCombustionCoefficients},
          {LoopNoise::kPressureSensor, 1},
          {LoopNoise::kHeatReleaseSensor, 1}};
}

StructureFit StartOf(std::vector<JointBand>* bands, const EffectFit& base,
                     const std::vector<NoiseTerm>& noise) {
  StructureFit out;
  out.structure.noise = noise;
  out.structure.own_delays = base.delay_scatter > 0.0;
  out.shared.tau_s = base.tau_s;
  out.shared.values = base.values;
  out.shared.eps_a = kFirstError;
  out.shared.eps_b = kFirstError;
  out.shared.delay_scatter = base.delay_scatter;
  for (std::size_t e = 0; e < bands->size(); ++e) {
    JointBand& band = (*bands)[e];
    PointLoop point;
    point.acoustics = base.experiments[e].acoustics;
    point.residue_scale = std::abs(point.acoustics[2]);
    point.log_delay = base.experiments[e].log_delay;
    const JointResiduals residuals = MakeJointResiduals(band, *base.effect, out.shared, point);
    point.flame = LeastSquaresFlame(*residuals.flame);
    ScaleErrors(residuals, point.flame, &band);
    const Eigen::VectorXd flame_power =
        (residuals.flame->target - residuals.flame->columns * point.flame).cwiseAbs2();
    const Eigen::VectorXd acoustic_power = residuals.acoustic->residual.cwiseAbs2();
    const Eigen::VectorXd duct_power =
        acoustic_power.array() / residuals.acoustic->r.array().abs2();
    for (const NoiseTerm& term : noise) {
      Eigen::VectorXd coefficients = Eigen::VectorXd::Zero(term.coefficients);
      switch (term.source) {
        case LoopNoise::kCombustion:
          coefficients = LogSpectrum(band, flame_power, term.coefficients);
          break;
        case LoopNoise::kDuct:
          coefficients = LogSpectrum(band, duct_power, term.coefficients);
          break;
        case LoopNoise::kPressureSensor:
        case LoopNoise::kPressureHum:
          coefficients[0] = std::log(SampleQuantile(acoustic_power, kQuiet) / kQuiet);
          break;
        case LoopNoise::kHeatReleaseSensor:
        case LoopNoise::kHeatReleaseHum:
        case LoopNoise::kBackground:
          coefficients[0] = std::log(SampleQuantile(flame_power, kQuiet) / kQuiet);
          break;
      }
      point.noise.push_back(coefficients);
    }
    out.points.push_back(std::move(point));
  }
  out.centres = out.points;
  return out;
}

}  // namespace howl

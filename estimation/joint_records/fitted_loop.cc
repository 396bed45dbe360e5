#include "estimation/joint_records/fitted_loop.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "estimation/record_fit/delay_maxima.h"

namespace howl {
namespace {

constexpr Eigen::Index kFrequencies = 11;  // of a spectrum

// A parameter that is fitted as a logarithm.
Estimate FromLogarithm(double log_value, double variance, double unit) {
  const double value = unit * std::exp(log_value);
  return {value, value * std::sqrt(variance)};
}

std::vector<FittedMode> ModesOf(const PointStructure& structure, const LoopPoint& point,
                                const Eigen::MatrixXd& covariance, const RecordScale& scale) {
  const double residue =
      2.0 * std::numbers::pi * scale.cycle_hz * scale.pressure / scale.heat_release;
  const Eigen::Index dampings = structure.Frequencies();
  const Eigen::Index residues = dampings + structure.Dampings();
  std::vector<FittedMode> out;
  for (Eigen::Index k = 0; k < structure.modes; ++k) {
    const LoopMode& mode = point.modes[static_cast<std::size_t>(k)];
    const auto variance = [&](Eigen::Index i) { return covariance(i, i); };
    FittedMode fitted;
    fitted.omega_hz =
        FromLogarithm(std::log(mode.omega), variance(structure.Frequency(k)), scale.cycle_hz);
    fitted.xi = FromLogarithm(std::log(mode.xi), variance(dampings + structure.Damping(k)), 1.0);
    fitted.N = {residue * mode.a, residue * std::sqrt(variance(residues + k))};
    fitted.B = {0.0, 0.0};
    if (structure.complex_residues) {
      fitted.B = {residue * mode.b, residue * std::sqrt(variance(residues + structure.modes + k))};
    }
    out.push_back(fitted);
  }
  std::ranges::sort(out, {}, [](const FittedMode& mode) { return mode.omega_hz.value; });
  return out;
}

std::vector<FittedNoise> NoiseOf(const RecordSpectra& record, const PointStructure& structure,
                                 const LoopPoint& point, const Eigen::MatrixXd& covariance) {
  std::vector<FittedNoise> out;
  Eigen::Index first = structure.Noise(record.flame.cols());
  const double lowest = std::abs(record.s[0]);
  const double highest = std::abs(record.s[record.bins() - 1]);
  for (std::size_t j = 0; j < structure.noise.size(); ++j) {
    const NoiseTerm& term = structure.noise[j];
    const double unit =
        IsOfPressure(term.source) ? record.scale.pressure : record.scale.heat_release;
    const Eigen::VectorXd position = Eigen::VectorXd::LinSpaced(kFrequencies, -1.0, 1.0);
    const Eigen::MatrixXd shapes = ChebyshevColumns(position, term.coefficients);
    const Eigen::MatrixXd block =
        covariance.block(first, first, term.coefficients, term.coefficients);
    FittedNoise noise;
    noise.source = term.source;
    for (Eigen::Index i = 0; i < kFrequencies; ++i) {
      const Eigen::VectorXd shape = shapes.row(i);
      noise.frequency_hz.push_back(record.scale.cycle_hz * lowest *
                                   std::pow(highest / lowest, 0.5 * (position[i] + 1.0)));
      // The taper's difference of two bins doubles the power, one side halves the band.
      noise.psd.push_back(std::exp(shape.dot(point.noise[j])) * unit * unit / record.sampling_hz);
      noise.log_std.push_back(std::sqrt(shape.dot(block * shape)));
    }
    if (term.source == LoopNoise::kBackground) {
      const Eigen::Index last = covariance.rows() - 1;
      const double ratio_unit = record.scale.pressure / record.scale.heat_release;
      noise.ratio = {point.background_ratio * ratio_unit,
                     std::sqrt(covariance(last, last)) * ratio_unit};
    }
    first += term.coefficients;
    out.push_back(std::move(noise));
  }
  return out;
}

// `first`: the index of the first real part.
std::vector<FittedLineError> LinesOf(const Eigen::VectorXcd& errors, Eigen::Index first,
                                     const Eigen::MatrixXd& covariance) {
  std::vector<FittedLineError> out;
  const Eigen::Index count = errors.size();
  for (Eigen::Index h = 0; h < count; ++h) {
    const auto std_of = [&](Eigen::Index i) { return std::sqrt(covariance(i, i)); };
    out.push_back({static_cast<int>(h) + 1,
                   {errors[h].real(), std_of(first + h)},
                   {errors[h].imag(), std_of(first + count + h)}});
  }
  return out;
}

}  // namespace

FittedLoop FittedLoopOf(const RecordSpectra& record, const PointStructure& structure,
                        const PointFit& fit) {
  const LoopPoint point = ToPoint(structure, record.flame.cols(), fit.parameters);
  const Eigen::MatrixXd covariance = fit.Covariance();
  FittedLoop out;
  out.cycle_hz = record.scale.cycle_hz;
  out.transfer =
      AcousticTransfer(point, {0.0, 1.0}) * record.scale.pressure / record.scale.heat_release;
  out.modes = ModesOf(structure, point, covariance, record.scale);
  out.tau_s =
      FromLogarithm(std::log(point.path.tau), covariance(structure.Delay(), structure.Delay()),
                    1.0 / record.scale.AngularFrequency());
  if (structure.HasSpread()) {
    out.delay_spread = FromLogarithm(std::log(point.path.rho),
                                     covariance(structure.Delay() + 1, structure.Delay() + 1), 1.0);
  }
  if (structure.second_path) {
    const Eigen::Index at = structure.SecondPath();
    out.second_path = {
        {point.path.second->share, std::sqrt(covariance(at, at))},
        FromLogarithm(std::log(point.path.second->lambda), covariance(at + 1, at + 1),
                      1.0 / record.scale.AngularFrequency())};
  }
  out.acoustic_lines = LinesOf(point.acoustic_lines, structure.AcousticLine(), covariance);
  out.flame_lines =
      LinesOf(point.flame_lines, structure.FlameLine(record.flame.cols()), covariance);
  out.small_signal = SmallSignalLoopOf(record, structure, fit);
  out.noise = NoiseOf(record, structure, point, covariance);
  out.converged = fit.converged;
  return out;
}

std::vector<OtherDelay> OtherDelaysOf(const RecordSpectra& record, const PointStructure& structure,
                                      const PointFit& fit, const PointPrior& law) {
  PointPrior prior = PriorOf(structure, record);
  for (const auto& [first, count] :
       {std::pair(structure.AcousticLine(), structure.AcousticLines()),
        std::pair(structure.FlameLine(record.flame.cols()), structure.FlameLines())}) {
    prior.deviation.segment(first, count) = law.deviation.segment(first, count);
  }
  std::vector<OtherDelay> out;
  for (const DelayMaximum& each : OtherDelayMaxima(record, structure, prior, fit.parameters)) {
    out.push_back({each.tau / record.scale.AngularFrequency(), each.nats_below});
  }
  return out;
}

}  // namespace howl

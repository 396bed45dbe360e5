#include "estimation/record_fit/whittle/noise_shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "estimation/record_fit/spectra/curve_exponents.h"

namespace howl {
namespace {

// The k-th of a term's lines. Which they are does not hang on the length of the part of a record
// that is looked at.
double LineHz(const NoiseTerm& term, const RecordSpectra& record, Eigen::Index k) {
  if (HasOneLine(term)) return term.line_hz;
  const double first =
      std::max(std::ceil(RecordScale::kLowestOfCycle * record.scale.cycle_hz / term.line_hz), 1.0);
  return (first + static_cast<double>(k)) * term.line_hz;
}

Eigen::Index Lines(const NoiseTerm& term) { return HasOneLine(term) ? 1 : term.coefficients - 1; }

Eigen::VectorXd LinesShape(const NoiseTerm& term, const RecordSpectra& record) {
  const double cycle_hz = record.scale.cycle_hz;
  const Eigen::VectorXd f_hz = cycle_hz * record.s.imag();
  Eigen::VectorXd out = Eigen::VectorXd::Zero(record.bins());
  for (Eigen::Index k = 0; k < Lines(term); ++k) {
    const double line_hz = LineHz(term, record, k);
    for (Eigen::Index i = 0; i < record.bins(); ++i) {
      const double bins = (f_hz[i] - line_hz) / record.bin_hz;
      out[i] += 1.0 / std::max(1.0, std::pow(4.0 * bins * bins - 1.0, 2));
    }
  }
  return out;
}

// Of the lines of q that the band holds, from the cycle's own on.
Eigen::VectorXd LinePowers(const RecordSpectra& record) {
  const Eigen::VectorXd x = record.s.imag();
  Eigen::VectorXd out = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(x[x.size() - 1]));
  for (Eigen::Index i = 0; i < record.edge_s.size(); ++i) {
    const double at = record.edge_s[i].imag();
    const Eigen::Index line = std::lround(at);
    if (line < 1 || line > out.size()) continue;
    if (std::abs(at - static_cast<double>(line)) < kBesideCycle) {
      out[line - 1] += std::norm(record.heat_release[i]);
    }
  }
  return out;
}

// What a gain that moves by one adds to each of them.
Eigen::VectorXd PowersByGain(const NoiseTerm& gain, const RecordSpectra& record) {
  Eigen::VectorXd out = LinePowers(record);
  if (!gain.before_curve) return out;
  const Eigen::Index known = std::min(out.size(), record.curve_exponents.size());
  out.head(known).array() *= record.curve_exponents.head(known).array().square();
  return out;
}

Eigen::VectorXd BesideCycle(const NoiseTerm& term, const RecordSpectra& record) {
  const double width = 1.0 / (2.0 * std::numbers::pi * term.memory_cycles);
  const Eigen::VectorXd powers = PowersByGain(term, record);
  const Eigen::VectorXd x = record.s.imag();
  Eigen::VectorXd out = Eigen::VectorXd::Zero(x.size());
  for (Eigen::Index k = 0; k < powers.size(); ++k) {
    const auto line = static_cast<double>(k + 1);
    out.array() += powers[k] * width / (width * width + (x.array() - line).square());
  }
  return out / out.mean();
}

Eigen::VectorXd WithoutInstruments(const NoiseTerm& term, const RecordSpectra& record) {
  if (HasLines(term.source)) return LinesShape(term, record);
  if (term.source == LoopNoise::kFlameGain) return BesideCycle(term, record);
  return Eigen::VectorXd::Ones(record.bins());
}

// Of the instruments before the place where it comes in.
TransferFunction InstrumentBefore(LoopNoise source, const RecordSpectra& record) {
  switch (source) {
    case LoopNoise::kPressureSensor:
    case LoopNoise::kPressureHum:
      return Product(record.known_pressure_instrument, record.pressure_instrument);
    case LoopNoise::kHeatReleaseSensor:
    case LoopNoise::kHeatReleaseHum:
      return Product(record.known_heat_release_instrument, record.heat_release_instrument);
    case LoopNoise::kCombustion:
    case LoopNoise::kDuct:
    case LoopNoise::kBackground:
    case LoopNoise::kTone:
    case LoopNoise::kFlameGain:
      break;
  }
  return {};
}

}  // namespace

Eigen::VectorXd NoiseShape(const NoiseTerm& term, const RecordSpectra& record) {
  Eigen::VectorXd out = WithoutInstruments(term, record);
  if (const TransferFunction instrument = InstrumentBefore(term.source, record)) {
    for (Eigen::Index i = 0; i < record.bins(); ++i) out[i] /= std::norm(instrument(record.s[i]));
  }
  return out;
}

Eigen::MatrixXd LogSpectrumColumns(const NoiseTerm& term, const RecordSpectra& record) {
  if (!HasLines(term.source) || HasOneLine(term)) {
    return ChebyshevColumns(record.position, term.coefficients);
  }
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(record.bins(), term.coefficients);
  out.col(0).setOnes();
  const double first_hz = LineHz(term, record, 0);
  for (Eigen::Index i = 0; i < record.bins(); ++i) {
    const double f_hz = record.scale.cycle_hz * record.s[i].imag();
    const Eigen::Index k = std::lround((f_hz - first_hz) / term.line_hz);
    if (k >= 0 && k < Lines(term)) out(i, 1 + k) = 1.0;
  }
  return out;
}

double AnswerToGain(const NoiseTerm& gain, const RecordSpectra& record) {
  return std::sqrt(PowersByGain(gain, record).sum() / LinePowers(record).sum());
}

Eigen::VectorXd LostPower(const NoiseTerm& term, const RecordSpectra& record) {
  if (term.source != LoopNoise::kPressureSensor || record.lost_pressure.size() == 0) return {};
  Eigen::VectorXd out = record.lost_pressure;
  for (Eigen::Index i = 0; i < out.size() && record.pressure_instrument; ++i) {
    out[i] /= std::norm(record.pressure_instrument(record.s[i]));
  }
  return out;
}

Eigen::VectorXd NoiseSpectrum(const NoiseTerm& term, const RecordSpectra& record,
                              const Eigen::VectorXd& coefficients) {
  return (LogSpectrumColumns(term, record) * coefficients).array().exp() *
         NoiseShape(term, record).array();
}

}  // namespace howl

#include "estimation/record_fit/spectra/driven_flame.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include "estimation/record_fit/spectra/flame_basis.h"
#include "estimation/record_fit/spectra/flame_functions.h"
#include "estimation/record_fit/spectra/unitary_transform.h"

namespace howl {
namespace {

using C = std::complex<double>;

constexpr double kFilterEdge = 0.8;  // of the input's highest frequency, where its filter ends
constexpr double kRangeOverLargest = 1.02;
// Of the cycle: where the record's end meets its beginning the filtered input has a spike, which no
// flame saw. It is gone after the filter's own memory, half a period.
constexpr double kEndPeriods = 2.0;

// What the flame's curve answers to, from p.
C CurveInputAt(const RecordSpectra& record, C s) {
  return FlameInputResponse(record.flame_input, s) * ValueAt(record.filters.before, s);
}

// Between spectra that are unitary for the record's samples and for its instants.
double InstantsOverSamples(const RecordSpectra& record) {
  return std::sqrt(static_cast<double>(record.Instants()) * record.bin_hz / record.sampling_hz);
}

// The spectrum of the flame's input, of what drives it, from no frequency on.
Eigen::VectorXcd InputOf(const RecordSpectra& record) {
  Eigen::VectorXcd out = record.driving;
  const double bin = record.bin_hz / record.scale.cycle_hz;
  const auto end = static_cast<double>(out.size());
  out[0] = 0.0;
  for (Eigen::Index k = 1; k < out.size(); ++k) {
    const auto at = static_cast<double>(k);
    const double over = std::max(at / end - kFilterEdge, 0.0) / (1.0 - kFilterEdge);
    out[k] *=
        CurveInputAt(record, C(0.0, at * bin)) * 0.5 * (1.0 + std::cos(std::numbers::pi * over));
  }
  return out;
}

// In time, at the record's instants.
Eigen::VectorXd InTime(const Eigen::VectorXcd& input, const RecordSpectra& record) {
  Eigen::VectorXcd spectrum = Eigen::VectorXcd::Zero(record.Instants() / 2 + 1);
  spectrum.head(input.size()) = InstantsOverSamples(record) * input;
  return UnitarySignal(std::move(spectrum), record.Instants());
}

// The largest size of the input but at the record's ends.
double LargestInside(const Eigen::VectorXd& v, double bin_of_cycle) {
  const auto samples_of_period = static_cast<double>(v.size()) * bin_of_cycle;
  const auto end =
      std::min(static_cast<Eigen::Index>(kEndPeriods * samples_of_period), v.size() / 4);
  return v.segment(end, v.size() - 2 * end).cwiseAbs().maxCoeff();
}

void SetInput(RecordSpectra* out) {
  out->input = out->s.unaryExpr([&](C s) { return out->InputAt(s); });
}

void MultiplyFlame(const TransferFunction& after, RecordSpectra* out) {
  if (!after) return;
  out->flame.array().colwise() *=
      out->edge_s.unaryExpr([&](C s) { return ValueAt(after, s); }).array();
}

}  // namespace

void SetFlame(Eigen::VectorXcd pressure, const FlamePrior& prior, RecordSpectra* out) {
  out->driving = std::move(pressure);
  SetInput(out);
  RecordScale& scale = out->scale;
  const auto in_band = [&](const Eigen::VectorXcd& spectrum) -> Eigen::VectorXcd {
    return spectrum.segment(out->below.size(), out->bins() + 1);
  };
  const Eigen::VectorXcd input = InputOf(*out);
  const Eigen::VectorXd v = InTime(input, *out);
  const double in_samples = 1.0 / InstantsOverSamples(*out);
  if (scale.input_range == 0.0) {
    scale.input_range = kRangeOverLargest * LargestInside(v, out->bin_hz / scale.cycle_hz);
  }
  const FlameBasis basis(scale.input_range);
  const Eigen::VectorXd rises = basis.MeanSlopes(v);
  const Eigen::VectorXcd rest = out->edge_s.unaryExpr([&](C s) { return CurveInputAt(*out, s); })
                                    .cwiseProduct(out->pressure) -
                                in_band(input);
  const Eigen::MatrixXd splines = basis.Columns(v);
  Eigen::MatrixXcd spectra(out->bins() + 1, splines.cols());
  for (Eigen::Index k = 0; k < splines.cols(); ++k) {
    spectra.col(k) = in_samples * in_band(UnitarySpectrum(splines.col(k))) + rises[k] * rest;
  }
  if (scale.functions.size() == 0) {
    const double size = std::sqrt(v.squaredNorm() / static_cast<double>(v.size()));
    FlameFunctions flame = SmoothFlames(prior, basis, spectra, size);
    scale.functions = std::move(flame.of_splines);
    scale.flame_deviation = std::move(flame.deviation);
  }
  out->flame = spectra * scale.functions;
  MultiplyFlame(out->filters.after, out);
  out->slopes = scale.functions.transpose() * rises;
  out->rest_slopes = scale.functions.transpose() * basis.MeanSlopes(Eigen::VectorXd::Zero(1));
}

void FilterFlame(const FlameFilters& filters, RecordSpectra* record) {
  record->filters = Product(record->filters, filters);
  if (filters.before) {
    SetFlame(std::move(record->driving), {}, record);
  } else {  // the curve's functions of p are what they were
    SetInput(record);
    MultiplyFlame(filters.after, record);
  }
}

}  // namespace howl

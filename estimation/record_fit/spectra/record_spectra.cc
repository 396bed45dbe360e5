#include "estimation/record_fit/spectra/record_spectra.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>
#include <vector>

#include "estimation/record_fit/spectra/flame_basis.h"
#include "estimation/record_fit/spectra/flame_functions.h"
#include "estimation/record_fit/spectra/middle_part.h"
#include "estimation/record_fit/spectra/unitary_transform.h"

namespace howl {
namespace {

using C = std::complex<double>;

constexpr double kHighestOfCycle = 6.4;
constexpr double kHighestOfSampling = 0.4;
// Of the band's upper end: how far the flame's input reaches. A flame that is nearly a switch
// answers to the harmonics there with when it switches: without them its delay errs by six
// deviations (bench/flame_prior_study).
constexpr double kInputOfBand = 2.0;
constexpr double kFilterEdge = 0.8;  // of that end, where the filter ends
constexpr double kRangeOverLargest = 1.02;
// Of the cycle: where the record's end meets its beginning the filtered input has a spike, which no
// flame saw. It is gone after the filter's own memory, half a period.
constexpr double kEndPeriods = 2.0;

Eigen::VectorXd Centred(const std::vector<double>& samples, double scale) {
  Eigen::VectorXd out =
      Eigen::Map<const Eigen::VectorXd>(samples.data(), static_cast<Eigen::Index>(samples.size()));
  out.array() -= out.mean();
  return out / scale;
}

double RootMeanSquare(const std::vector<double>& samples) {
  const Eigen::VectorXd centred = Centred(samples, 1.0);
  return std::sqrt(centred.squaredNorm() / static_cast<double>(centred.size()));
}

struct Band {
  Eigen::Index first = 0;
  Eigen::Index count = 0;

  Eigen::VectorXcd Of(const Eigen::VectorXcd& spectrum) const {
    return spectrum.segment(first, count + 1);
  }
};

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

// Of recorded p, from no frequency on, with as much above the band as `above` has.
Eigen::VectorXcd PressureOf(const RecordSpectra& record, const Eigen::VectorXcd& above) {
  Eigen::VectorXcd out(record.below.size() + record.pressure.size() + above.size());
  out << record.below, record.pressure, above;
  return out;
}

// The largest size of the input but at the record's ends.
double LargestInside(const Eigen::VectorXd& v, double bin_of_cycle) {
  const auto samples_of_period = static_cast<double>(v.size()) * bin_of_cycle;
  const auto end =
      std::min(static_cast<Eigen::Index>(kEndPeriods * samples_of_period), v.size() / 4);
  return v.segment(end, v.size() - 2 * end).cwiseAbs().maxCoeff();
}

// The flame's functions of this p (InputOf).
void SetFlame(Eigen::VectorXcd pressure, const FlamePrior& prior, RecordSpectra* out) {
  out->driving = std::move(pressure);
  out->input = out->s.unaryExpr([&](C s) { return out->InputAt(s); });
  RecordScale& scale = out->scale;
  const Band band{out->below.size(), out->bins()};
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
                                band.Of(input);
  const Eigen::MatrixXd splines = basis.Columns(v);
  Eigen::MatrixXcd spectra(band.count + 1, splines.cols());
  for (Eigen::Index k = 0; k < splines.cols(); ++k) {
    spectra.col(k) = in_samples * band.Of(UnitarySpectrum(splines.col(k))) + rises[k] * rest;
  }
  if (scale.functions.size() == 0) {
    const double size = std::sqrt(v.squaredNorm() / static_cast<double>(v.size()));
    FlameFunctions flame = SmoothFlames(prior, basis, spectra, size);
    scale.functions = std::move(flame.of_splines);
    scale.flame_deviation = std::move(flame.deviation);
  }
  out->flame = spectra * scale.functions;
  if (out->filters.after) {
    out->flame.array().colwise() *=
        out->edge_s.unaryExpr([&](C s) { return ValueAt(out->filters.after, s); }).array();
  }
  out->slopes = scale.functions.transpose() * rises;
  out->rest_slopes = scale.functions.transpose() * basis.MeanSlopes(Eigen::VectorXd::Zero(1));
}

RecordSpectra Make(const Record& record, RecordScale scale, FlameInput input,
                   const FlamePrior& prior) {
  CHECK_EQ(record.pressure.size(), record.heat_release.size());
  RecordSpectra out;
  out.flame_input = input;
  const Eigen::VectorXd p = Centred(record.pressure, scale.pressure);
  out.sampling_hz = record.sampling_hz;
  out.bin_hz = record.sampling_hz / static_cast<double>(p.size());
  const double bin_of_cycle = out.bin_hz / scale.cycle_hz;
  const double highest =
      std::min(kHighestOfCycle, kHighestOfSampling * record.sampling_hz / scale.cycle_hz);
  Band band;
  band.first = std::max<Eigen::Index>(
      static_cast<Eigen::Index>(std::ceil(RecordScale::kLowestOfCycle / bin_of_cycle)), 1);
  band.count = static_cast<Eigen::Index>(highest / bin_of_cycle) - band.first;
  const Eigen::VectorXcd pressure = UnitarySpectrum(p);
  out.below = pressure.head(band.first);
  out.pressure = band.Of(pressure);
  const double input_highest =
      std::min(kInputOfBand * highest, kHighestOfSampling * record.sampling_hz / scale.cycle_hz);
  const Eigen::Index last = band.first + band.count;
  out.above = pressure.segment(
      last + 1,
      std::max<Eigen::Index>(static_cast<Eigen::Index>(input_highest / bin_of_cycle) - last, 0));
  out.heat_release = band.Of(UnitarySpectrum(Centred(record.heat_release, scale.heat_release)));
  const Eigen::VectorXd middle =
      (Eigen::ArrayXd::LinSpaced(band.count, 0.0, static_cast<double>(band.count - 1)) +
       static_cast<double>(band.first) + 0.5) *
      bin_of_cycle;
  out.s = C(0.0, 1.0) * middle;
  out.edge_s = C(0.0, bin_of_cycle) *
               Eigen::VectorXd::LinSpaced(band.count + 1, static_cast<double>(band.first),
                                          static_cast<double>(band.first + band.count));
  out.position =
      2.0 * (middle.array() / middle[0]).log() / std::log(middle[band.count - 1] / middle[0]) - 1.0;
  out.share = Eigen::VectorXd::Constant(band.count, kSineTaperShare);
  out.scale = std::move(scale);
  // What of p above the band is noise no loop has told yet: all is left out.
  SetFlame(PressureOf(out, Eigen::VectorXcd::Zero(out.above.size())), prior, &out);
  SetMiddle(&out);
  return out;
}

}  // namespace

TransferFunction Product(const TransferFunction& first, const TransferFunction& second) {
  if (!first || !second) return first ? first : second;
  return [first, second](C s) { return first(s) * second(s); };
}

std::complex<double> FlameInputResponse(FlameInput input, std::complex<double> s) {
  switch (input) {
    case FlameInput::kPressureRate:
      return s;
    case FlameInput::kPressure:
      return 1.0;
    case FlameInput::kVelocity:
      return 1.0 / s;
  }
  return s;
}

Eigen::VectorXd SmoothPower(const Eigen::VectorXcd& x, Eigen::Index reach) {
  Eigen::VectorXd out(x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const Eigen::Index from = std::max<Eigen::Index>(i - reach, 0);
    const Eigen::Index bins = std::min(i + reach + 1, x.size()) - from;
    out[i] = x.segment(from, bins).squaredNorm() / static_cast<double>(bins);
  }
  return out;
}

RecordSpectra MakeRecordSpectra(const Record& record, double cycle_hz, FlameInput input,
                                const FlamePrior& flame) {
  RecordScale scale;
  scale.cycle_hz = cycle_hz;
  scale.pressure = RootMeanSquare(record.pressure);
  scale.heat_release = RootMeanSquare(record.heat_release);
  return Make(record, std::move(scale), input, flame);
}

RecordSpectra MakeRecordSpectra(const Record& record, const RecordSpectra& like) {
  return Make(record, like.scale, like.flame_input, {});
}

RecordSpectra DrivenWithout(RecordSpectra record, const Eigen::VectorXd& noise) {
  CHECK_EQ(noise.size(), record.Samples());
  Eigen::VectorXcd pressure = PressureOf(record, record.above);
  pressure -= UnitarySpectrum(noise).head(pressure.size());
  SetFlame(std::move(pressure), {}, &record);
  SetMiddle(&record);
  return record;
}

RecordSpectra WithFilters(RecordSpectra record, const FlameFilters& filters) {
  record.filters = {Product(record.filters.before, filters.before),
                    Product(record.filters.after, filters.after)};
  SetFlame(std::move(record.driving), {}, &record);
  if (record.middle) SetMiddle(&record);
  return record;
}

RecordSpectra WithoutPressureInstrument(RecordSpectra record, const TransferFunction& instrument,
                                        const FlameFilters& filters) {
  const double bin = record.bin_hz / record.scale.cycle_hz;
  const auto divide = [&](Eigen::Index first, Eigen::VectorXcd* spectrum) {
    for (Eigen::Index k = 0; k < spectrum->size(); ++k) {
      const C response = instrument(C(0.0, bin * static_cast<double>(first + k)));
      // What it does not pass at all, as a high-pass the mean, is not to be told from the record.
      (*spectrum)[k] = response == 0.0 ? 0.0 : (*spectrum)[k] / response;
    }
  };
  divide(0, &record.driving);
  divide(0, &record.below);
  divide(record.below.size(), &record.pressure);
  divide(record.below.size() + record.pressure.size(), &record.above);
  record.pressure_instrument = Product(record.pressure_instrument, instrument);
  return WithFilters(std::move(record), filters);
}

}  // namespace howl

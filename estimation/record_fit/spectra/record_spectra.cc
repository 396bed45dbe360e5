#include "estimation/record_fit/spectra/record_spectra.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

#include "estimation/record_fit/spectra/driven_flame.h"
#include "estimation/record_fit/spectra/middle_part.h"
#include "estimation/record_fit/spectra/unitary_transform.h"

namespace howl {
namespace {

using C = std::complex<double>;

constexpr double kHighestOfCycle = 6.4;
// Of the sampling rate, where that ends the band first. From there on an anti-alias filter takes
// from p and from q alike. What is linear does not notice, but a curve of p that lacks a hundredth
// of a harmonic is not the curve of p that lacks it: with bands to 0.4 spread delays and second
// paths were seen where there are none (bench/band_end_study.py, in which p drives the flame up to
// 0.4 as well).
constexpr double kHighestOfSampling = 0.35;
constexpr double kInputOfSampling = 0.4;
// Of the band's upper end: how far the flame's input reaches. A flame that is nearly a switch
// answers to the harmonics there with when it switches: without them its delay errs by six
// deviations (bench/flame_prior_study).
constexpr double kInputOfBand = 2.0;

struct Band {
  Eigen::Index first = 0;
  Eigen::Index count = 0;

  Eigen::VectorXcd Of(const Eigen::VectorXcd& spectrum) const {
    return spectrum.segment(first, count + 1);
  }
};

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

// Of recorded p, from no frequency on, with as much above the band as `above` has.
Eigen::VectorXcd PressureOf(const RecordSpectra& record, const Eigen::VectorXcd& above) {
  Eigen::VectorXcd out(record.below.size() + record.pressure.size() + above.size());
  out << record.below, record.pressure, above;
  return out;
}

TransferFunction OverCycle(const ResponseInHertz& response, double cycle_hz) {
  if (!response) return {};
  return [response, cycle_hz](C s) { return response(s.imag() * cycle_hz); };
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
      std::min(kInputOfBand * highest, kInputOfSampling * record.sampling_hz / scale.cycle_hz);
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
  out.share = Eigen::VectorXd::Constant(band.count, kSineTaperShare * (1.0 - record.lost_share));
  out.known_pressure_instrument = OverCycle(record.pressure_instrument, scale.cycle_hz);
  out.known_heat_release_instrument = OverCycle(record.heat_release_instrument, scale.cycle_hz);
  out.scale = std::move(scale);
  if (!record.pressure_errors.empty()) {
    out.lost_pressure = PressureErrors(record, out).cwiseAbs2().rowwise().mean();
  }
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

FlameFilters Product(const FlameFilters& first, const FlameFilters& second) {
  FlameFilters out = first;
  out.before = Product(out.before, second.before);
  out.after = Product(out.after, second.after);
  return out;
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

Eigen::MatrixXcd PressureErrors(const Record& of, const RecordSpectra& record) {
  Eigen::MatrixXcd out(record.bins(), static_cast<Eigen::Index>(of.pressure_errors.size()));
  for (Eigen::Index i = 0; i < out.cols(); ++i) {
    const Eigen::VectorXcd spectrum = UnitarySpectrum(
        Centred(of.pressure_errors[static_cast<std::size_t>(i)], record.scale.pressure));
    out.col(i) = Tapered(spectrum.segment(record.below.size(), record.bins() + 1));
  }
  return out;
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
  FilterFlame(filters, &record);
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
  record.filters = Product(record.filters, filters);
  SetFlame(std::move(record.driving), {}, &record);
  if (record.middle) SetMiddle(&record);
  return record;
}

}  // namespace howl

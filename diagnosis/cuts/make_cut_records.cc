#include "diagnosis/cuts/make_cut_records.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <numbers>

#include "diagnosis/noise/sensor_noise.h"
#include "diagnosis/numerics/real_fft.h"
#include "estimation/analysis/spectra/half_of_record.h"
#include "estimation/analysis/spectra/statistics.h"
#include "model/numerics/smooth_length.h"

namespace howl {
namespace {

constexpr double kLowestOfCycle = 0.15;
constexpr double kHighestOfCycleAcoustic = 8.0;
constexpr double kHighestOfCycleFlame = 6.4;
constexpr double kHighestOfSamplingAcoustic = 0.33;
constexpr double kHighestOfSamplingFlame = 0.26;
constexpr double kTaper = 0.3;            // of cut B's band
constexpr double kFilterOverBand = 1.05;  // edge of the flame's low-pass
constexpr double kLowestSearched_hz = 20.0;
constexpr double kLeastSampling_hz = 5.0 * kLowestSearched_hz;
constexpr std::size_t kFewestSamples = 4096;
constexpr double kFewestCycles = 20.0;

Eigen::VectorXd WithoutMean(const std::vector<double>& signal, Eigen::Index samples) {
  Eigen::VectorXd out = Eigen::Map<const Eigen::VectorXd>(signal.data(), samples);
  out.array() -= out.mean();
  return out;
}

Eigen::VectorXd Hertz(Eigen::Index first, Eigen::Index count, double bin_hz) {
  return Eigen::VectorXd::LinSpaced(count, static_cast<double>(first),
                                    static_cast<double>(first + count - 1)) *
         bin_hz;
}

// The square of the amplitude, as the square of the signal plus that of its quadrature, which has
// no ripple at twice the cycle's frequency.
Eigen::VectorXcd SquareSpectrum(const CutRecord& record, Eigen::VectorXcd spectrum) {
  const Eigen::VectorXd in_phase = InverseFft(spectrum, record.samples);
  spectrum *= std::complex<double>(0.0, -1.0);
  spectrum[0] = 0.0;
  const Eigen::VectorXd quadrature = InverseFft(spectrum, record.samples);
  return ForwardFft(in_phase.cwiseAbs2() + quadrature.cwiseAbs2());
}

// The root of twice the mean square.
double Amplitude(const CutRecord& record, const Eigen::VectorXcd& square_spectrum) {
  return std::sqrt(square_spectrum[0].real() / static_cast<double>(record.samples));
}

// s times a low-pass, which is one up to `edge` and falls to zero over the next quarter.
Eigen::VectorXcd DerivativeFilter(const CutRecord& record, double edge_hz) {
  Eigen::VectorXcd filter(record.pressure_spectrum.size());
  for (Eigen::Index k = 0; k < filter.size(); ++k) {
    const double f = static_cast<double>(k) * record.bin_hz;
    const double over = std::clamp((f - edge_hz) / (0.25 * edge_hz), 0.0, 1.0);
    filter[k] = LaplaceVariable(f) * 0.5 * (1.0 + std::cos(std::numbers::pi * over));
  }
  return filter;
}

// A weight that falls as half a cosine over the last part of the band.
Eigen::VectorXd UpperTaper(Eigen::Index count) {
  Eigen::VectorXd taper(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const double to_edge = static_cast<double>(count - k) / (kTaper * static_cast<double>(count));
    taper[k] = 0.5 * (1.0 - std::cos(std::numbers::pi * std::min(to_edge, 1.0)));
  }
  return taper;
}

CutRecord Spectra(const DiagnosisExperiment& experiment) {
  CutRecord out;
  const Record& record = experiment.record;
  CHECK_EQ(record.pressure.size(), record.heat_release.size()) << experiment.name;
  CHECK_GE(record.pressure.size(), kFewestSamples / 4) << experiment.name;  // a part of one
  CHECK_GE(record.sampling_hz, kLeastSampling_hz) << experiment.name;
  out.name = experiment.name;
  out.samples = SmoothLength(static_cast<Eigen::Index>(record.pressure.size()));
  out.sampling_hz = record.sampling_hz;
  out.bin_hz = record.sampling_hz / static_cast<double>(out.samples);
  out.pressure = WithoutMean(record.pressure, out.samples);
  out.heat_release = WithoutMean(record.heat_release, out.samples);
  out.pressure_spectrum = ForwardFft(out.pressure);
  out.heat_release_spectrum = ForwardFft(out.heat_release);
  const auto lowest = static_cast<Eigen::Index>(kLowestSearched_hz / out.bin_hz);
  const Eigen::Index count = out.pressure_spectrum.size() - lowest - 4;
  Eigen::Index peak = 0;
  ApplyWindow(out.pressure_spectrum.segment(lowest, count + 4), count).cwiseAbs().maxCoeff(&peak);
  out.at.cycle_frequency_hz = static_cast<double>(peak + lowest + 2) * out.bin_hz;
  return out;
}

void SetBand(double cycle_hz, CutRecord* record) {
  const double high_a = std::min(kHighestOfCycleAcoustic * cycle_hz,
                                 kHighestOfSamplingAcoustic * record->sampling_hz);
  const double high_b =
      std::min(kHighestOfCycleFlame * cycle_hz, kHighestOfSamplingFlame * record->sampling_hz);
  record->first = static_cast<Eigen::Index>(std::ceil(kLowestOfCycle * cycle_hz / record->bin_hz));
  CHECK_GE(record->first, kTapReach);
  record->acoustic_count =
      static_cast<Eigen::Index>(std::floor(high_a / record->bin_hz)) - record->first;
  record->flame_count =
      static_cast<Eigen::Index>(std::floor(high_b / record->bin_hz)) - record->first;
  const Eigen::Index start = record->first - kTapReach;
  record->frequency_hz = Hertz(start, record->extended(), record->bin_hz);
  record->windowed_pressure = ApplyWindow(
      record->pressure_spectrum.segment(start, record->extended()), record->acoustic_count);
  record->windowed_heat_release = ApplyWindow(
      record->heat_release_spectrum.segment(start, record->extended()), record->acoustic_count);
  record->derivative_filter = DerivativeFilter(*record, kFilterOverBand * high_b);
  record->flame_share = UpperTaper(record->flame_count);
  record->masked.assign(static_cast<std::size_t>(record->acoustic_count), 0);
  const SensorNoise noise = EstimateSensorNoise(*record);
  record->sensor_noise = noise.variance;
  record->derivative_filter =
      record->derivative_filter.cwiseProduct(PressureShrinkage(*record, noise.pressure_variance));
  record->driving_heat_release =
      record->heat_release_spectrum
          .cwiseProduct(HeatReleaseShrinkage(*record, noise.heat_release_variance))
          .segment(start, record->extended());
}

}  // namespace

std::optional<CutObstacle> FindCutObstacle(const std::vector<DiagnosisExperiment>& experiments) {
  std::vector<double> cycles;
  const auto text = [](const char* format, double is, double least) {
    std::array<char, 160> out{};
    std::snprintf(out.data(), out.size(), format, is, least);
    return std::string(out.data());
  };
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    const Record& record = experiments[e].record;
    if (record.pressure.size() < kFewestSamples) {
      return CutObstacle{e, text("has %.0f samples, expected at least %.0f",
                                 static_cast<double>(record.pressure.size()),
                                 static_cast<double>(kFewestSamples))};
    }
    if (record.sampling_hz < kLeastSampling_hz) {
      return CutObstacle{e, text("is sampled at %.6g Hz, expected at least %.0f Hz",
                                 record.sampling_hz, kLeastSampling_hz)};
    }
    if (record.pressure == record.heat_release) {
      return CutObstacle{e, "has the same samples as p and as q, expected two signals"};
    }
    cycles.push_back(Spectra(experiments[e]).at.cycle_frequency_hz);
  }
  const double cycle_hz = Median(cycles);
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    const Record& record = experiments[e].record;
    const double count =
        cycle_hz * static_cast<double>(record.pressure.size()) / record.sampling_hz;
    if (count >= kFewestCycles) continue;
    return CutObstacle{
        e, text("has %.3g cycles of the rig's strongest line, expected at least %.0f", count,
                kFewestCycles)};
  }
  return std::nullopt;
}

std::vector<CutRecord> MakeCutRecords(const std::vector<DiagnosisExperiment>& experiments,
                                      const BaseModel& model) {
  CHECK(!experiments.empty());
  std::vector<CutRecord> records;
  records.reserve(experiments.size());
  std::vector<double> cycles;
  double low = experiments[0].phi;
  double high = low;
  for (const DiagnosisExperiment& experiment : experiments) {
    records.push_back(Spectra(experiment));
    records.back().model = model;
    cycles.push_back(records.back().at.cycle_frequency_hz);
    low = std::min(low, experiment.phi);
    high = std::max(high, experiment.phi);
  }
  const double cycle_hz = Median(cycles);
  double mean_amplitude = 0.0;
  double mean_rate = 0.0;
  double mean_ratio = 0.0;
  const double count = static_cast<double>(records.size());
  for (std::size_t i = 0; i < records.size(); ++i) {
    CutRecord& record = records[i];
    SetBand(cycle_hz, &record);
    record.lowest_cycle_hz = *std::min_element(cycles.begin(), cycles.end());
    record.at.own_heat_release_over_pressure = record.heat_release.norm() / record.pressure.norm();
    record.square_spectrum = SquareSpectrum(record, record.pressure_spectrum);
    record.rate_square_spectrum =
        SquareSpectrum(record, record.pressure_spectrum.cwiseProduct(record.derivative_filter));
    mean_amplitude += Amplitude(record, record.square_spectrum) / count;
    mean_rate += Amplitude(record, record.rate_square_spectrum) / count;
    mean_ratio += record.at.own_heat_release_over_pressure / count;
    record.at.phi_position =
        high > low ? (experiments[i].phi - 0.5 * (low + high)) / (high - low) : 0.0;
  }
  for (CutRecord& record : records) {
    record.square_spectrum /= mean_amplitude * mean_amplitude;
    record.rate_square_spectrum /= mean_rate * mean_rate;
    record.at.relative_amplitude = Amplitude(record, record.square_spectrum);
    record.at.relative_rate_amplitude = Amplitude(record, record.rate_square_spectrum);
    record.at.heat_release_over_pressure = mean_ratio;
  }
  return records;
}

void DriveAsRecorded(CutRecord* record) {
  record->driving_heat_release =
      record->heat_release_spectrum.segment(record->first - kTapReach, record->extended());
}

std::vector<DiagnosisExperiment> HalfOfRecords(const std::vector<DiagnosisExperiment>& experiments,
                                               bool second) {
  std::vector<DiagnosisExperiment> out = experiments;
  for (DiagnosisExperiment& each : out) each.record = HalfOf(std::move(each.record), second);
  return out;
}

}  // namespace howl

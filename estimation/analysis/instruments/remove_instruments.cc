#include "estimation/analysis/instruments/remove_instruments.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>
#include <vector>

#include "estimation/analysis/instruments/linear_prediction.h"
#include "model/numerics/fft.h"

namespace howl {
namespace {

using Spectrum = std::vector<std::complex<double>>;  // half, from zero to half the sampling rate

constexpr double kForgottenEnergy = 1e-6;     // of the division's answer to one sample
constexpr std::size_t kSamplesPerFlank = 20;  // the record over what it is continued by
constexpr std::size_t kFewestFlank = 8;

// A transform that fits a record: a multiple of four without a prime factor above five.
std::size_t TransformLength(std::size_t least) {
  for (std::size_t n = (least + 3) / 4 * 4;; n += 4) {
    std::size_t rest = n;
    for (const std::size_t prime : {2, 3, 5}) {
      while (rest % prime == 0) rest /= prime;
    }
    if (rest == 1) return n;
  }
}

class Transform {
 public:
  explicit Transform(std::size_t size) : size_(size) {}
  std::size_t size() const { return size_; }
  std::size_t bins() const { return size_ / 2 + 1; }
  Spectrum Forward(const std::vector<double>& signal) {
    Spectrum spectrum(bins());
    fft_.Forward(signal, spectrum);
    return spectrum;
  }
  std::vector<double> Inverse(const Spectrum& spectrum) {
    std::vector<double> signal(size_);
    fft_.Inverse(spectrum, signal);
    return signal;
  }

 private:
  std::size_t size_;
  Fft fft_;
};

struct Division {
  Spectrum gain;       // what the spectrum is multiplied by
  double least = 0.0;  // the smallest size that it is divided by
  std::optional<ResponseFault> fault;
};

// What a signal was divided by.
ResponseInHertz Divisor(const std::optional<InstrumentResponse>& response,
                        const Division& division) {
  if (!response) return {};
  return [known = *response, least = division.least](double frequency_hz) {
    const std::complex<double> value = known.At(frequency_hz);
    const double size = std::abs(value);
    return size < least ? std::complex<double>(least) : value;
  };
}

Division Divide(const std::optional<InstrumentResponse>& response, Channel channel, double delay_s,
                double bin_hz, std::size_t bins) {
  Division division;
  division.gain.assign(bins, 1.0);
  double most = 0.0;
  for (std::size_t k = 1; k < bins; ++k) {
    const double frequency_hz = static_cast<double>(k) * bin_hz;
    if (response) division.gain[k] = response->At(frequency_hz);
    const double magnitude = std::abs(division.gain[k]);
    if (!std::isfinite(magnitude)) {
      division.fault = {channel, frequency_hz, false};
      return division;
    }
    most = std::max(most, magnitude);
  }
  if (most == 0.0) {
    division.fault = {channel, 0.0, true};
    return division;
  }
  const double least = division.least = kLeastResponseShare * most;
  for (std::size_t k = 1; k < bins; ++k) {
    std::complex<double>& gain = division.gain[k];
    const double magnitude = std::abs(gain);
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) * bin_hz * delay_s;
    if (magnitude > 0.0) {
      gain = std::conj(gain) / magnitude / std::max(magnitude, least) * std::polar(1.0, angle);
    }
  }
  // A real signal has no phase at either end.
  division.gain.front() = division.gain[1].real();
  division.gain.back() = division.gain.back().real();
  return division;
}

// The memory of the division, in samples to either side.
std::size_t Memory(const Division& division, Transform& transform) {
  Spectrum seen = division.gain;
  const auto last = static_cast<double>(seen.size() - 1);
  for (std::size_t k = 1; k < seen.size(); ++k) {
    seen[k] *= 0.5 * (1.0 + std::cos(std::numbers::pi * static_cast<double>(k) / last));
  }
  const std::vector<double> answer = transform.Inverse(seen);
  const double energy = std::inner_product(answer.begin(), answer.end(), answer.begin(), 0.0);
  const std::size_t n = answer.size();
  double beyond = 0.0;
  for (std::size_t lag = n / 2; lag > 0; --lag) {
    beyond += answer[lag] * answer[lag] + answer[n - lag] * answer[n - lag];
    if (beyond > kForgottenEnergy * energy) return lag;
  }
  return 0;
}

// The record without its mean, continued to either side by `flank` samples that fade out; zeros
// fill up the rest.
std::vector<double> Continue(const std::vector<double>& signal, double mean, std::size_t flank,
                             std::size_t size) {
  const std::size_t n = signal.size();
  std::vector<double> inside(n);
  for (std::size_t i = 0; i < n; ++i) inside[i] = signal[i] - mean;
  const std::vector<double> after = PredictOnward(inside, flank);
  std::reverse(inside.begin(), inside.end());
  const std::vector<double> before = PredictOnward(inside, flank);
  std::vector<double> out(size, 0.0);
  for (std::size_t i = 0; i < n; ++i) out[flank + i] = inside[n - 1 - i];
  for (std::size_t k = 0; k < flank; ++k) {
    const double way = static_cast<double>(k + 1) / static_cast<double>(flank + 1);
    const double fade = 0.5 * (1.0 + std::cos(std::numbers::pi * way));
    out[flank - 1 - k] = fade * before[k];
    out[flank + n + k] = fade * after[k];
  }
  return out;
}

}  // namespace

std::optional<ResponseFault> RemoveInstruments(const Instruments& instruments, Record& record) {
  if (instruments.None()) return std::nullopt;
  const std::size_t n = record.pressure.size();
  CHECK_GE(n, kFewestFlank);
  const std::size_t flank = std::max(n / kSamplesPerFlank, kFewestFlank);
  Transform transform(TransformLength(n + 2 * flank));
  const double bin_hz = record.sampling_hz / static_cast<double>(transform.size());
  for (std::size_t i = 0; i < record.heat_release.size() && instruments.leak != 0.0; ++i) {
    record.heat_release[i] -= instruments.leak * record.pressure[i];
  }
  std::size_t dropped = 0;
  const auto divided = [&](const std::vector<double>& signal, const Division& division) {
    const double mean = std::accumulate(signal.begin(), signal.end(), 0.0) / static_cast<double>(n);
    dropped = std::max(dropped, Memory(division, transform));
    Spectrum spectrum = transform.Forward(Continue(signal, mean, flank, transform.size()));
    for (std::size_t k = 0; k < spectrum.size(); ++k) spectrum[k] *= division.gain[k];
    const std::vector<double> whole = transform.Inverse(spectrum);
    std::vector<double> out(whole.begin() + static_cast<std::ptrdiff_t>(flank),
                            whole.begin() + static_cast<std::ptrdiff_t>(flank + n));
    for (double& value : out) value += mean;
    return out;
  };

  std::vector<double> pressure, heat_release;
  ResponseInHertz pressure_instrument, heat_release_instrument;
  if (instruments.pressure) {
    const Division division =
        Divide(instruments.pressure, Channel::kPressure, 0.0, bin_hz, transform.bins());
    if (division.fault) return division.fault;
    pressure = divided(record.pressure, division);
    pressure_instrument = Divisor(instruments.pressure, division);
  }
  if (!record.heat_release.empty() && (instruments.heat_release || instruments.delay_s != 0.0)) {
    const Division division = Divide(instruments.heat_release, Channel::kHeatRelease,
                                     instruments.delay_s, bin_hz, transform.bins());
    if (division.fault) return division.fault;
    heat_release = divided(record.heat_release, division);
    heat_release_instrument = Divisor(instruments.heat_release, division);
  }
  if (!pressure.empty()) record.pressure = std::move(pressure);
  if (!heat_release.empty()) record.heat_release = std::move(heat_release);
  record.pressure_instrument = std::move(pressure_instrument);
  record.heat_release_instrument = std::move(heat_release_instrument);
  dropped = std::min(dropped, static_cast<std::size_t>(kMostDroppedShare * static_cast<double>(n)));
  const auto trim = [&](std::vector<double>& signal) {
    if (signal.empty()) return;
    signal.erase(signal.end() - static_cast<std::ptrdiff_t>(dropped), signal.end());
    signal.erase(signal.begin(), signal.begin() + static_cast<std::ptrdiff_t>(dropped));
  };
  trim(record.pressure);
  trim(record.heat_release);
  return std::nullopt;
}

}  // namespace howl

#include <algorithm>
#include <cmath>

#include "model/simulation/lane_group.h"

namespace howl::internal {
namespace {

std::uint64_t StreamSeed(std::uint64_t seed, StreamKey key, std::size_t index = 0) {
  return DeriveSeed(seed, static_cast<std::uint64_t>(key) + index);
}

void AddWhiteNoise(double std_dev, std::uint64_t seed, std::vector<double>* signal) {
  if (std_dev == 0.0) return;
  RandomStream stream(seed);
  for (double& x : *signal) x += std_dev * stream.Normal();
}

}  // namespace

Recorder::Recorder(const SimulationCase& one, const SimulationOptions& options, int ratio)
    : wanted_(static_cast<std::size_t>(std::llround(options.duration_s * options.sampling_hz))),
      wanted_true_(options.keep_true_signals ? wanted_ * static_cast<std::size_t>(ratio) : 0),
      pressure_filter_(ratio),
      heat_release_filter_(ratio),
      noise_(one.rig.noise),
      seed_(one.seed) {
  record_.sampling_hz = options.sampling_hz;
  record_.internal_hz = options.sampling_hz * ratio;
  record_.pressure.reserve(wanted_ + 1024);  // the last chunk goes beyond
  record_.heat_release.reserve(wanted_ + 1024);
  for (const auto& instrument : one.rig.instruments) {
    instruments_.push_back(instrument->Clone());
    instruments_.back()->Start(record_.internal_hz,
                               StreamSeed(seed_, StreamKey::kInstruments, instruments_.size()));
  }
  for (const auto& digitiser : one.rig.digitisers) {
    digitisers_.push_back(digitiser->Clone());
    digitisers_.back()->Start(record_.sampling_hz,
                              StreamSeed(seed_, StreamKey::kDigitisers, digitisers_.size()));
  }
}

void Recorder::Push(std::span<double> pressure, std::span<double> heat_release) {
  const auto before = static_cast<std::size_t>(half_length());
  for (std::size_t i = 0; wanted_true_ > record_.true_pressure.size() && i < pressure.size(); ++i) {
    if (received_ + i < before) continue;
    record_.true_pressure.push_back(pressure[i]);
    record_.true_heat_release.push_back(heat_release[i]);
  }
  const double time_s = (static_cast<double>(received_) - half_length()) / record_.internal_hz;
  for (const auto& instrument : instruments_) instrument->Apply(time_s, pressure, heat_release);
  received_ += pressure.size();
  pressure_filter_.Push(pressure, &record_.pressure);
  heat_release_filter_.Push(heat_release, &record_.heat_release);
}

SimulatedRecord Recorder::Finish() {
  record_.pressure.resize(wanted_);
  record_.heat_release.resize(wanted_);
  AddWhiteNoise(noise_.pressure_sensor_std, StreamSeed(seed_, StreamKey::kPressureSensor),
                &record_.pressure);
  AddWhiteNoise(noise_.heat_release_sensor_std, StreamSeed(seed_, StreamKey::kHeatReleaseSensor),
                &record_.heat_release);
  for (const auto& digitiser : digitisers_) {
    digitiser->Apply(0.0, record_.pressure, record_.heat_release);
  }
  return std::move(record_);
}

}  // namespace howl::internal

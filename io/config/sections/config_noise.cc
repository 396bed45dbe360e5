#include "io/config/sections/config_sections.h"

namespace howl {
namespace {

SimulatedNoise ReadNoiseSource(const ConfigCursor& item) {
  SimulatedNoise noise;
  for (const NoisePlace each : kNoisePlaces) {
    if (item.Find("source")->Node().text == NoisePlaceName(each)) noise.place = each;
  }
  item.Read("rms_relative", noise.rms_relative);
  const auto corner = item.Find("corner_hz");
  const auto peak = item.Find("peak_hz");
  if (corner && peak) {
    item.FailAt("peak_hz", "is given with corner_hz, expected only one of the two");
  }
  if (const auto damping = item.Find("damping"); damping && !peak) {
    item.FailAt("damping", "has no resonance to belong to, expected peak_hz too");
  }
  if (corner) {
    noise.spectrum = {NoiseColour::kLowPass, corner->Node().number, 0.0};
  } else if (peak) {
    noise.spectrum = {NoiseColour::kResonance, peak->Node().number, kDefaultNoiseDamping};
    item.Read("damping", noise.spectrum.damping);
  } else if (noise.place == NoisePlace::kCombustion || noise.place == NoisePlace::kDuct) {
    item.FailAt("corner_hz",
                "is missing, expected corner_hz or peak_hz: noise inside the loop has a band");
  }
  return noise;
}

}  // namespace

std::vector<SimulatedNoise> ReadNoiseSources(const ConfigCursor& simulation) {
  std::vector<SimulatedNoise> sources;
  const auto noise = simulation.Find("noise");
  if (!noise) return sources;
  for (const ConfigCursor& item : noise->Items()) sources.push_back(ReadNoiseSource(item));
  return sources;
}

}  // namespace howl

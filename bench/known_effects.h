// Effects of known sizes, weak and strong, that studies put into measured records.
#ifndef HOWL_BENCH_KNOWN_EFFECTS_H_
#define HOWL_BENCH_KNOWN_EFFECTS_H_

#include <functional>
#include <string>
#include <vector>

#include "bench/measured_rig.h"

namespace howl {

struct KnownEffect {
  std::string effect;
  std::string strength;
  std::function<void(MeasuredRig*)> put;
};

inline std::vector<KnownEffect> KnownEffects() {
  return {
      {"none", "", [](MeasuredRig*) {}},
      {"q_sensor_lowpass", "300 Hz", [](MeasuredRig* rig) { LowPassQ(rig, 300.0); }},
      {"q_sensor_lowpass", "1000 Hz", [](MeasuredRig* rig) { LowPassQ(rig, 1000.0); }},
      {"channel_skew", "0.6 ms", [](MeasuredRig* rig) { SkewQ(rig, 6e-4); }},
      {"channel_skew", "0.2 ms", [](MeasuredRig* rig) { SkewQ(rig, 2e-4); }},
      {"p_clipping", "0.7", [](MeasuredRig* rig) { ClipSignal(rig, Channel::kPressure, 0.7); }},
      {"p_clipping", "0.9", [](MeasuredRig* rig) { ClipSignal(rig, Channel::kPressure, 0.9); }},
      {"q_clipping", "0.7", [](MeasuredRig* rig) { ClipSignal(rig, Channel::kHeatRelease, 0.7); }},
      {"q_clipping", "0.9", [](MeasuredRig* rig) { ClipSignal(rig, Channel::kHeatRelease, 0.9); }},
      {"mains_hum", "0.10", [](MeasuredRig* rig) { HumInQ(rig, 0.10); }},
      {"mains_hum", "0.03", [](MeasuredRig* rig) { HumInQ(rig, 0.03); }},
      {"crosstalk_p_to_q", "0.30", [](MeasuredRig* rig) { CrosstalkToQ(rig, 0.30); }},
      {"crosstalk_p_to_q", "0.10", [](MeasuredRig* rig) { CrosstalkToQ(rig, 0.10); }}};
}

}  // namespace howl

#endif  // HOWL_BENCH_KNOWN_EFFECTS_H_

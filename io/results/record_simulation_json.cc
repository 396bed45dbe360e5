#include "io/results/record_simulation_json.h"

#include <cmath>
#include <string>

#include "io/results/solution_json.h"
#include "model/numerics/units.h"

namespace howl {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kCurvePoints = 41;

std::string DriveName(ModalDrive drive) {
  switch (drive) {
    case ModalDrive::kPressureRate:
      return "pressure_rate";
    case ModalDrive::kPressure:
      return "pressure";
    case ModalDrive::kVelocity:
      return "velocity";
  }
  return "";
}

// The largest |v| of the record, in units of the rig.
double RangeOf(const RecordScale& scale, ModalDrive drive) {
  const double turn = kRadPerSPerHz * scale.cycle_hz;
  const double range = scale.input_range * scale.pressure;
  if (drive == ModalDrive::kPressureRate) return range * turn;
  return drive == ModalDrive::kPressure ? range : range / turn;
}

Json FlameJson(const ModalRig& rig, double range) {
  Json v = Json::array();
  Json q = Json::array();
  for (int i = 0; i < kCurvePoints; ++i) {
    v.push_back(range * (2.0 * i / (kCurvePoints - 1) - 1.0));
    q.push_back(rig.flame(v.back().get<double>()));
  }
  return {{"shape", "spline"}, {"saturation", nullptr}, {"offset", 0.0}, {"v", v}, {"q", q}};
}

Json ModesOf(const ModalRig& rig) {
  Json modes = Json::array();
  for (const ResidueMode& mode : rig.modes) {
    modes.push_back({{"omega_hz", mode.omega_hz}, {"xi", mode.xi}, {"N", mode.N}, {"B", mode.B}});
  }
  return modes;
}

}  // namespace

Json RecordSimulationJson(const RecordSolution& solution, std::span<const ModalRig> rigs) {
  Json experiments = Json::array();
  for (std::size_t e = 0; e < rigs.size(); ++e) {
    const ModalRig& rig = rigs[e];
    const double range = RangeOf(solution.loop.points[e].record.scale, rig.drive);
    const double step = 1e-4 * range;
    const Json gain = NumberOrNull(solution.fitted[e].small_signal.loop_gain.value);
    experiments.push_back(
        {{"name", solution.names[e]},
         {"loop_gain", gain},
         {"loop_gain_simulated", gain},
         {"flame_slope", (rig.flame(step) - rig.flame(-step)) / (2.0 * step)},
         {"slope_raised", false},
         {"flame", FlameJson(rig, range)},
         {"cycle_hz", rig.past ? Json(rig.past->frequency_hz) : Json(nullptr)},
         {"flame_input", DriveName(rig.drive)},
         {"tau_s", rig.tau_s},
         {"modes", ModesOf(rig)},
         {"leak_hz", rig.drive == ModalDrive::kVelocity ? Json(rig.leak_hz) : Json(nullptr)}});
  }
  return {{"schema", "howl.simulation/1"}, {"member", nullptr}, {"experiments", experiments}};
}

}  // namespace howl

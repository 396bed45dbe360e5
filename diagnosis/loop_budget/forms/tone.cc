#include "diagnosis/loop_budget/forms/tone.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "estimation/record_fit/loop/loop_point.h"

namespace howl {
namespace {

// Of a tone's tapered line two thousandths are beyond these bins to either side.
constexpr Eigen::Index kReach = 2;
constexpr double kStep = 0.5;  // of a bin, which loses a tenth of a tone's power at most
constexpr double kFineStep = 0.01;
constexpr double kHalfWay = 1e-6;

struct Pressure {
  Eigen::VectorXcd tapered;
  Eigen::VectorXd floor;
  double first_hz = 0.0, bin_hz = 0.0, cycle_hz = 0.0;

  double LastHz() const { return first_hz + bin_hz * static_cast<double>(tapered.size() - 1); }
};

Eigen::VectorXd MedianPower(const Eigen::VectorXcd& tapered, double first_bins) {
  Eigen::VectorXd out(tapered.size());
  std::vector<double> power;
  for (Eigen::Index from = 0; from < out.size();) {
    const double at = first_bins + static_cast<double>(from);
    const Eigen::Index count =
        std::min(out.size() - from,
                 std::max<Eigen::Index>(kReach, std::lround(at * (std::cbrt(2.0) - 1.0))));
    power.clear();
    for (Eigen::Index i = from; i < from + count; ++i) power.push_back(std::norm(tapered[i]));
    std::ranges::nth_element(power, power.begin() + count / 2);
    out.segment(from, count).setConstant(power[static_cast<std::size_t>(count / 2)]);
    from += count;
  }
  return out;
}

Pressure PressureOf(const RecordSpectra& record) {
  Pressure out;
  out.tapered = Tapered(record.pressure);
  out.bin_hz = record.bin_hz;
  out.cycle_hz = record.scale.cycle_hz;
  out.first_hz = record.s[0].imag() * out.cycle_hz;
  out.floor = MedianPower(out.tapered, out.first_hz / out.bin_hz);
  return out;
}

double OverFloor(const Pressure& p, double hz) {
  const double at = (hz - p.first_hz) / p.bin_hz;
  const Eigen::Index middle = std::lround(at);
  std::complex<double> sum = 0.0;
  double shape = 0.0;
  for (Eigen::Index i = std::max<Eigen::Index>(middle - kReach, 0);
       i <= std::min(middle + kReach, p.tapered.size() - 1); ++i) {
    const double bins = static_cast<double>(i) - at;
    const double edge = bins * bins - 0.25;
    // Half way between two bins it is in both of them alone, with either sign.
    const double u = std::abs(edge) > kHalfWay ? 1.0 / edge : std::copysign(1.0 / kHalfWay, -bins);
    sum += u * p.tapered[i];
    shape += u * u;
  }
  return std::norm(sum) /
         (shape * p.floor[std::clamp<Eigen::Index>(middle, 0, p.floor.size() - 1)]);
}

bool IsAwayFromCycle(const Pressure& p, double hz) {
  const double of_cycle = hz / p.cycle_hz;
  return std::abs(of_cycle - std::max(std::round(of_cycle), 1.0)) >= kLineReach;
}

double Best(const std::vector<Pressure>& rig, double from_hz, double to_hz, double step_hz) {
  double best_hz = 0.0;
  double most = 0.0;
  for (double hz = from_hz; hz <= to_hz; hz += step_hz) {
    double sum = 0.0;
    for (const Pressure& p : rig) {
      if (IsAwayFromCycle(p, hz)) sum += OverFloor(p, hz);
    }
    if (sum > most) {
      most = sum;
      best_hz = hz;
    }
  }
  return best_hz;
}

}  // namespace

double ToneIn(const LoopRecords& records) {
  std::vector<Pressure> rig;
  for (const OperatingPoint& point : records.Points({})) rig.push_back(PressureOf(point.record));
  const double from_hz = std::ranges::max(rig, {}, &Pressure::first_hz).first_hz;
  const double to_hz = std::ranges::min(rig, {}, &Pressure::LastHz).LastHz();
  const double bin_hz = std::ranges::min(rig, {}, &Pressure::bin_hz).bin_hz;
  const double near_hz = Best(rig, from_hz, to_hz, kStep * bin_hz);
  if (near_hz == 0.0) return 0.0;
  return Best(rig, near_hz - kStep * bin_hz, near_hz + kStep * bin_hz, kFineStep * bin_hz);
}

}  // namespace howl

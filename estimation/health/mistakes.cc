#include "estimation/health/mistakes.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "estimation/analysis/spectra/statistics.h"
#include "estimation/health/number_words.h"
#include "model/numerics/units.h"

namespace howl {
namespace {

constexpr double kHalfTurnDeg = 180.0;
constexpr double kPerKilo = 1e3;
// In kHz, the end of the joint fit's own search: a larger number is in Hz already.
constexpr double kLargestKilohertz = 100.0;

void InvertGain(Experiment& e) {
  const double inverse = 1.0 / e.gain;
  if (e.gain_std) *e.gain_std *= inverse * inverse;  // the relative error stays
  e.gain = inverse;
}

void ScaleFrequency(Experiment& e, double factor) {
  e.frequency_hz *= factor;
  if (e.frequency_std_hz) *e.frequency_std_hz *= factor;
}

void ScaleLines(Experiment& e, double factor) {
  for (ObservedLine& line : e.lines) {
    line.frequency_hz *= factor;
    line.frequency_std_hz *= factor;
  }
}

void ScaleSlope(Experiment& e, double factor) {
  if (e.flame_slope) *e.flame_slope *= factor;
  if (e.flame_slope_std) *e.flame_slope_std *= factor;
}

Mistake Inverted() {
  return {.id = "inverted",
          .text = "p or q with the wrong sign, as from an inverted transducer",
          .undone = "with phase_deg turned by 180 degrees",
          .in_records = true,
          .in_transfer = true,
          .undo = [](Experiment& e) {
            e.phase_deg = WrapDeg(e.phase_deg + kHalfTurnDeg);
            return true;
          }};
}

Mistake PhaseSign() {
  return {.id = "phase_sign",
          .text = "the phase counted the other way, from p to q or with a lag of p as positive",
          .undone = "with the sign of phase_deg changed",
          .undo = [](Experiment& e) {
            e.phase_deg = -e.phase_deg;
            return true;
          }};
}

Mistake Swapped(bool of_records) {
  return {.id = "p_and_q_swapped",
          .text = "p and q taken for each other",
          .undone = "with p and q exchanged",
          .in_tables = !of_records,
          .in_records = of_records,
          .in_transfer = true,
          .undo = [of_records](Experiment& e) {
            e.phase_deg = -e.phase_deg;
            InvertGain(e);
            if (of_records) e.flame_slope = e.flame_slope_std = std::nullopt;
            return true;
          }};
}

Mistake GainInverted() {
  return {.id = "gain_inverted",
          .text = "the gain as |q| / |p|, where |p| / |q| is asked for",
          .undone = "with 1 / gain",
          .undo = [](Experiment& e) {
            InvertGain(e);
            return true;
          }};
}

Mistake Radians() {
  return {.id = "phase_in_radians",
          .text = "the phase in radians, where degrees are asked for",
          .undone = "with phase_deg times 57.3",
          .undo = [](Experiment& e) {
            if (std::abs(e.phase_deg) > 2.0 * std::numbers::pi) return false;
            e.phase_deg *= kDegPerRad;
            if (e.phase_std_deg) *e.phase_std_deg *= kDegPerRad;
            return true;
          }};
}

Mistake Kilohertz() {
  return {.id = "frequency_in_khz",
          .text = "the frequency in kHz, where Hz are asked for",
          .undone = "with frequency_hz times 1000",
          .undo = [](Experiment& e) {
            if (e.frequency_hz > kLargestKilohertz) return false;
            ScaleFrequency(e, kPerKilo);
            return true;
          }};
}

Mistake RadiansPerSecond() {
  return {.id = "frequency_in_rad_per_s",
          .text = "the frequency in rad/s, where Hz are asked for",
          .undone = "with frequency_hz over 2 pi",
          .undo = [](Experiment& e) {
            ScaleFrequency(e, 1.0 / kRadPerSPerHz);
            return true;
          }};
}

Mistake LinesInKilohertz() {
  return {.id = "lines_in_khz",
          .text = "the line in kHz, where Hz are asked for",
          .undone = "with the line's frequency_hz times 1000",
          .undo = [](Experiment& e) {
            if (e.lines.empty() || e.lines.front().frequency_hz > kLargestKilohertz) return false;
            ScaleLines(e, kPerKilo);
            return true;
          }};
}

Mistake SlopeUnit(double factor) {
  return {.id = "flame_slope_unit",
          .text = "flame_slope or gain in another unit than the other, " + NumberWord(factor) +
                  " times too small",
          .undone = "with flame_slope times " + NumberWord(factor),
          .undo = [factor](Experiment& e) {
            if (!(MeasuredLoopGain(e) < kSmallestLoopGain)) return false;
            ScaleSlope(e, factor);
            return true;
          }};
}

Mistake SamplingRate(double factor) {
  return {.id = "sampling_rate",
          .text = "the sampling rate wrong by a factor of " + NumberWord(factor),
          .undone = "with it times " + NumberWord(factor),
          .in_tables = false,
          .in_records = true,
          .together = false,  // a loop in other units of time is the same loop
          .undo = [factor](Experiment& e) {
            ScaleFrequency(e, factor);
            ScaleLines(e, factor);
            ScaleSlope(e, 1.0 / factor);
            return true;
          }};
}

// The power of ten that brings the typical loop gain to one or above; zero where none is needed.
double SlopeFactor(std::span<const Experiment> experiments) {
  std::vector<double> gains;
  for (const Experiment& e : experiments) {
    const double gain = MeasuredLoopGain(e);
    if (e.reliable && gain > 0.0) gains.push_back(gain);
  }
  if (gains.empty()) return 0.0;
  const double typical = Median(gains);
  return typical < kSmallestLoopGain ? std::pow(10.0, std::ceil(-std::log10(typical))) : 0.0;
}

}  // namespace

double MeasuredLoopGain(const Experiment& experiment) {
  if (!experiment.flame_slope) return std::numeric_limits<double>::quiet_NaN();
  return experiment.gain * std::abs(*experiment.flame_slope) * kRadPerSPerHz *
         experiment.frequency_hz;
}

std::vector<Mistake> PossibleMistakes(std::span<const Experiment> experiments) {
  std::vector<Mistake> mistakes = {Inverted(),    PhaseSign(),        Swapped(false),
                                   Swapped(true), GainInverted(),     Radians(),
                                   Kilohertz(),   LinesInKilohertz(), RadiansPerSecond()};
  if (const double factor = SlopeFactor(experiments); factor > 0.0) {
    mistakes.push_back(SlopeUnit(factor));
  }
  for (const double factor : {1e3, 1e-3, 10.0, 0.1, 2.0, 0.5}) {
    mistakes.push_back(SamplingRate(factor));
  }
  return mistakes;
}

}  // namespace howl

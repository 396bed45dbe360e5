#include "app/text/record_fit_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "app/text/text_table.h"
#include "estimation/analysis/spectra/half_width.h"
#include "estimation/health/mended_records.h"
#include "estimation/joint_records/loop_names.h"

namespace howl {
namespace {

std::string PlusMinus(const Estimate& estimate, int digits) {
  return Significant(estimate.value, digits) + " ± " + Significant(HalfWidth95(estimate), 2);
}

Estimate Scaled(const Estimate& estimate, double factor) {
  return {factor * estimate.value, factor * estimate.std};
}

std::string LoopsText(const RecordSolution& solution, const std::string& operating_parameter) {
  TextTable table({"experiment", operating_parameter, "f Hz", "tau ms", "loop gain", "growth 1/s"});
  for (std::size_t e = 0; e < solution.fitted.size(); ++e) {
    const FittedLoop& loop = solution.fitted[e];
    table.AddRow({solution.names[e] + (loop.converged ? "" : " *"),
                  Significant(solution.loop.points[e].operating_parameter), Fixed(loop.cycle_hz, 1),
                  PlusMinus(Scaled(loop.tau_s, 1e3), 4), PlusMinus(loop.small_signal.loop_gain, 4),
                  PlusMinus(loop.small_signal.growth_rate_1_s, 3)});
  }
  std::string out =
      table.Text() + kPlusMinusLegend + "; gain and growth: of small signals about rest";
  if (!solution.Converged()) out += "; * not converged";
  return out + "\n";
}

std::string LostLine(const std::string& of_what, double share, const std::string& what_becomes) {
  return Wrapped(
             of_what + " " + Significant(100.0 * share, 2) + " % of its samples, " + what_becomes,
             2) +
         "\n";
}

// What was lost of the records while a signal stood still, and of p beyond the ends of its range.
std::string LostText(const RecordSolution& solution) {
  std::string out;
  for (std::size_t e = 0; e < solution.stuck.size(); ++e) {
    for (std::size_t channel = 0; channel < 2; ++channel) {
      const double stuck = solution.stuck[e][channel];
      if (stuck == 0.0) continue;
      out += LostLine(
          solution.names[e] + (channel == 0 ? ": p" : ": q") + " stands still for", stuck,
          stuck <= kMostStuck ? "which are filled from the other signal"
                              : "too many to be filled: the loop is one of what stands there");
    }
    const double clipped = solution.clipped[e];
    if (clipped == 0.0) continue;
    out += LostLine(solution.names[e] + ": p is clipped in", clipped,
                    clipped <= kMostClipped
                        ? "which are drawn from q and from what stands beside them"
                        : "too many to be made good: the loop is one of what stands there");
  }
  return out;
}

// What users look at first, in the words of the table.
constexpr std::array<std::pair<const char*, const char*>, 4> kScaled = {
    {{"tau_s", "delays"},
     {"small_signal.loop_gain", "loop gains"},
     {"small_signal.growth_rate_1_s", "growth rates"},
     {"small_signal.frequency_hz", "frequencies"}}};
// From here on what the halves show is more of the model's error than of noise.
constexpr double kHalvesDisagree = 3.0;

std::string WorstText(const RecordSolution& solution, const IntervalScale& growth) {
  const HalfLoops& halves = solution.halves[growth.worst];
  return "; farthest apart at " + solution.names[growth.worst] + ", whose first half grows at " +
         PlusMinus(halves[0].small_signal.growth_rate_1_s, 3) + " 1/s and whose second at " +
         PlusMinus(halves[1].small_signal.growth_rate_1_s, 3) +
         ": the model is not the rig's, or the rig has changed";
}

std::string HalvesText(const RecordSolution& solution) {
  std::string out;
  std::string worst;
  for (const auto& [quantity, words] : kScaled) {
    const auto scale = std::ranges::find(solution.scales, quantity, &IntervalScale::quantity);
    if (scale == solution.scales.end()) continue;
    out += (out.empty() ? "" : ", ") + std::string(words) + " " + Significant(scale->halves, 2);
    const bool growth = scale->quantity == "small_signal.growth_rate_1_s";
    if (growth && scale->halves > kHalvesDisagree) worst = WorstText(solution, *scale);
  }
  if (out.empty()) return "";
  return Wrapped(
             "halves of the records, fitted by themselves, differ from one another and from "
             "the whole by so many of their own standard deviations, in the mean square: " +
                 out + "; of a right model by 1, and all intervals are as much wider" + worst,
             2) +
         "\n";
}

std::string OnsetText(const RecordSolution& solution, const std::string& operating_parameter) {
  const Onset& onset = solution.onset;
  if (!onset.at.available) {
    if (solution.fitted.size() != 2) return "";
    return Wrapped(
               "where small oscillations begin to grow, two points cannot tell: nothing shows "
               "whether their loop gains lie on a straight line",
               2) +
           "\n";
  }
  if (!std::isfinite(onset.frequency_hz.value)) {
    return "where small oscillations begin to grow, a straight line through these loop gains "
           "cannot tell\n";
  }
  return Wrapped("the loop gain about rest reaches one, and a cycle begins or ends, at " +
                     operating_parameter + " " + Significant(onset.at.phi, 4) +
                     " (95 %: " + Significant(onset.at.lo, 4) + " .. " +
                     Significant(onset.at.hi, 4) + "), at " + PlusMinus(onset.frequency_hz, 4) +
                     " Hz, by straight lines through the points' loop gains and frequencies",
                 2) +
         "\n";
}

constexpr std::size_t kMostOthers = 3;

std::string DelaysText(const RecordSolution& solution) {
  TextTable table({"experiment", "tau ms", "other delays ms (nats less likely)"});
  for (std::size_t e = 0; e < solution.fitted.size(); ++e) {
    std::string others;
    for (std::size_t i = 0; i < std::min(solution.other_delays[e].size(), kMostOthers); ++i) {
      const OtherDelay& other = solution.other_delays[e][i];
      if (i > 0) others += ", ";
      others += Significant(1e3 * other.tau_s, 3) + " (" + Fixed(other.nats_below, 0) + ")";
    }
    table.AddRow({solution.names[e], Significant(1e3 * solution.fitted[e].tau_s.value, 4), others});
  }
  return table.Text() +
         "other delays: where this record by itself has a maximum too; the interval of tau knows "
         "of none\nof them, and nats hold as far as the model does\n";
}

// Root mean square over points and lines.
double LineError(const RecordSolution& solution, std::vector<FittedLineError> FittedLoop::*of_cut) {
  double square = 0.0;
  double count = 0.0;
  for (const FittedLoop& loop : solution.fitted) {
    for (const FittedLineError& line : loop.*of_cut) square += line.Size() * line.Size();
    count += static_cast<double>((loop.*of_cut).size());
  }
  return std::sqrt(square / std::max(count, 1.0));
}

// From here on what the curve says of the cycle is of the size of what it does not.
constexpr double kLargeLineError = 0.3;

std::string LinesText(const RecordSolution& solution) {
  if (solution.fitted[0].flame_lines.empty()) return "";
  const double acoustics = LineError(solution, &FittedLoop::acoustic_lines);
  const double flame = LineError(solution, &FittedLoop::flame_lines);
  std::string out = "of the cycle's own lines the acoustics miss " +
                    Significant(100.0 * acoustics, 2) + " % and the flame's curve " +
                    Significant(100.0 * flame, 2) + " %, root mean square over points and lines";
  if (std::max(acoustics, flame) > kLargeLineError) {
    out +=
        ": the cycle is not the one of this loop, whose modes, delay and noise rest on what the "
        "records show beside the lines";
  }
  return Wrapped(out, 2) + "\n";
}

std::string ModesText(const RecordSolution& solution) {
  TextTable table({"experiment", "mode", "omega Hz", "xi", "N", "angle"});
  for (std::size_t e = 0; e < solution.fitted.size(); ++e) {
    int number = 0;
    for (const FittedMode& mode : solution.fitted[e].modes) {
      const double angle = std::atan2(mode.B.value, mode.N.value) * 180.0 / std::numbers::pi;
      table.AddRow({solution.names[e], std::to_string(++number), PlusMinus(mode.omega_hz, 5),
                    PlusMinus(mode.xi, 3), PlusMinus(mode.N, 4),
                    Fixed(std::round(angle) + 0.0, 0)});  // no -0
    }
  }
  return table.Text() + "angle: of the residue N + j B, in degrees; 0: p measured at the flame\n";
}

std::string TriedText(const ChosenLoop& loop) {
  const double best = loop.tried[loop.chosen].Sum();
  if (loop.tried.size() == 1) {
    return "density of each record by what the others show: " + Significant(best, 6) +
           " nats in all\n";
  }
  TextTable table({"flame input", "modes", "nats", "below the best"});
  for (const LoopTried& one : loop.tried) {
    table.AddRow({FlameInputName(one.flame_input), std::to_string(one.modes), Fixed(one.Sum(), 1),
                  Fixed(best - one.Sum(), 1)});
  }
  return table.Text() +
         "nats: of the density of each record by what the others show; a difference of 3 is odds "
         "of 20\n";
}

}  // namespace

std::string RecordFitText(const RecordSolution& solution, const std::string& operating_parameter) {
  return LoopsText(solution, operating_parameter) + LostText(solution) + HalvesText(solution) +
         OnsetText(solution, operating_parameter) + DelaysText(solution) + LinesText(solution) +
         ModesText(solution) + TriedText(solution.loop);
}

}  // namespace howl

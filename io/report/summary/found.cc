#include <cmath>

#include "io/report/summary/summary.h"
#include "io/report/summary/words.h"

namespace howl {
namespace {

// "0.56": the operating parameter as it stands, not rounded to three digits.
std::string Point(double phi) { return Spelled(phi, 6); }

// "0.45 to 0.56"
std::string Reach(const std::vector<double>& phis) {
  if (phis.size() == 1) return Point(phis.front());
  return Point(std::ranges::min(phis)) + " to " + Point(std::ranges::max(phis));
}

void AddCycles(const ReportInput& input, std::vector<std::string>& out) {
  if (input.measured.empty()) return;
  std::vector<double> frequencies, phis;
  std::vector<std::string> quiet, below;
  std::size_t reliable = 0, known = 0;
  for (const MeasuredPoint& point : input.measured) {
    phis.push_back(point.phi);
    if (!point.has_cycle()) {
      quiet.push_back(point.name);
      continue;
    }
    frequencies.push_back(point.frequency_hz.value);
    if (!point.reliable) continue;
    ++reliable;
    if (!std::isfinite(point.loop_gain.value)) continue;
    ++known;
    if (point.loop_gain.value <= 1.0) below.push_back(point.name);
  }
  const std::string points = Counted(input.measured.size(), "experiment") + " (" +
                             input.operating_parameter + " " + Reach(phis) + ")";
  if (frequencies.empty()) {
    out.push_back("None of the " + points + " shows a limit cycle.");
    return;
  }
  const std::string who = quiet.empty() ? (input.measured.size() == 1 ? "The " : "All ") + points
                                        : std::to_string(frequencies.size()) + " of " + points;
  out.push_back(who + (frequencies.size() == 1 ? " shows" : " show") + " a limit cycle, at " +
                FromTo(frequencies, "Hz") + "; " + std::to_string(reliable) + " of them " +
                (reliable == 1 ? "is" : "are") + " reliable." +
                (quiet.empty() ? "" : " Without one: " + Listed(quiet) + "."));
  if (known == 0) return;
  if (below.empty()) {
    out.push_back(
        "The loop gain at the cycle is above one in every reliable experiment, as (1b) "
        "asks of a loop that oscillates by itself.");
  } else {
    out.push_back("The loop gain at the cycle is not above one in " + Listed(below) +
                  ": by (1b) such a loop would not begin to oscillate by itself.");
  }
}

void AddFit(const ReportInput& input, std::vector<std::string>& out) {
  if (input.fitted.empty()) return;
  std::vector<double> omega, xi, tau;
  for (const ExperimentModel& fit : input.fitted) {
    omega.push_back(fit.model.omega_hz);
    xi.push_back(fit.model.xi);
    tau.push_back(1e3 * fit.model.tau_s);
  }
  out.push_back("The joint fit has a natural frequency of " + FromTo(omega, "Hz") +
                ", a damping ratio of " + FromTo(xi) + " and a delay of " + FromTo(tau, "ms") +
                (input.solution.value("converged", false) ? "." : "; no start converged."));
}

void AddFamily(const ReportInput& input, std::vector<std::string>& out) {
  if (input.FamilyIsEmpty()) {
    std::vector<std::string> names;
    for (const auto& name : ListAt(input.family, "empty_because")) {
      if (name.is_string()) names.push_back(name.get<std::string>());
    }
    out.push_back(
        "No model passes the test" +
        (names.empty() ? std::string(".") : ": " + Listed(names) + " exclude each other."));
  } else if (input.members) {
    out.push_back(Counted(input.members->models.size(), "model") + " that the data cannot reject " +
                  (input.members->models.size() == 1 ? "is" : "are") + " listed.");
  }
}

std::string End(const nlohmann::json& cycle, const char* key) {
  const nlohmann::json& end = JsonAt(cycle, key);
  const double value = NumberAt(end, "value");
  if (!std::isfinite(value)) return "";
  const double lo = NumberAt(end, "lo"), hi = NumberAt(end, "hi");
  std::string out = std::string("it ") + key + " at " + Spelled(value, 4);
  if (std::isfinite(lo) && std::isfinite(hi)) {
    out += " (95 % of the members: " + Spelled(lo, 4) + " to " + Spelled(hi, 4) + ")";
  }
  return out;
}

void AddPrediction(const ReportInput& input, std::vector<std::string>& out) {
  if (!input.prediction.is_object()) return;
  std::vector<double> phis, frequencies, shares;
  for (const auto& point : ListAt(input.prediction, "points")) {
    const double share = NumberAt(point, "share_unstable");
    if (!std::isfinite(share)) continue;
    phis.push_back(NumberAt(point, "phi"));
    frequencies.push_back(NumberAt(JsonAt(point, "frequency_hz"), "value"));
    shares.push_back(100.0 * share);
  }
  if (!phis.empty()) {
    out.push_back("Predicted for " + input.operating_parameter + " " + Reach(phis) + ": " +
                  FromTo(frequencies, "Hz") +
                  (NumberAt(input.prediction, "members") == 0.0
                       ? ", unstable at rest with a probability of " + FromTo(shares, "%")
                       : ", unstable at rest for " + FromTo(shares, "% of the members")) +
                  ".");
  }
  const nlohmann::json& cycle = JsonAt(input.prediction, "cycle");
  const std::string begins = End(cycle, "begins");
  const std::string ends = End(cycle, "ends");
  if (begins.empty() && ends.empty()) return;
  out.push_back("Where the cycle is, in " + input.operating_parameter + ": " + begins +
                (begins.empty() || ends.empty() ? "" : ", ") + ends + ".");
}

void AddVerdict(const ReportInput& input, std::vector<std::string>& out) {
  const nlohmann::json& verdict = JsonAt(input.diagnosis, "verdict");
  const std::string kind = TextAt(verdict, "kind");
  if (kind == "none") {
    out.push_back("The model explains the records: no cause of a gap was found.");
  } else if (kind == "effect") {
    out.push_back("The model falls short of the rig by: " + TextAt(verdict, "effect") + ".");
  } else if (kind == "unknown") {
    const std::string because = TextAt(input.diagnosis, "unknown_because");
    out.push_back(
        "The model falls short of the rig by a cause that is not in the catalogue, or "
        "by several together: the verdict is unknown" +
        (because.empty() ? "." : "; " + because + "."));
  }
}

}  // namespace

std::vector<std::string> WhatWasFound(const ReportInput& input) {
  std::vector<std::string> out;
  AddCycles(input, out);
  AddFit(input, out);
  AddFamily(input, out);
  AddPrediction(input, out);
  AddVerdict(input, out);
  return out;
}

}  // namespace howl

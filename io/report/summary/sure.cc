#include <cmath>
#include <set>

#include "io/report/summary/summary.h"
#include "io/report/summary/words.h"

namespace howl {
namespace {

void AddHealth(const ReportInput& input, std::vector<std::string>& out) {
  std::set<std::string> texts;
  bool asked = false;
  for (const nlohmann::json* file : {&input.solution, &input.analysis}) {
    asked = asked || (file->is_object() && file->contains("health"));
    for (const auto& finding : ListAt(*file, "health")) {
      const std::string text = TextAt(finding, "text");
      if (!text.empty()) texts.insert(text);
    }
  }
  if (!asked) return;
  if (texts.empty()) {
    out.push_back(
        "Nothing in the data or the fit speaks against them: no parameter at a bound, no "
        "residual beyond three standard deviations.");
  } else {
    out.push_back(Counted(texts.size(), "finding") + (texts.size() == 1 ? " speaks" : " speak") +
                  " against the data or the fit: they are listed below.");
  }
}

void AddUndetermined(const ReportInput& input, std::vector<std::string>& out) {
  const std::size_t open = ListAt(JsonAt(input.solution, "identifiability"), "undetermined").size();
  if (open == 0) return;
  out.push_back("The joint fit is one choice: " + Counted(open, "direction") +
                " of its parameters " + (open == 1 ? "is" : "are") +
                " held by what was assumed, not by the data. The family shows how wide they are.");
}

// "xi 0.0000012 to 0.3": a bound of the family that nothing exceeds.
std::string Bound(const nlohmann::json& bounds, const char* key, const std::string& name,
                  double scale, const std::string& unit) {
  const nlohmann::json& outer = ListAt(JsonAt(bounds, key), "outer");
  if (outer.size() != 2 || !outer[0].is_number() || !outer[1].is_number()) return "";
  return name + " " + FromTo(scale * outer[0].get<double>(), scale * outer[1].get<double>(), unit);
}

void AddBounds(const ReportInput& input, std::vector<std::string>& out) {
  const MeasuredPoint* const point = input.Reference();
  if (point == nullptr) return;
  const nlohmann::json& bounds = JsonAt(JsonAt(input.family, "bounds"), point->name.c_str());
  std::vector<std::string> parts;
  for (const std::string& part : {Bound(bounds, "omega_hz", "the natural frequency", 1.0, "Hz"),
                                  Bound(bounds, "xi", "the damping ratio", 1.0, ""),
                                  Bound(bounds, "tau_s", "the delay", 1e3, "ms")}) {
    if (!part.empty()) parts.push_back(part);
  }
  if (parts.empty()) return;
  out.push_back("Guaranteed for " + point->name +
                ", whatever model passes the test: " + Listed(parts) + ".");
}

void AddTolerances(const ReportInput& input, std::vector<std::string>& out) {
  if (NumberAt(JsonAt(input.family, "test"), "loop_gain_min") != 0.0) return;
  out.push_back(
      "The family was asked for without loop_gain_min: its models need not oscillate by "
      "themselves, as the rig did.");
}

void AddHowSurePrediction(const ReportInput& input, std::vector<std::string>& out) {
  if (!input.prediction.is_object()) return;
  std::vector<std::string> far;
  for (const auto& point : ListAt(input.prediction, "points")) {
    if (TextAt(point, "status") == "outside") far.push_back(Spelled(NumberAt(point, "phi"), 6));
  }
  // A loop that was fitted to whole records has no family.
  const bool of_records = NumberAt(input.prediction, "members") == 0.0;
  out.push_back(
      std::string(of_records ? "Predictions are intervals of 95 %; nothing of them is guaranteed."
                             : "Predictions are intervals of 95 % of the members; only at a "
                               "measured point is anything guaranteed.") +
      (far.empty() ? std::string() : " Too far from what was measured: " + Listed(far) + "."));
}

void AddGap(const ReportInput& input, std::vector<std::string>& out) {
  const nlohmann::json& gap = JsonAt(input.diagnosis, "gap");
  const double before = NumberAt(gap, "before"), after = NumberAt(gap, "after");
  const double floor = NumberAt(gap, "floor");
  if (std::isfinite(before) && std::isfinite(after)) {
    out.push_back("On held-out samples the gap of the model is " + Spelled(before, kSummaryDigits) +
                  ", with the best candidate " + Spelled(after, kSummaryDigits) +
                  (std::isfinite(floor)
                       ? "; a perfect model would leave " + Spelled(floor, kSummaryDigits)
                       : std::string()) +
                  ".");
  }
  const nlohmann::json& verdict = JsonAt(input.diagnosis, "verdict");
  const std::string kind = TextAt(verdict, "kind");
  const std::string key = kind == "effect" ? TextAt(verdict, "effect") : kind;
  const double probability = NumberAt(JsonAt(verdict, "probability"), key.c_str());
  if (!std::isfinite(probability)) return;
  std::vector<std::string> others;
  for (const auto& id : ListAt(verdict, "indistinguishable")) {
    if (id.is_string()) others.push_back(id.get<std::string>());
  }
  out.push_back("The verdict has a probability of " + Spelled(probability, 2) +
                (others.empty() ? "." : "; the data cannot tell it from " + Listed(others) + "."));
}

}  // namespace

std::vector<std::string> HowSureItIs(const ReportInput& input) {
  std::vector<std::string> out;
  AddHealth(input, out);
  AddUndetermined(input, out);
  AddBounds(input, out);
  AddTolerances(input, out);
  AddHowSurePrediction(input, out);
  AddGap(input, out);
  return out;
}

}  // namespace howl

#include <cmath>

#include "io/report/summary/summary.h"
#include "io/report/summary/words.h"

namespace howl {
namespace {

// The changes of one condition that give an empty family a member.
void AddChanges(const ReportInput& input, std::vector<std::string>& out) {
  if (!input.FamilyIsEmpty()) return;
  std::vector<std::string> parts;
  for (const auto& each : ListAt(JsonAt(input.family, "conflict"), "relaxations")) {
    if (JsonAt(each, "suffices") != true) continue;
    const double needed = NumberAt(each, "needed");
    const std::string condition = TextAt(each, "condition");
    parts.push_back(std::isfinite(needed)
                        ? condition + " " + Spelled(needed, kSummaryDigits) + " in place of " +
                              Spelled(NumberAt(each, "value"), kSummaryDigits)
                        : "no " + condition);
  }
  if (parts.empty()) {
    out.push_back(
        "No single condition of the test, given up, gives a model: look for a mistake in "
        "the data, or ask for a richer model.");
    return;
  }
  out.push_back("To have a model at all, doubt one of these: " + Listed(parts) +
                ". howl family --without NAME leaves a condition out.");
}

void AddUnreliable(const ReportInput& input, std::vector<std::string>& out) {
  std::vector<std::string> names;
  for (const MeasuredPoint& point : input.measured) {
    if (!point.reliable) names.push_back(point.name);
  }
  if (names.empty() || names.size() == input.measured.size()) return;
  out.push_back("Records of " + Listed(names) +
                " that hold still for longer would count in full: now they weigh less.");
}

void AddAdvice(const ReportInput& input, std::vector<std::string>& out) {
  std::string advice = TextAt(input.diagnosis, "advice");
  if (advice.empty()) return;
  const bool is_command = advice.starts_with("howl ");
  if (!is_command && advice.front() >= 'a' && advice.front() <= 'z') advice.front() -= 'a' - 'A';
  out.push_back(advice + ".");
}

void AddCommands(const ReportInput& input, std::vector<std::string>& out) {
  if (input.measured.empty()) return;
  const bool has_records = !input.records.empty();
  if (has_records && input.analysis.is_null()) {
    out.push_back("howl analyse shows what the records hold, and how surely.");
  }
  if (input.solution.is_null())
    out.push_back("howl fit finds a loop for all experiments together.");
  if (input.family.is_null() && !input.members)
    out.push_back("howl family says what the data leave open.");
  if (input.members && input.prediction.is_null() && input.measured.size() > 1) {
    out.push_back(
        "howl predict says what to expect between the measured points, and with --map "
        "where the loop is stable.");
  }
  if (has_records && input.diagnosis.is_null()) {
    out.push_back("howl diagnose says where and why the model falls short of the records.");
  }
}

}  // namespace

std::vector<std::string> WhatToDoNext(const ReportInput& input) {
  std::vector<std::string> out;
  AddChanges(input, out);
  AddAdvice(input, out);
  AddUnreliable(input, out);
  AddCommands(input, out);
  return out;
}

}  // namespace howl

#include "app/text/loop_diagnosis_text.h"

#include <cmath>
#include <string>
#include <vector>

#include "app/text/budget_text.h"
#include "app/text/place_text.h"
#include "app/text/text_table.h"

namespace howl {
namespace {

std::string VerdictText(const LoopDiagnosis& found) {
  const Diagnosis& diagnosis = found.diagnosis;
  switch (diagnosis.kind) {
    case VerdictKind::kNone:
      return "verdict: none; nothing that the loop may lack foretells the records better "
             "(probability " +
             Fixed(diagnosis.probability_none, 2) + ")";
    case VerdictKind::kEffect:
      return "verdict: " + diagnosis.effect + " (probability " +
             Fixed(diagnosis.candidates.front().probability, 2) + ")";
    case VerdictKind::kUnknown:
      break;
  }
  return "verdict: unknown; " + found.unknown_because + " (probability " +
         Fixed(diagnosis.probability_unknown, 2) + ")";
}

std::string AlikeText(const Diagnosis& diagnosis) {
  std::string out;
  for (const std::string& other : diagnosis.indistinguishable) {
    out += "  the data cannot tell it from " + other + "\n";
  }
  return out;
}

// Of what is named; what is left has lines of its own.
std::string WhereText(const Diagnosis& diagnosis) {
  std::string out;
  if (diagnosis.kind != VerdictKind::kEffect) return out;
  for (const Place& place : diagnosis.where) {
    out += "where: " + std::string(LoopBlockName(place.block)) + ", " + ExtentText(place) + "\n";
  }
  return out;
}

std::string LinesText(const std::string& cut, const LinesLeft& lines, std::size_t points) {
  return "free errors of " + cut + " at the cycle's lines: " + Fixed(lines.nats, 1) + " nats, on " +
         std::to_string(lines.experiments_better) + " of " + std::to_string(points) +
         " points; of " + Significant(100.0 * lines.size, 2) + " % of what the loop foretells" +
         (lines.AreOfGain() ? ", as a gain that fluctuates makes them" : "") + "\n";
}

// What else would gain alone.
std::string AloneText(const Diagnosis& diagnosis) {
  constexpr std::size_t kShown = 5;
  std::string out;
  std::size_t shown = 0;
  for (const Candidate& candidate : diagnosis.candidates) {
    // What is named has a gap, which the points together leave.
    if (!std::isnan(candidate.gap_after) || shown == kShown) continue;
    out += (out.empty() ? "" : ", ") + candidate.effect + " " + Fixed(candidate.gain, 0);
    ++shown;
  }
  return out.empty() ? "" : Wrapped("alone, at each point by itself, nats: " + out, 2) + "\n";
}

std::string WithCommas(const std::vector<std::string>& items) {
  std::string out;
  for (const std::string& item : items) out += (out.empty() ? "" : ",") + item;
  return out;
}

}  // namespace

std::string LoopDiagnosisText(const LoopDiagnosis& found) {
  const Budget& budget = *found.diagnosis.budget;
  std::string out = Wrapped(VerdictText(found), 2) + "\n" + AlikeText(found.diagnosis) +
                    WhereText(found.diagnosis);
  out += BudgetText(budget);
  out += AloneText(found.diagnosis);
  out += LinesText("p from q", found.acoustics, budget.experiments);
  out += LinesText("q from p", found.flame, budget.experiments);
  out += Wrapped("next: " + found.diagnosis.advice, 2) + "\n";
  if (!found.items.empty()) out += "to go on from there: --with " + WithCommas(found.items) + "\n";
  return out;
}

}  // namespace howl

#include "app/text/loop_diagnosis_text.h"

#include <string>
#include <vector>

#include "app/text/budget_text.h"
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
  return "verdict: unknown; the best loop still errs at the cycle's lines (probability " +
         Fixed(diagnosis.probability_unknown, 2) + ")";
}

std::string LinesText(const std::string& cut, const LinesLeft& lines, std::size_t points) {
  return "free errors of " + cut + " at the cycle's lines: " + Fixed(lines.nats, 1) + " nats, on " +
         std::to_string(lines.experiments_better) + " of " + std::to_string(points) +
         " points; of " + Significant(100.0 * lines.size, 2) + " % of what the loop foretells\n";
}

std::string Listed(const std::vector<std::string>& items) {
  std::string out;
  for (const std::string& item : items) out += (out.empty() ? "" : ",") + item;
  return out;
}

}  // namespace

std::string LoopDiagnosisText(const LoopDiagnosis& found) {
  const Budget& budget = *found.diagnosis.budget;
  std::string out = Wrapped(VerdictText(found), 2) + "\n";
  out += BudgetText(budget);
  out += LinesText("p from q", found.acoustics, budget.experiments);
  out += LinesText("q from p", found.flame, budget.experiments);
  out += Wrapped("next: " + found.diagnosis.advice, 2) + "\n";
  if (!found.items.empty()) out += "to go on from there: --with " + Listed(found.items) + "\n";
  return out;
}

}  // namespace howl

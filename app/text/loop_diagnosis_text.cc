#include "app/text/loop_diagnosis_text.h"

#include <cstdlib>
#include <map>
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

// "f / 4", "f / 2", "f", "2 f", ...
std::string OctaveText(int octave) {
  const std::string factor = std::to_string(1 << std::abs(octave));
  if (octave == 0) return "f";
  return octave < 0 ? "f / " + factor : factor + " f";
}

// A row a point and signal, a column an octave about the cycle's frequency f.
std::string OctavesText(const std::vector<OctaveGap>& gaps) {
  std::map<int, std::size_t> columns;
  for (const OctaveGap& each : gaps) columns[each.octave] = 0;
  std::vector<std::string> head = {"gap left at", "of"};
  for (auto& [octave, column] : columns) {
    column = head.size();
    head.push_back(OctaveText(octave));
  }
  TextTable table(head);
  std::vector<std::string> row;
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    if (row.empty()) {
      row.assign(head.size(), "");
      row[0] = gaps[i].experiment;
      row[1] = gaps[i].block == LoopBlock::kAcoustics ? "p from q" : "q from p";
    }
    row[columns[gaps[i].octave]] = Fixed(gaps[i].gap, 2);
    const bool last = i + 1 == gaps.size() || gaps[i + 1].experiment != gaps[i].experiment ||
                      gaps[i + 1].block != gaps[i].block;
    if (!last) continue;
    table.AddRow(row);
    row.clear();
  }
  return table.Text();
}

}  // namespace

std::string LoopDiagnosisText(const LoopDiagnosis& found) {
  const Budget& budget = *found.diagnosis.budget;
  std::string out = Wrapped(VerdictText(found), 2) + "\n";
  out += budget.entries.empty() ? "gap, left out: " + Fixed(budget.gap_left, 3) + "\n"
                                : BudgetText(budget);
  out += "floor of the gap, of a loop that is right: " + Fixed(budget.floor, 3) + "\n";
  if (budget.gap_left > budget.floor) out += OctavesText(budget.left_by_octave);
  out += LinesText("p from q", found.acoustics, budget.experiments);
  out += LinesText("q from p", found.flame, budget.experiments);
  out += Wrapped("next: " + found.diagnosis.advice, 2) + "\n";
  return out;
}

}  // namespace howl

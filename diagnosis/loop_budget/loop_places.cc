#include "diagnosis/loop_budget/loop_places.h"

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include "diagnosis/loop_budget/sample_facts.h"

namespace howl {
namespace {

// The cuts that err at the cycle's lines, by what free errors gain there.
std::vector<Place> PlacesOfLines(const LoopDiagnosis& of, double least) {
  std::vector<Place> out;
  double sum = 0.0;
  for (const auto& [block, lines] :
       {std::pair(LoopBlock::kAcoustics, of.acoustics), std::pair(LoopBlock::kFlame, of.flame)}) {
    if (!(lines.NatsAgainst() > least)) continue;
    out.push_back(of.diagnosis.budget->everywhere);
    out.back().block = block;
    out.back().share = lines.nats;
    sum += lines.nats;
  }
  for (Place& place : out) place.share /= sum;
  std::ranges::stable_sort(out, std::ranges::greater(), &Place::share);
  return out;
}

}  // namespace

std::vector<Place> PlacesOf(const LoopDiagnosis& of, double least_of_lines) {
  const Diagnosis& diagnosis = of.diagnosis;
  const Budget& budget = *diagnosis.budget;
  std::vector<Place> out;
  if (diagnosis.kind == VerdictKind::kUnknown) out = PlacesOfLines(of, least_of_lines);
  if (diagnosis.kind != VerdictKind::kEffect) return out.empty() ? budget.left : out;
  for (const SampleFact& fact : budget.seen_in_samples) {
    Place place = budget.everywhere;
    place.block = fact.block;
    if (fact.line_hz > 0.0) place.low_hz = place.high_hz = fact.line_hz;
    place.share =
        budget.entries.empty() ? 1.0 / static_cast<double>(budget.seen_in_samples.size()) : 0.0;
    out.push_back(std::move(place));
  }
  if (!RestCanBeFound(budget.seen_in_samples)) return out;
  double sum = 0.0;
  for (const BudgetEntry& entry : budget.entries) sum += entry.lost_nats;
  for (const BudgetEntry& entry : budget.entries) {
    out.push_back(entry.place);
    out.back().share = entry.lost_nats / sum;
  }
  std::ranges::stable_sort(out, std::ranges::greater(), &Place::share);
  return out;
}

}  // namespace howl

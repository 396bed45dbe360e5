#include "trial/score.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <sstream>

namespace howl {
namespace {

constexpr double kLeastProbability = 1e-3;
constexpr double kMediumSeverity = 0.4;
constexpr double kOracleShrinkage = 0.1;
constexpr std::size_t kReliabilityBins = 5;

// Of those that are numbers: a damaged diagnosis has gaps that are none, and they have no order.
double Median(std::vector<double> x) {
  std::erase_if(x, [](double value) { return std::isnan(value); });
  if (x.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::ranges::sort(x);
  const std::size_t n = x.size();
  return n % 2 == 1 ? x[n / 2] : 0.5 * (x[n / 2 - 1] + x[n / 2]);
}

double Probability(const CaseOutcome& one, const std::string& label) {
  const auto found = one.probability.find(label);
  return found == one.probability.end() ? 0.0 : found->second;
}

double Brier(const CaseOutcome& one) {
  const std::string truth = one.TruthName();
  double sum = 0.0;
  bool has_truth = false;
  for (const auto& [label, p] : one.probability) {
    const bool is_truth = label == truth;
    has_truth = has_truth || is_truth;
    sum += (p - (is_truth ? 1.0 : 0.0)) * (p - (is_truth ? 1.0 : 0.0));
  }
  return sum + (has_truth ? 0.0 : 1.0);
}

// The number of withheld effects in an answer "a" or "a+b"; zero if it has any other.
int NamedIn(const std::string& answer, const CaseOutcome& one) {
  int right = 0;
  int parts = 0;
  std::istringstream words(answer);
  for (std::string id; std::getline(words, id, '+');) {
    ++parts;
    right += std::ranges::count(one.withheld, id, &WithheldEffect::id) > 0 ? 1 : 0;
  }
  return right == parts ? right : 0;
}

int NamedOfTwo(const CaseOutcome& one) {
  return one.kind == "effect" ? NamedIn(one.effect, one) : 0;
}

// Of two effects in either order.
bool IsTruth(const CaseOutcome& one, const std::string& answer) {
  return one.Truth() == TruthKind::kPair ? NamedIn(answer, one) == 2 : answer == one.TruthName();
}

void CountReliability(const CaseOutcome& one, std::vector<ReliabilityBin>& bins) {
  const auto top =
      std::ranges::max_element(one.probability, {}, [](const auto& each) { return each.second; });
  if (top == one.probability.end()) return;
  for (ReliabilityBin& bin : bins) {
    if (top->second > bin.high && &bin != &bins.back()) continue;
    bin.mean_probability += top->second;  // the mean comes at the end
    bin.right.Count(IsTruth(one, top->first));
    return;
  }
}

const CandidateOutcome* Candidate(const CaseOutcome& one, const std::string& id) {
  const auto found = std::ranges::find(one.candidates, id, &CandidateOutcome::effect);
  return found == one.candidates.end() ? nullptr : &*found;
}

MethodScore ScoreMethod(const std::string& method, std::span<const CaseOutcome> cases) {
  MethodScore score;
  score.method = method;
  for (std::size_t i = 0; i < kReliabilityBins; ++i) {
    score.reliability.push_back({static_cast<double>(i) / kReliabilityBins,
                                 static_cast<double>(i + 1) / kReliabilityBins,
                                 0.0,
                                 {}});
  }
  std::vector<double> ratios;
  int scored = 0;
  for (const CaseOutcome& one : cases) {
    const bool unknown = one.answered && one.kind == "unknown";
    if (one.answered) score.by_answer[one.kind].Count(IsTruth(one, one.AnswerName()));
    CountReliability(one, score.reliability);
    switch (one.Truth()) {
      case TruthKind::kNone:
        score.false_alarms.Count(one.kind != "none");
        score.accused.Count(one.kind == "effect");
        break;
      case TruthKind::kOutside:
        score.unknown_recall.Count(unknown);
        if (one.Severity() >= kMediumSeverity) score.unknown_recall_medium_and_large.Count(unknown);
        score.outside_block.Count(IsRightBlock(one));
        break;
      case TruthKind::kPair:
        score.pairs_one_named.Count(NamedOfTwo(one) == 1);
        score.pairs_both_named.Count(NamedOfTwo(one) == 2);
        score.pairs_unknown.Count(unknown);
        continue;
      case TruthKind::kCatalogue: {
        for (Accuracy* accuracy :
             {&score.catalogue, &score.by_severity[one.Severity()],
              one.Severity() >= kMediumSeverity ? &score.medium_and_large : nullptr}) {
          if (accuracy == nullptr) continue;
          accuracy->named.Count(IsNamed(one));
          accuracy->in_class.Count(IsInClass(one));
          accuracy->block.Count(IsRightBlock(one));
        }
        score.false_unknowns.Count(unknown);
        const CandidateOutcome* oracle = Candidate(one, one.withheld[0].id);
        if (oracle != nullptr && oracle->shrinkage >= kOracleShrinkage && one.gap_before > 0.0) {
          ratios.push_back((1.0 - one.gap_after / one.gap_before) / oracle->shrinkage);
        }
        break;
      }
    }
    ++scored;
    score.log_score -= std::log(std::max(kLeastProbability, Probability(one, one.TruthName())));
    score.brier += Brier(one);
  }
  score.log_score /= std::max(1, scored);
  score.brier /= std::max(1, scored);
  for (ReliabilityBin& bin : score.reliability) {
    bin.mean_probability = bin.right.total > 0 ? bin.mean_probability / bin.right.total
                                               : std::numeric_limits<double>::quiet_NaN();
  }
  score.median_shrinkage_over_oracle = Median(ratios);
  score.oracle_cases = static_cast<int>(ratios.size());
  return score;
}

std::string Row(const CaseOutcome& one) {
  if (one.Truth() == TruthKind::kPair) return "(two effects)";
  return one.Truth() == TruthKind::kOutside ? one.withheld[0].id : one.TruthName();
}

Confusion Confuse(std::span<const CaseOutcome> cases) {
  Confusion out;
  const auto place = [](std::vector<std::string>& names, const std::string& name) {
    return static_cast<std::size_t>(std::ranges::lower_bound(names, name) - names.begin());
  };
  const auto insert = [&](std::vector<std::string>& names, const std::string& name) {
    const std::size_t at = place(names, name);
    if (at == names.size() || names[at] != name) {
      names.insert(names.begin() + static_cast<std::ptrdiff_t>(at), name);
    }
  };
  for (const CaseOutcome& one : cases) {
    insert(out.rows, Row(one));
    insert(out.columns, one.AnswerName());
  }
  out.count.assign(out.rows.size(), std::vector<int>(out.columns.size(), 0));
  for (const CaseOutcome& one : cases) {
    ++out.count[place(out.rows, Row(one))][place(out.columns, one.AnswerName())];
  }
  return out;
}

Floor MeasureFloor(std::span<const CaseOutcome> cases) {
  std::vector<double> gaps;
  std::vector<double> floors;
  for (const CaseOutcome& one : cases) {
    if (one.Truth() != TruthKind::kNone || !one.answered) continue;
    gaps.push_back(one.gap_before);
    floors.push_back(one.gap_floor);
  }
  Floor out;
  out.cases = static_cast<int>(gaps.size());
  out.median_gap = Median(gaps);
  out.median_floor = Median(floors);
  out.largest_gap =
      gaps.empty() ? std::numeric_limits<double>::quiet_NaN() : *std::ranges::max_element(gaps);
  return out;
}

template <typename F>
MethodScore ScoreRival(const std::string& name, std::span<const CaseOutcome> cases, F answer) {
  std::vector<CaseOutcome> answers;
  for (const CaseOutcome& one : cases) answers.push_back(answer(one));
  return ScoreMethod(name, answers);
}

}  // namespace

bool IsNamed(const CaseOutcome& one) {
  if (one.kind != "effect") return false;
  if (one.withheld.size() == 1) return one.withheld[0].id == one.effect;
  return NamedOfTwo(one) > 0;
}

bool IsInClass(const CaseOutcome& one) {
  if (IsNamed(one)) return true;
  if (one.kind != "effect" || one.indistinguishable.size() + 1 > kClassSize) return false;
  return std::ranges::any_of(one.withheld, [&](const WithheldEffect& each) {
    return std::ranges::find(one.indistinguishable, each.id) != one.indistinguishable.end();
  });
}

bool IsRightBlock(const CaseOutcome& one) {
  if (one.blocks.empty() || one.blocks[0].empty()) return false;
  return std::ranges::any_of(one.withheld, [&](const WithheldEffect& each) {
    return one.blocks[0].find(each.block) != std::string::npos;
  });
}

ScoreSheet Score(std::span<const CaseOutcome> cases, std::span<const RigEffect> effects) {
  ScoreSheet sheet;
  sheet.cases = static_cast<int>(cases.size());
  for (const CaseOutcome& one : cases) sheet.failed += one.answered ? 0 : 1;
  sheet.howl = ScoreMethod("howl diagnose", cases);
  sheet.rivals = {
      ScoreRival("always none", cases, AlwaysNone),
      ScoreRival("largest in-sample gain", cases,
                 [&](const CaseOutcome& one) { return LargestGain(one, effects); }),
      ScoreRival("BIC", cases, [&](const CaseOutcome& one) { return LeastBic(one, effects); })};
  sheet.confusion = Confuse(cases);
  sheet.floor = MeasureFloor(cases);
  sheet.power = ComputePower(cases, effects);
  for (const CaseOutcome& one : cases) {
    if (one.Truth() == TruthKind::kCatalogue) {
      Accuracy& accuracy = sheet.by_effect[one.withheld[0].id];
      accuracy.named.Count(IsNamed(one));
      accuracy.in_class.Count(IsInClass(one));
      accuracy.block.Count(IsRightBlock(one));
    } else if (one.Truth() == TruthKind::kOutside) {
      auto& [unknown, block] = sheet.outside[one.withheld[0].id];
      unknown.Count(one.kind == "unknown");
      block.Count(IsRightBlock(one));
    }
  }
  return sheet;
}

}  // namespace howl

#include "io/inspect/role_guess.h"

#include <glog/logging.h>

#include <algorithm>
#include <vector>

#include "estimation/analysis/spectra/statistics.h"
#include "io/records/columns/number_text.h"

namespace howl {
namespace {

struct Candidate {
  std::size_t column = 0;
  double mean_over_std = 0.0;  // the median over the files
};

std::string Ratio(const Candidate& candidate) {
  return "|mean| / std is " + NumberText(candidate.mean_over_std, 2);
}

class Guesser {
 public:
  explicit Guesser(std::span<const RecordLook* const> looks) : looks_(looks) {}

  RoleGuess Guess() {
    ByNames();
    Collect();
    if (!guess_.pressure && !guess_.heat_release) {
      BothByValues();
    } else if (!guess_.pressure) {
      PressureByValues();
    } else if (!guess_.heat_release) {
      HeatReleaseByValues();
    }
    return guess_;
  }

 private:
  const ColumnLook& Column(std::size_t i) const { return looks_.front()->columns[i]; }

  bool IsSignal(std::size_t i) const {
    return looks_.front()->time.column != i && std::ranges::any_of(looks_, [i](const auto* each) {
             return each->columns[i].IsSignal();
           });
  }

  void ByNames() {
    for (std::size_t i = 0; i < looks_.front()->columns.size(); ++i) {
      if (!IsSignal(i)) continue;
      const ColumnWords& words = Column(i).words;
      const std::string reason = "by its name, \"" + words.word + "\"";
      if (words.meaning == ColumnMeaning::kPressure && !guess_.pressure) {
        guess_.pressure = i;
        guess_.pressure_reason = reason;
      } else if (words.meaning == ColumnMeaning::kHeatRelease && !guess_.heat_release) {
        guess_.heat_release = i;
        guess_.heat_release_reason = reason;
      }
    }
  }

  // The columns whose names say nothing. A count of samples, which grows all the time, is no
  // signal.
  void Collect() {
    for (std::size_t i = 0; i < looks_.front()->columns.size(); ++i) {
      if (!IsSignal(i) || Column(i).words.meaning != ColumnMeaning::kNone) continue;
      if (std::ranges::is_sorted(Column(i).values)) continue;
      std::vector<double> ratios;
      for (const RecordLook* each : looks_) ratios.push_back(each->columns[i].MeanOverStd());
      candidates_.push_back({i, Median(std::move(ratios))});
    }
  }

  void BothByValues() {
    if (candidates_.empty()) return;
    if (candidates_.size() == 1) {
      guess_.pressure = candidates_.front().column;
      guess_.pressure_reason = "the only signal";
      return;
    }
    const auto less = [](const Candidate& a, const Candidate& b) {
      return a.mean_over_std < b.mean_over_std;
    };
    const Candidate q = *std::ranges::max_element(candidates_, less);
    const Candidate p = *std::ranges::min_element(candidates_, less);
    if (q.mean_over_std > kKeepsMean && p.mean_over_std < kHasNoMean) {
      TakePressure(p, "it has no mean: " + Ratio(p));
      TakeHeatRelease(q, "it keeps a mean, as light does: " + Ratio(q));
      return;
    }
    guess_.is_sure = false;
    if (q.mean_over_std > kKeepsMean) {
      TakePressure(p, "NOT SURE: of the columns it has the smallest mean: " + Ratio(p));
      TakeHeatRelease(q, "NOT SURE: of the columns it has the largest mean: " + Ratio(q));
      return;
    }
    const std::string reason =
        "NOT SURE: neither name nor mean tells p from q, so the order of the columns does (howl "
        "analyse says when p and q look swapped)";
    TakePressure(candidates_[0], reason);
    TakeHeatRelease(candidates_[1], reason);
  }

  void PressureByValues() {
    if (candidates_.empty()) return;
    const Candidate p = *std::ranges::min_element(
        candidates_, {}, [](const Candidate& each) { return each.mean_over_std; });
    guess_.is_sure = candidates_.size() == 1;
    TakePressure(p, candidates_.size() == 1
                        ? "the only signal other than heat release"
                        : "NOT SURE: of the columns left it has the smallest mean: " + Ratio(p));
  }

  void HeatReleaseByValues() {
    if (candidates_.empty()) return;
    const Candidate q = *std::ranges::max_element(
        candidates_, {}, [](const Candidate& each) { return each.mean_over_std; });
    guess_.is_sure = candidates_.size() == 1;
    TakeHeatRelease(q, candidates_.size() == 1
                           ? "the only signal other than pressure"
                           : "NOT SURE: of the columns left it has the largest mean: " + Ratio(q));
  }

  void TakePressure(const Candidate& candidate, std::string reason) {
    guess_.pressure = candidate.column;
    guess_.pressure_reason = std::move(reason);
  }
  void TakeHeatRelease(const Candidate& candidate, std::string reason) {
    guess_.heat_release = candidate.column;
    guess_.heat_release_reason = std::move(reason);
  }

  std::span<const RecordLook* const> looks_;
  std::vector<Candidate> candidates_;
  RoleGuess guess_;
};

}  // namespace

RoleGuess GuessRoles(std::span<const RecordLook* const> looks) {
  CHECK(!looks.empty());
  return Guesser(looks).Guess();
}

}  // namespace howl

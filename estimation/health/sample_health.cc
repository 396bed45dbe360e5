#include "estimation/health/sample_health.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <vector>

#include "estimation/health/number_words.h"

namespace howl {
namespace {

// Of a clipped signal the end value stands in at least this share of the samples. On the public
// measured records (24 channels of a combustor and a Rijke tube) the largest value is there at most
// 6 times in 30 000 samples, 2e-4.
constexpr double kClippedShare = 1e-3;
// ... and this many times as often as the values next to it, on the mean. A sine's density grows
// towards its ends as 1 / sqrt: its last step of a converter is 2.4 times as full as the next one.
constexpr double kClippedOverNext = 10.0;
constexpr std::size_t kNextValues = 8;
// Runs by chance are longer than m times what is expected in one record of n^(m - 1). On the
// measured records none is longer than 1.95 times that: neighbouring samples are not independent.
constexpr double kStuckBeyondExpected = 3.0;
constexpr double kHeldShare = 0.45;        // of samples equal to the one before: each stands twice
constexpr std::size_t kHeldLevels = 100;   // fewer values repeat by themselves
constexpr std::size_t kCoarseLevels = 32;  // five bits
constexpr std::size_t kSameStart = 64;     // samples that do not come again by chance

class SampleCheck {
 public:
  SampleCheck(std::string experiment, std::string channel, std::span<const double> samples,
              double sampling_hz)
      : experiment_(std::move(experiment)),
        channel_(std::move(channel)),
        samples_(samples),
        sampling_hz_(sampling_hz),
        sorted_(samples.begin(), samples.end()) {
    std::ranges::sort(sorted_);
    for (std::size_t i = 1; i < sorted_.size(); ++i) levels_ += sorted_[i] != sorted_[i - 1];
  }

  void Find() {
    const bool is_coarse = CheckLevels();
    if (!is_coarse) {
      CheckEnd("largest", sorted_.rbegin(), sorted_.rend());
      CheckEnd("smallest", sorted_.begin(), sorted_.end());
      CheckRepeats();
    }
    CheckAppended();
  }

  const Health& health() const { return health_; }
  const std::vector<Gap>& stuck() const { return stuck_; }
  RangeEnds ends() const {
    RangeEnds out;
    for (const double end : clipped_) (end == sorted_.front() ? out.lower : out.upper) = end;
    return out;
  }

 private:
  void Add(const char* subject, double value, double limit, const std::string& text) {
    health_.push_back({FindingKind::kSamples, experiment_, channel_ + "_" + subject, value, limit,
                       experiment_ + ": " + channel_ + " " + text});
  }

  bool CheckLevels() {
    if (levels_ >= kCoarseLevels) return false;
    Add("coarse", static_cast<double>(levels_), kCoarseLevels,
        "has only " + std::to_string(levels_) +
            " different values: a few steps of the converter, or rounded when it was written");
    return true;
  }

  template <typename Iterator>
  void CheckEnd(const char* which, Iterator begin, Iterator end) {
    const double end_value = *begin;
    Iterator at = std::find_if(begin, end, [&](double value) { return value != end_value; });
    const auto count = static_cast<double>(std::distance(begin, at));
    if (count < kClippedShare * static_cast<double>(samples_.size())) return;
    double others = 0.0;
    std::size_t values = 0;
    while (at != end && values < kNextValues) {
      const double value = *at;
      const Iterator next = std::find_if(at, end, [&](double other) { return other != value; });
      others += static_cast<double>(std::distance(at, next));
      ++values;
      at = next;
    }
    const double mean = others / static_cast<double>(std::max<std::size_t>(values, 1));
    if (count <= kClippedOverNext * mean) return;
    clipped_.push_back(end_value);
    const double share = count / static_cast<double>(samples_.size());
    Add("clipped", share, kClippedShare,
        std::string("looks clipped: its ") + which + " value, " + NumberWord(end_value, 5) +
            ", stands in " + NumberWord(100.0 * share) + " % of the samples, " +
            NumberWord(count / std::max(mean, 1.0), 2) + " times as often as those beside it");
  }

  void CheckRepeats() {
    const std::size_t n = samples_.size();
    std::size_t equal = 0;
    std::size_t repeated = 0;  // runs of two and more
    std::size_t longer = 0;    // of three and more
    std::size_t run = 1;
    std::size_t longest = 1;
    std::size_t longest_end = 0;
    for (std::size_t i = 1; i < n; ++i) {
      if (samples_[i] != samples_[i - 1]) {
        run = 1;
        continue;
      }
      ++equal;
      ++run;
      if (run == 2) ++repeated;
      if (run == 3) ++longer;
      // A clipped signal stands still at its end, which is reported as clipping.
      if (run > longest && std::ranges::find(clipped_, samples_[i]) == clipped_.end()) {
        longest = run;
        longest_end = i;
      }
    }
    const double share = static_cast<double>(equal) / static_cast<double>(n - 1);
    const std::size_t runs = n - equal;
    const double goes_on = static_cast<double>(repeated) / static_cast<double>(runs);
    if (std::min(share, goes_on) >= kHeldShare && levels_ >= kHeldLevels && longest < n / 10) {
      const double times = 1.0 / (1.0 - share);
      Add("held", share, kHeldShare,
          "stands still over " + NumberWord(times, 2) + " samples on the mean: sampled at about " +
              NumberWord(sampling_hz_ / times, 3) + " Hz and stored at " +
              NumberWord(sampling_hz_, 5) + " Hz");
      return;
    }
    // By chance, as runs of one and of two have it: those that are stuck are longer.
    const double by_chance = (static_cast<double>(repeated - longer) + 1.0) /
                             (static_cast<double>(runs - repeated) + 1.0);
    const double expected = std::log(static_cast<double>(n)) / -std::log(std::min(by_chance, 0.99));
    const double limit = kStuckBeyondExpected * expected;
    if (static_cast<double>(longest) <= limit) return;
    KeepStuck(limit);
    const double end_s = static_cast<double>(longest_end + 1) / sampling_hz_;
    const double start_s = end_s - static_cast<double>(longest) / sampling_hz_;
    Add("stuck", static_cast<double>(longest), limit,
        "stands still at " + NumberWord(samples_[longest_end], 5) + " for " +
            std::to_string(longest) + " samples, from " + NumberWord(start_s, 4) + " to " +
            NumberWord(end_s, 4) + " s");
  }

  void KeepStuck(double longest_by_chance) {
    std::size_t first = 0;
    for (std::size_t i = 1; i <= samples_.size(); ++i) {
      if (i < samples_.size() && samples_[i] == samples_[first]) continue;
      const std::size_t length = i - first;
      if (static_cast<double>(length) > longest_by_chance &&
          std::ranges::find(clipped_, samples_[first]) == clipped_.end()) {
        stuck_.push_back({first + 1, length - 1});
      }
      first = i;
    }
  }

  void CheckAppended() {
    const std::size_t n = samples_.size();
    if (n < 2 * kSameStart || levels_ < kCoarseLevels) return;
    const auto start = samples_.first(kSameStart);
    for (std::size_t i = kSameStart; i + kSameStart <= n; ++i) {
      if (samples_[i] != start[0] || !std::ranges::equal(samples_.subspan(i, kSameStart), start)) {
        continue;
      }
      // A simulation may be periodic, sample for sample, and then repeats at once.
      Add("appended", static_cast<double>(i), static_cast<double>(n),
          "begins again at sample " + std::to_string(i + 1) + " (" +
              NumberWord(static_cast<double>(i) / sampling_hz_, 4) +
              " s), the same numbers: a record behind itself?");
      return;
    }
  }

  std::string experiment_;
  std::string channel_;
  std::span<const double> samples_;
  double sampling_hz_;
  std::vector<double> sorted_;
  std::size_t levels_ = 1;
  std::vector<double> clipped_;
  std::vector<Gap> stuck_;
  Health health_;
};

}  // namespace

Health CheckSamples(const std::string& experiment, const std::string& channel,
                    std::span<const double> samples, double sampling_hz) {
  if (samples.size() < 2) return {};
  SampleCheck check(experiment, channel, samples, sampling_hz);
  check.Find();
  return check.health();
}

std::vector<Gap> StuckSamples(std::span<const double> samples) {
  if (samples.size() < 2) return {};
  SampleCheck check("", "", samples, 1.0);
  check.Find();
  return check.stuck();
}

RangeEnds RepeatedEnds(std::span<const double> samples) {
  if (samples.size() < 2) return {};
  SampleCheck check("", "", samples, 1.0);
  check.Find();
  return check.ends();
}

}  // namespace howl

#include "io/config/schema/nearest_key.h"

#include <algorithm>
#include <cctype>
#include <utility>

namespace howl {
namespace {

std::string LowerCase(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

std::size_t EditDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substitution = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, substitution});
      const bool exchanged = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (exchanged) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before = last;
    last = row;
  }
  return last[b.size()];
}

std::string Stem(const std::string& key) {
  const std::size_t suffix = key.rfind('_');
  return suffix == std::string::npos ? key : key.substr(0, suffix);
}

// A shared stem is one slip, however long the suffix is. Of candidates with equally many slips, the
// one with the fewest edited letters is nearest.
std::pair<std::size_t, std::size_t> Distance(const std::string& word,
                                             const std::string& candidate) {
  const std::size_t edits = EditDistance(word, candidate);
  const bool same_stem =
      word.size() >= 3 && (Stem(word) == Stem(candidate) || candidate.starts_with(word));
  return {same_stem ? std::min<std::size_t>(edits, 1) : edits, edits};
}

}  // namespace

std::optional<std::string> NearestKey(const std::string& word,
                                      const std::vector<std::string>& candidates,
                                      std::size_t slips_of_two) {
  constexpr std::size_t kLongestWord = 64;
  if (word.size() > kLongestWord) return std::nullopt;
  const std::string lower = LowerCase(word);
  const std::size_t limit = lower.size() < 2    ? 0
                            : lower.size() == 2 ? slips_of_two
                                                : std::max<std::size_t>(1, lower.size() / 3);
  std::pair<std::size_t, std::size_t> smallest{limit + 1, 0};
  std::optional<std::string> nearest;
  for (const std::string& candidate : candidates) {
    const auto distance = Distance(lower, LowerCase(candidate));
    if (distance < smallest) {
      smallest = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

}  // namespace howl

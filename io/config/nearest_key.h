// What a mistyped word was probably meant to be.
#ifndef HOWL_IO_CONFIG_NEAREST_KEY_H_
#define HOWL_IO_CONFIG_NEAREST_KEY_H_

#include <optional>
#include <string>
#include <vector>

namespace howl {

// The candidate nearest to `word`: by edit distance (Levenshtein, neighbouring letters exchanged
// counting once, case ignored), where a different unit suffix (frequency_khz, frequency_hz) or a
// missing one counts little. Empty when nothing is near.
std::optional<std::string> NearestKey(const std::string& word,
                                      const std::vector<std::string>& candidates);

}  // namespace howl

#endif  // HOWL_IO_CONFIG_NEAREST_KEY_H_

// The word that a mistyped one was probably meant to be.
#ifndef HOWL_IO_CONFIG_SCHEMA_NEAREST_KEY_H_
#define HOWL_IO_CONFIG_SCHEMA_NEAREST_KEY_H_

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace howl {

// The candidate nearest to `word`: by edit distance (Levenshtein, neighbouring letters exchanged
// counting once, case ignored), where a different unit suffix (frequency_khz, frequency_hz) or a
// missing one counts little. Empty when nothing is near. A word of two letters may have
// `slips_of_two` slips; one in a word of three to five, then one for every three letters.
std::optional<std::string> NearestKey(const std::string& word,
                                      const std::vector<std::string>& candidates,
                                      std::size_t slips_of_two = 0);

}  // namespace howl

#endif  // HOWL_IO_CONFIG_SCHEMA_NEAREST_KEY_H_

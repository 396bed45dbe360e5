#include "io/inspect/column_words.h"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <vector>

namespace howl {
namespace {

struct Word {
  std::string_view text;
  ColumnMeaning meaning;
};

constexpr Word kWords[] = {{"time", ColumnMeaning::kTime},
                           {"t", ColumnMeaning::kTime},
                           {"timestamp", ColumnMeaning::kTime},
                           {"zeit", ColumnMeaning::kTime},
                           {"temps", ColumnMeaning::kTime},
                           {"tiempo", ColumnMeaning::kTime},
                           {"p", ColumnMeaning::kPressure},
                           {"p'", ColumnMeaning::kPressure},
                           {"pressure", ColumnMeaning::kPressure},
                           {"pres", ColumnMeaning::kPressure},
                           {"press", ColumnMeaning::kPressure},
                           {"druck", ColumnMeaning::kPressure},
                           {"pression", ColumnMeaning::kPressure},
                           {"mic", ColumnMeaning::kPressure},
                           {"microphone", ColumnMeaning::kPressure},
                           {"pcb", ColumnMeaning::kPressure},
                           {"kulite", ColumnMeaning::kPressure},
                           {"q", ColumnMeaning::kHeatRelease},
                           {"q'", ColumnMeaning::kHeatRelease},
                           {"hr", ColumnMeaning::kHeatRelease},
                           {"hrr", ColumnMeaning::kHeatRelease},
                           {"heat", ColumnMeaning::kHeatRelease},
                           {"heatrelease", ColumnMeaning::kHeatRelease},
                           {"oh", ColumnMeaning::kHeatRelease},
                           {"oh*", ColumnMeaning::kHeatRelease},
                           {"ch", ColumnMeaning::kHeatRelease},
                           {"ch*", ColumnMeaning::kHeatRelease},
                           {"pmt", ColumnMeaning::kHeatRelease},
                           {"photomultiplier", ColumnMeaning::kHeatRelease},
                           {"photodiode", ColumnMeaning::kHeatRelease},
                           {"chemiluminescence", ColumnMeaning::kHeatRelease},
                           {"chemi", ColumnMeaning::kHeatRelease},
                           {"luminosity", ColumnMeaning::kHeatRelease},
                           {"intensity", ColumnMeaning::kHeatRelease},
                           {"flame", ColumnMeaning::kHeatRelease},
                           {"light", ColumnMeaning::kHeatRelease},
                           {"temperature", ColumnMeaning::kOther},
                           {"temp", ColumnMeaning::kOther},
                           {"flow", ColumnMeaning::kOther},
                           {"valve", ColumnMeaning::kOther},
                           {"trigger", ColumnMeaning::kOther},
                           {"fs", ColumnMeaning::kSamplingRate},
                           {"rate", ColumnMeaning::kSamplingRate},
                           {"samplerate", ColumnMeaning::kSamplingRate},
                           {"sampling", ColumnMeaning::kSamplingRate}};
constexpr Word kUnits[] = {{"pa", ColumnMeaning::kPressure},    {"kpa", ColumnMeaning::kPressure},
                           {"hpa", ColumnMeaning::kPressure},   {"bar", ColumnMeaning::kPressure},
                           {"mbar", ColumnMeaning::kPressure},  {"psi", ColumnMeaning::kPressure},
                           {"w", ColumnMeaning::kHeatRelease},  {"kw", ColumnMeaning::kHeatRelease},
                           {"mw", ColumnMeaning::kHeatRelease}, {"s", ColumnMeaning::kTime},
                           {"ms", ColumnMeaning::kTime},        {"us", ColumnMeaning::kTime},
                           {"k", ColumnMeaning::kOther},        {"degc", ColumnMeaning::kOther}};

bool IsDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

// Letters and digits, with the star of a radical and the stroke of a fluctuation: "OH*", "p'".
std::vector<std::string> WordsOf(std::string_view name) {
  std::vector<std::string> words;
  bool inside = false;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    const bool part = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '*' || c == '\'';
    // "heatRelease", "PressureInlet": a new word at each capital behind a small letter.
    const bool hump = part && inside && std::isupper(static_cast<unsigned char>(c)) != 0 &&
                      std::islower(static_cast<unsigned char>(name[i - 1])) != 0;
    if (part && (!inside || hump)) words.emplace_back();
    if (part) words.back() += c;
    inside = part;
  }
  return words;
}

std::string Lower(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

// Channels are numbered, radicals are not: "CH1" and "ch 2" say nothing.
bool IsNumberedChannel(const std::vector<std::string>& words, std::size_t i) {
  const std::string word = Lower(words[i]);
  if (!word.starts_with("ch")) return false;
  if (word.size() > 2) return IsDigit(word[2]);
  return i + 1 < words.size() && IsDigit(words[i + 1].front());
}

ColumnMeaning Find(std::string_view text, std::string_view without_number, const Word* first,
                   const Word* last) {
  const Word* found = std::find_if(
      first, last, [&](const Word& w) { return w.text == text || w.text == without_number; });
  return found == last ? ColumnMeaning::kNone : found->meaning;
}

}  // namespace

ColumnWords MeaningOf(const std::string& name) {
  const std::size_t open = name.find_first_of("[({");
  const std::vector<std::string> words = WordsOf(std::string_view(name).substr(0, open));
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (IsNumberedChannel(words, i)) continue;
    const std::string word = Lower(words[i]);
    const std::string bare = word.substr(0, word.find_last_not_of("0123456789") + 1);
    // A short word behind the first one is a unit: time_s, q_kw.
    if (i > 0 && bare.size() < 2) continue;
    const ColumnMeaning meaning = Find(word, bare, std::begin(kWords), std::end(kWords));
    if (meaning != ColumnMeaning::kNone) return {meaning, words[i]};
  }
  const std::vector<std::string> units =
      open == std::string::npos ? words : WordsOf(std::string_view(name).substr(open));
  if (units.empty() || (open == std::string::npos && words.size() < 2)) return {};
  const std::string unit = Lower(units.back());
  return {Find(unit, unit, std::begin(kUnits), std::end(kUnits)), units.back()};
}

}  // namespace howl

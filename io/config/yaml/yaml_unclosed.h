// Brackets and quotes that nothing closes. The YAML parser notices a missing bracket far below the
// line to mend, or takes what it opens for a key, and it takes a missing quote for the file's end.
#ifndef HOWL_IO_CONFIG_YAML_YAML_UNCLOSED_H_
#define HOWL_IO_CONFIG_YAML_YAML_UNCLOSED_H_

#include <optional>
#include <string>

namespace howl {

struct Unclosed {
  int line = 0;  // of the opening character, from 1
  char opening = '\0';
};

// The first { or [ without its end in text that does not parse.
std::optional<Unclosed> FindUnclosedBracket(const std::string& text);

// Whether the quoted scalar that starts at `line` and `column` (both from 0) has no second quote.
// False for what does not start with a quote.
bool IsUnclosedQuote(const std::string& text, int line, int column);

}  // namespace howl

#endif  // HOWL_IO_CONFIG_YAML_YAML_UNCLOSED_H_

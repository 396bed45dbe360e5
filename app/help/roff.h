// Text for manual pages, in the macros of man(7).
#ifndef HOWL_APP_HELP_ROFF_H_
#define HOWL_APP_HELP_ROFF_H_

#include <string>
#include <string_view>

namespace howl {

// The text as roff prints it unchanged: what roff would take for commands is escaped, letters
// beyond ASCII are named by their number, and what stands between `grave accents` is bold. A minus
// at the start of a word or before a digit stays one that can be copied to a shell.
std::string Roff(std::string_view utf8);

// A word in bold, or in italics.
std::string RoffBold(std::string_view word);
std::string RoffItalic(std::string_view word);

}  // namespace howl

#endif  // HOWL_APP_HELP_ROFF_H_

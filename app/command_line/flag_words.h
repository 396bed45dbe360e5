// Names and values of flags as they are typed, and as gflags has them.
#ifndef HOWL_APP_COMMAND_LINE_FLAG_WORDS_H_
#define HOWL_APP_COMMAND_LINE_FLAG_WORDS_H_

#include <string>
#include <vector>

#include "app/command_line/options.h"

namespace howl {

// "--save-every" is save_every to gflags.
std::string CanonicalFlag(const std::string& flag);

// "save-every" and "-save-every" are --save-every to a reader.
std::string DashedFlag(const std::string& name);

// The option with this name, however it is typed; null where there is none.
const OptionHelp* FindOption(const std::vector<OptionHelp>& options, const std::string& flag);

// Empty parts are left out.
std::vector<std::string> SplitAtCommas(const std::string& text);

// The value, after those that the option has already, if it may be given several times.
std::string JoinedValues(const OptionHelp& flag, const std::string& value);

// What a value may be, for a message.
std::string ExpectedValue(const OptionHelp& flag);

}  // namespace howl

#endif  // HOWL_APP_COMMAND_LINE_FLAG_WORDS_H_

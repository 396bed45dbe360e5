// A name that an option is given, of those that are known.
#ifndef HOWL_APP_COMMAND_LINE_KNOWN_NAME_H_
#define HOWL_APP_COMMAND_LINE_KNOWN_NAME_H_

#include <string>
#include <vector>

namespace howl {

// Throws UsageError where the name is not known: it is `none_of_them`, and may be meant for
// another.
void RequireKnown(const std::string& option, const std::string& name,
                  const std::vector<std::string>& known, const std::string& none_of_them);

}  // namespace howl

#endif  // HOWL_APP_COMMAND_LINE_KNOWN_NAME_H_

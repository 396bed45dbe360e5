#include "app/command_line/known_name.h"

#include <algorithm>
#include <optional>

#include "app/command_line/command.h"
#include "io/config/schema/nearest_key.h"

namespace howl {

void RequireKnown(const std::string& option, const std::string& name,
                  const std::vector<std::string>& known, const std::string& none_of_them) {
  if (std::ranges::find(known, name) != known.end()) return;
  const std::optional<std::string> nearest = NearestKey(name, known);
  throw UsageError(option + ": " + name + " is " + none_of_them +
                   (nearest ? ", did you mean " + *nearest + "?" : ""));
}

}  // namespace howl

// What `howl help` explains besides commands: "residuals", what a joint fit can ask for, and
// "schema", the config's JSON schema, for editors that check and complete a config with it.
#ifndef HOWL_APP_HELP_HELP_TOPICS_H_
#define HOWL_APP_HELP_HELP_TOPICS_H_

#include <optional>
#include <string>

namespace howl {

// The text of that topic; no value where there is none of this name.
std::optional<std::string> HelpTopic(const std::string& name);

}  // namespace howl

#endif  // HOWL_APP_HELP_HELP_TOPICS_H_

// What `howl help` explains besides commands: "residuals", what a joint fit can ask for; "effects",
// what a diagnosis can name, with block, form, null and bounds; "schema", the config's JSON schema,
// for editors that check and complete a config with it; "commands", their names; "man [COMMAND]", a
// manual page; "completion SHELL", what lets a shell complete words.
#ifndef HOWL_APP_HELP_HELP_TOPICS_H_
#define HOWL_APP_HELP_HELP_TOPICS_H_

#include <string>
#include <vector>

namespace howl {

// The names of the topics, in that order.
const std::vector<std::string>& HelpTopics();

// The text of the topic of this name, one of HelpTopics(). Throws UsageError where `words`, which
// follow the name, name no command or shell.
std::string HelpTopic(const std::string& name, const std::vector<std::string>& words);

}  // namespace howl

#endif  // HOWL_APP_HELP_HELP_TOPICS_H_

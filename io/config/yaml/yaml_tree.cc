#include "io/config/yaml/yaml_tree.h"

#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <optional>
#include <sstream>

#include "io/config/yaml/config_text.h"
#include "io/config/yaml/tree_builder.h"
#include "io/config/yaml/yaml_unclosed.h"
#include "io/user_error.h"

namespace howl {
namespace {

// The expectation that goes into the message where the parser stopped with `message`.
std::string ParseExpectation(const std::string& message) {
  const auto says = [&](const char* part) { return message.find(part) != std::string::npos; };
  if (says("flow")) return "a comma or a closing bracket behind a value";
  if (says("illegal map value")) {
    return "one `key: value` on a line, and quotes around text that has a colon";
  }
  if (says("end of map") || says("end of sequence")) {
    return "the keys of one mapping, or the dashes of one list, in the same column";
  }
  if (says("alias") || says("block scalar")) return "quotes around text that starts with * | or >";
  if (says("unknown token")) return "quotes around text that starts with % @ or a backtick";
  if (says("block entry")) return "a list's dashes on lines of their own, below its key";
  if (says("anchor")) return "an anchor (&name) above its alias (*name)";
  if (says("EOF in scalar")) return "a closing quote";
  if (says("escape")) return "single quotes around text that has a backslash";
  return "`key: value` lines, indented with spaces";
}

// Any further document is one too many.
class NoMoreDocuments : public YAML::EventHandler {
 public:
  explicit NoMoreDocuments(const std::string& file) : file_(file) {}
  void OnDocumentStart(const YAML::Mark& mark) override {
    throw UserError(file_, mark.line + 1, "---",
                    "a second YAML document starts here, expected one config in a file");
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t,
                const std::string&) override {}
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {}
  void OnMapEnd() override {}

 private:
  const std::string& file_;
};

void FailAtUnclosedBracket(const std::string& file, const std::string& text) {
  const std::optional<Unclosed> unclosed = FindUnclosedBracket(text);
  if (!unclosed) return;
  const bool is_brace = unclosed->opening == '{';
  throw UserError(file, unclosed->line, KeyNearLine(text, unclosed->line),
                  std::string("this is not YAML (") + (is_brace ? "{" : "[") +
                      " is not closed), expected a comma or a closing " + (is_brace ? "}" : "]") +
                      " behind a value");
}

}  // namespace

LocatedNode ParseYaml(const std::string& file, const std::string& text) {
  std::istringstream stream(text);
  TreeBuilder builder(file);
  try {
    YAML::Parser parser(stream);
    parser.HandleNextDocument(builder);
    NoMoreDocuments no_more(file);
    parser.HandleNextDocument(no_more);
  } catch (const UserError&) {
    FailAtUnclosedBracket(file, text);
    throw;
  } catch (const YAML::Exception& error) {
    FailAtUnclosedBracket(file, text);
    // A missing end is noticed behind the last line; the last line is where to look.
    const int last_line = 1 + static_cast<int>(std::count(text.begin(), text.end(), '\n')) -
                          (text.ends_with('\n') ? 1 : 0);
    const int line = std::clamp(error.mark.line + 1, 1, std::max(last_line, 1));
    throw UserError(
        file, line, KeyNearLine(text, line),
        "this is not YAML (" + error.msg + "), expected " + ParseExpectation(error.msg));
  }
  const YAML::Mark quoted = builder.LastQuoted();
  if (!quoted.is_null() && IsUnclosedQuote(text, quoted.line, quoted.column)) {
    throw UserError(file, quoted.line + 1, KeyNearLine(text, quoted.line + 1),
                    "this is not YAML (a quote is not closed), expected a closing quote");
  }
  return builder.TakeRoot();
}

}  // namespace howl

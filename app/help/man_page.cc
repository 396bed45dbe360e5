#include "app/help/man_page.h"

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <string_view>

#include "app/command_line/command_line.h"
#include "app/help/help_text.h"
#include "app/help/roff.h"
#include "model/version.h"

namespace howl {
namespace {

std::string Date() {
  const char* const epoch = std::getenv("SOURCE_DATE_EPOCH");
  const std::time_t time = epoch == nullptr ? std::time(nullptr) : std::atoll(epoch);
  std::tm date{};
  gmtime_r(&time, &date);
  char text[16];
  return {text, std::strftime(text, sizeof text, "%Y-%m-%d", &date)};
}

std::string Header(const std::string& title) {
  return ".TH " + title + " 1 " + Date() + " \"howl " + std::string(Version()) +
         "\" \"User Commands\"\n";
}

std::string Section(const std::string& name, const std::string& text) {
  return ".SH " + name + "\n" + text;
}

std::string Entry(const std::string& left, const std::string& text) {
  return ".TP\n" + left + "\n" + text + "\n";
}

std::string OptionEntries(const std::vector<OptionHelp>& options) {
  std::string text;
  for (const OptionHelp& option : options) {
    const std::string value = option.value.empty() ? "" : " " + RoffItalic(option.value);
    text += Entry(RoffBold(option.name) + value, Roff(option.text));
  }
  return text;
}

std::string ExitStatuses() {
  std::string text;
  for (const ExitStatus& each : kExitStatuses) {
    text += Entry(RoffBold(std::to_string(each.status)), Roff(each.text));
  }
  return Section("EXIT STATUS", text);
}

std::string Page(const std::string& name) { return ".BR " + name + " (1)"; }

// The pages of all commands but one.
std::string OtherPages(const std::string& but) {
  std::string text = Page("howl");
  for (const Command& command : Commands()) {
    if (command.name != but) text += ",\n" + Page("howl\\-" + command.name);
  }
  return text + ",\n" + Page("howl_rig") + "\n";
}

constexpr std::string_view kDescription =
    "howl identifies self-excited feedback loops from records that nobody excited: first of all\n"
    "lean combustors that oscillate by themselves. From pressure p(t) and heat release q(t),\n"
    "recorded in closed loop in a limit cycle at a few operating points, or from a published "
    "table\n"
    "of such records, it finds the models that fit, bounds every model that the data cannot\n"
    "reject, and says where, why and by how much the model falls short of the rig.\n";

// Each line of commands is one line of the page.
constexpr std::string_view kExamples =
    "A config for records of three operating points, and what it allows:\n"
    ".PP\n.RS 4\n.nf\n"
    "howl init a.csv b.csv c.csv \\-\\-values 0.51,0.53,0.56 \\-\\-out rig.yaml\n"
    "howl check rig.yaml\n"
    ".fi\n.RE\n.PP\n"
    "From records to a page of figures, out/rig/report.html:\n"
    ".PP\n.RS 4\n.nf\n"
    "howl analyse rig.yaml\n"
    "howl fit rig.yaml\n"
    "howl family rig.yaml\n"
    "howl report rig.yaml\n"
    ".fi\n.RE\n";

std::string Environment() {
  return Section("ENVIRONMENT", Entry(RoffBold("FLAGS_") + RoffItalic("NAME"),
                                      "The value of the option " + RoffBold("--") +
                                          RoffItalic("NAME") + ", where " + RoffBold("--fromenv") +
                                          " or " + RoffBold("--tryfromenv") + " names it."));
}

std::string Files() {
  return Section("FILES", Entry(RoffItalic("out/NAME/"),
                                "The output files of a config " + RoffItalic("NAME.yaml") +
                                    ", where no " + RoffBold("--out") +
                                    " names another folder. They appear whole or not at all."));
}

}  // namespace

std::string ProgramManPage() {
  std::string text = Header("HOWL");
  text += Section("NAME", "howl \\- " + Roff(kPurpose) + "\n");
  text += Section("SYNOPSIS", RoffBold("howl") + " " + RoffItalic("COMMAND") + " " +
                                  RoffItalic("CONFIG") + " [" + RoffItalic("options") + "]\n.br\n" +
                                  RoffBold("howl help") + " [" + RoffItalic("COMMAND") + "]\n");
  text += Section("DESCRIPTION", Roff(kDescription));
  std::string commands;
  for (const Command& command : Commands()) {
    commands += Entry(Page("howl\\-" + command.name), Roff(command.summary));
  }
  text += Section("COMMANDS", commands);
  text += Section("OPTIONS", "Every command has these:\n" + OptionEntries(CommonOptions()));
  text += ExitStatuses() + Environment() + Files();
  text += Section("EXAMPLES", std::string(kExamples));
  return text + Section("SEE ALSO", OtherPages("").substr(Page("howl").size() + 2));
}

std::string CommandManPage(const Command& command) {
  std::string title = "HOWL\\-" + command.name;
  std::ranges::transform(title, title.begin(), [](char c) { return c >= 'a' ? c - 'a' + 'A' : c; });
  std::string text = Header(title);
  text += Section("NAME", "howl\\-" + command.name + " \\- " + Roff(command.summary) + "\n");
  text +=
      Section("SYNOPSIS", RoffBold("howl " + command.name) + " " + RoffItalic(command.operands) +
                              " [" + RoffItalic("options") + "]\n");
  text += Section("DESCRIPTION", Roff(command.details) + "\n");
  if (!command.options.empty()) text += Section("OPTIONS", OptionEntries(command.options));
  text += Section("OPTIONS OF EVERY COMMAND", OptionEntries(CommonOptions()));
  return text + ExitStatuses() + Files() + Section("SEE ALSO", OtherPages(command.name));
}

}  // namespace howl

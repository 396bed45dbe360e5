#include "rig/help.h"

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <string_view>

namespace rig {
namespace {

constexpr std::string_view kPurpose = "simulate a rig for blind trials";

constexpr std::string_view kDescription =
    "Travelling waves in a duct with a flame, matched to the characteristics in\n"
    "RIG.yaml, with the effects that it names. Writes DIR/data/NAME.csv (p,q) for\n"
    "each experiment and DIR/config.yaml, which howl diagnose takes as it is and\n"
    "which says nothing of the effects. They are in the key.\n";

struct Option {
  std::string_view name;
  std::string_view value;
  std::string_view text;
};

constexpr Option kOptions[] = {
    {"--out", "DIR", "where to write"},
    {"--key", "FILE", "where the key goes (default: standard output)"},
    {"--list", "", "the effects with their blocks and sizes, as CSV"},
    {"--man", "", "this text as a manual page"},
    {"--help", "", "this text"},
};

constexpr std::string_view kSpec =
    "  experiments:\n"
    "    - {name: exp1, phi: 0.56, frequency_hz: 219.9, phase_deg: -5.74, gain: 12.14}\n"
    "  effects: [{id: q_sensor_lowpass, severity: medium}]   # small, medium, large or 0 to 1\n"
    "  seed: 1\n"
    "  duration_s: 3.2\n"
    "  sampling_hz: 5000\n"
    "  settle_s: 1\n"
    "  scatter: true          # draw rigs like this one; false: as near to it as can be\n"
    "  flame: any             # or tanh, arctan, erf, rational, asymmetric\n"
    "  noise: {combustion_relative: 0.055, sensor_relative: 0.004}\n";

// In roff a hyphen may become a dash: these stay what a shell or a YAML file needs.
std::string WithMinus(std::string_view text) {
  std::string roff;
  for (const char c : text) roff += c == '-' ? "\\-" : std::string(1, c);
  return roff;
}

std::string Date() {
  const char* const epoch = std::getenv("SOURCE_DATE_EPOCH");
  const std::time_t time = epoch == nullptr ? std::time(nullptr) : std::atoll(epoch);
  std::tm date{};
  gmtime_r(&time, &date);
  char text[16];
  return {text, std::strftime(text, sizeof text, "%Y-%m-%d", &date)};
}

}  // namespace

std::string HelpText() {
  constexpr std::size_t kWidth = 14;
  std::string text = "howl_rig RIG.yaml --out DIR [--key FILE]: " + std::string(kPurpose) + "\n\n" +
                     std::string(kDescription) + "\n";
  for (const Option& option : kOptions) {
    std::string left(option.name);
    if (!option.value.empty()) left += " " + std::string(option.value);
    left.resize(std::max(kWidth, left.size() + 1), ' ');
    text += "  " + left + std::string(option.text) + "\n";
  }
  return text + "\nRIG.yaml, all but experiments being optional:\n\n" + std::string(kSpec) +
         "\nExit status: 0 done; 2 bad input.\n";
}

std::string ManPage() {
  std::string text = ".TH HOWL_RIG 1 " + Date() + " \"howl " HOWL_VERSION "\" \"User Commands\"\n";
  text += ".SH NAME\nhowl_rig \\- " + std::string(kPurpose) + "\n";
  text += ".SH SYNOPSIS\n.B howl_rig\n.I RIG.yaml\n\\fB\\-\\-out\\fR \\fIDIR\\fR\n";
  text += "[\\fB\\-\\-key\\fR \\fIFILE\\fR]\n.SH DESCRIPTION\n" + std::string(kDescription);
  text += ".SH OPTIONS\n";
  for (const Option& option : kOptions) {
    text += ".TP\n\\fB" + WithMinus(option.name) + "\\fR";
    if (!option.value.empty()) text += " \\fI" + std::string(option.value) + "\\fR";
    text += "\n" + std::string(option.text) + "\n";
  }
  text += ".SH FILES\nRIG.yaml, all but experiments being optional:\n.PP\n.nf\n";
  text += WithMinus(kSpec) + ".fi\n";
  text += ".SH EXIT STATUS\n.TP\n.B 0\ndone\n.TP\n.B 2\nbad input\n";
  return text + ".SH SEE ALSO\n.BR howl (1),\n.BR howl\\-trial (1)\n";
}

}  // namespace rig

#include <sstream>
#include <stdexcept>

#include "app/command_line/known_name.h"
#include "app/files/digest.h"
#include "app/trial/trial_run.h"
#include "io/config/reading/config_reading.h"

namespace howl {
namespace {

constexpr int kDefaultCases = 200;
constexpr int kMostCases = 100000;

std::vector<std::string> Words(const std::string& text, char between = ',') {
  std::vector<std::string> words;
  std::istringstream in(text);
  for (std::string word; std::getline(in, word, between);) {
    if (!word.empty()) words.push_back(word);
  }
  return words;
}

double Severity(const std::string& word) {
  for (const double severity : kSeverities) {
    if (word == SeverityName(severity)) return severity;
  }
  std::istringstream in(word);
  double value = -1.0;
  if (!(in >> value) || !in.eof() || value < 0.0 || value > 1.0) {
    throw UsageError("--severities: " + word +
                     ", expected small, medium, large, or numbers from 0 to 1");
  }
  return value;
}

// Each is a group, an effect that rigs have, or several joined by "+".
void CheckEffects(const std::vector<std::string>& asked, const std::vector<RigEffect>& rigs) {
  std::vector<std::string> known = {"catalogue", "outside", "none", "pairs"};
  for (const RigEffect& each : rigs) known.push_back(each.id);
  for (const std::string& joined : asked) {
    for (const std::string& id : Words(joined, '+')) {
      RequireKnown("--effects", id, known,
                   "no effect that howl_rig --list shows, nor catalogue, outside, none or pairs");
    }
  }
}

// The command line as it would be typed again on one machine, for the sheet.
std::string CommandText(const Options& options) {
  return "howl trial " + options.config.string() + OptionsText(options) + " --seed " +
         std::to_string(options.seed);
}

}  // namespace

TrialRequest MakeTrialRequest(const Options& options) {
  TrialRequest request;
  request.options.cases = options.Count("--cases", 1, kMostCases).value_or(kDefaultCases);
  request.options.effects =
      Words(options.Text("--effects").value_or("catalogue,none,outside,pairs"));
  for (const std::string& word : Words(options.Text("--severities").value_or("small,medium,large")))
    request.options.severities.push_back(Severity(word));
  request.options.seed = options.seed;
  const std::vector<RigEffect> rigs = ListRigEffects();
  CheckEffects(request.options.effects, rigs);
  try {
    PlanCases(request.options, rigs);
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--effects: ") + error.what());
  }
  const Config config = LoadConfig(options.config);
  request.rig_template = MakeRigTemplate(config, options);
  request.config_sha256 = Sha256OfFile(options.config).value_or("");
  request.command = CommandText(options);
  return request;
}

std::string TrialRequest::Passphrase() const {
  std::string text = "howl trial " + config_sha256 + " " + std::to_string(options.seed) + " " +
                     std::to_string(options.cases);
  for (const std::string& effect : options.effects) text += " " + effect;
  for (const double severity : options.severities) text += " " + std::to_string(severity);
  return text + "\n" + RigSpecYaml(rig_template, {});
}

}  // namespace howl

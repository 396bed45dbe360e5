#include "app/campaign/run_rig.h"

#include <chrono>
#include <nlohmann/json.hpp>
#include <system_error>
#include <thread>
#include <vector>

#include "app/campaign/rig_row.h"
#include "app/command_line/command.h"
#include "app/files/digest.h"
#include "app/process/child_process.h"
#include "app/process/interruption.h"
#include "io/json_text.h"
#include "io/user_error.h"
#include "io/whole_file.h"

namespace howl {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t kLongestError = 1000;

std::vector<std::string> Words(const CampaignSpec& spec, const std::string& command,
                               const fs::path& config, const CampaignRig& rig,
                               const fs::path& folder) {
  std::vector<std::string> words = {ThisProgram().string(), command, config.string()};
  if (const auto own = spec.options.find(command); own != spec.options.end()) {
    words.insert(words.end(), own->second.begin(), own->second.end());
  }
  const std::vector<std::string> common = {"--out",  folder.string(),          "--threads", "1",
                                           "--seed", std::to_string(rig.seed), "--quiet"};
  words.insert(words.end(), common.begin(), common.end());
  return words;
}

// The first line of what a program says, without the folder in which it ran.
std::string ErrorText(const ChildResult& result, const fs::path& folder) {
  if (result.status < 0) return "was ended by a signal";
  std::string text = result.err.substr(0, result.err.find('\n')).substr(0, kLongestError);
  const std::string prefix = folder.string() + "/";
  for (std::size_t at = 0; (at = text.find(prefix, at)) != std::string::npos;) {
    text.erase(at, prefix.size());
  }
  return text;
}

void RunCommands(const CampaignSpec& spec, const CampaignRig& rig, const fs::path& folder,
                 Json& row) {
  fs::path config = rig.config;
  for (const std::string& command : spec.commands) {
    std::error_code ignored;
    fs::remove(folder / ResultFile(command), ignored);
    const ChildResult result = RunChild(Words(spec, command, config, rig, folder), "");
    // A terminal's Ctrl-C reaches the child as well, and may end it before this program notices.
    if (result.status < 0) std::this_thread::sleep_for(std::chrono::milliseconds(200));
    if (IsInterrupted()) return;
    row["status"][command] = result.status;
    if (result.status != kDone && result.status != kNegativeAnswer) {
      row["error"] = command + ": " + ErrorText(result, folder);
      return;
    }
    try {
      HarvestResults(command, folder, row);
    } catch (const UserError& error) {
      row["error"] = command + ": " + ErrorText(result, folder);
      return;
    }
    if (command == "simulate") config = folder / "records.yaml";
  }
}

}  // namespace

std::string RigInputsSha256(const CampaignSpec& spec, const CampaignRig& rig) {
  std::string text = std::to_string(rig.seed) + "\n";
  for (const std::string& command : spec.commands) {
    text += command;
    if (const auto own = spec.options.find(command); own != spec.options.end()) {
      for (const std::string& word : own->second) text += " " + word;
    }
    text += "\n";
  }
  text += Sha256(rig.config_text);
  for (const fs::path& file : rig.input_files) text += Sha256OfFile(file).value_or("") + "\n";
  return Sha256(text);
}

void WriteRigConfig(const CampaignRig& rig) {
  if (rig.is_derived) WriteWholeFile(rig.config, rig.config_text);
}

std::optional<std::string> RunRig(const CampaignSpec& spec, const CampaignRig& rig,
                                  const fs::path& out) {
  const fs::path folder = RigFolder(out, rig.name);
  WriteRigConfig(rig);
  Json row = {{"rig", rig.name},          {"seed", rig.seed},
              {"settings", rig.settings}, {"inputs_sha256", RigInputsSha256(spec, rig)},
              {"status", Json::object()}, {"error", ""},
              {"values", Json::object()}, {"points", Json::array()}};
  RunCommands(spec, rig, folder, row);
  if (IsInterrupted()) return std::nullopt;
  if (!spec.keeps_folders) {
    std::error_code ignored;
    fs::remove_all(folder, ignored);
  }
  return JsonText(row);
}

}  // namespace howl

#include "io/report/run_file.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "io/json_text.h"
#include "io/whole_file.h"
#include "model/version.h"

namespace howl {
namespace {

constexpr const char* kSchema = "howl.run/1";

}  // namespace

RunFile ReadRunFile(const std::filesystem::path& folder) {
  std::ifstream file(folder / "run.json");
  if (!file) throw std::runtime_error("no such file");
  const auto json = ParseJsonOrNone<nlohmann::json>(file);
  if (!json.is_object() || json.value("schema", "") != kSchema) {
    throw std::runtime_error(std::string("half written, or not of the schema ") + kSchema);
  }
  RunFile run;
  run.config = json.value("config", "");
  run.config_text = json.value("config_text", "");
  if (json.contains("commands") && json["commands"].is_object()) {
    for (const auto& [command, entry] : json["commands"].items()) {
      if (!entry.is_object()) continue;
      run.commands[command] = {entry.value("seed", std::uint64_t{0}), entry.value("version", "")};
    }
  }
  return run;
}

void NoteRun(const std::filesystem::path& folder, const std::filesystem::path& config,
             const std::string& command, std::uint64_t seed) {
  RunFile run;
  try {
    run = ReadRunFile(folder);
  } catch (const std::exception&) {
    run = {};
  }
  const std::filesystem::path absolute = std::filesystem::absolute(config).lexically_normal();
  if (run.config != absolute) run.commands.clear();
  run.config = absolute;
  run.config_text = ReadWholeFile(absolute).value_or("");
  run.commands[command] = {seed, std::string(Version())};
  nlohmann::ordered_json commands = nlohmann::ordered_json::object();
  for (const auto& [name, entry] : run.commands) {
    commands[name] = {{"seed", entry.seed}, {"version", entry.version}};
  }
  const nlohmann::ordered_json json = {{"schema", kSchema},
                                       {"config", run.config.string()},
                                       {"config_text", run.config_text},
                                       {"commands", commands}};
  const auto keep_going = nlohmann::ordered_json::error_handler_t::replace;
  WriteWholeFile(folder / "run.json", json.dump(2, ' ', false, keep_going) + "\n");
}

}  // namespace howl

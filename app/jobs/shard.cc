#include "app/jobs/shard.h"

#include <charconv>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "io/json_text.h"
#include "io/user_error.h"
#include "io/whole_file.h"

namespace howl {
namespace {

std::optional<std::size_t> Whole(std::string_view text) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

std::string Shard::Name() const { return std::to_string(index) + "-of-" + std::to_string(count); }

OptionHelp ShardOption() {
  return {kShardOption, "I/N",
          "run share I of N alone, into a file of its own; howl merge joins the N"};
}

std::optional<Shard> ShardOf(const Options& options) {
  const std::optional<std::string> text = options.Text(kShardOption);
  if (!text) return std::nullopt;
  const std::size_t slash = std::min(text->find('/'), text->size());
  const std::optional<std::size_t> index = Whole(std::string_view(*text).substr(0, slash));
  const std::optional<std::size_t> count =
      slash < text->size() ? Whole(std::string_view(*text).substr(slash + 1)) : std::nullopt;
  if (!index || !count || *index < 1 || *index > *count || *count > kMostShards) {
    throw UsageError("--shard: " + *text + ", expected I/N, such as 3/16, with I from 1 to N and " +
                     "N up to " + std::to_string(kMostShards));
  }
  return Shard{*index, *count};
}

std::filesystem::path ShardFolder(const std::filesystem::path& out) { return out / "shards"; }

std::filesystem::path ShardPath(const std::filesystem::path& out, const std::string& command,
                                const Shard& shard) {
  return ShardFolder(out) / (shard.Name() + "." + command + ".shard");
}

std::filesystem::path ShardPartPath(const std::filesystem::path& out, const std::string& command,
                                    const Shard& shard) {
  return ShardFolder(out) / (shard.Name() + "." + command + ".part");
}

std::string ShardHeader(const std::string& command, const Options& options,
                        const std::string& inputs_sha256, const Shard& shard) {
  nlohmann::ordered_json own = nlohmann::ordered_json::object();
  for (const auto& [name, value] : options.own) {
    if (name != kShardOption) own[name] = value;
  }
  return JsonText(nlohmann::ordered_json{{"schema", "howl.shard/1"},
                                         {"command", command},
                                         {"config", options.config.string()},
                                         {"options", own},
                                         {"seed", options.seed},
                                         {"program", ProgramIdentity()},
                                         {"inputs_sha256", inputs_sha256},
                                         {"shards", shard.count},
                                         {"shard", shard.index}});
}

bool IsWhole(const StoredUnits& stored) {
  const auto count = stored.units.find(kCountKey);
  return stored.damaged == 0 && !stored.repeats_a_key && count != stored.units.end() &&
         count->second == std::to_string(stored.units.size() - 1);
}

bool IsShardDone(const std::filesystem::path& out, const std::string& command, const Shard& shard,
                 const std::string& header) {
  const std::filesystem::path path = ShardPath(out, command, shard);
  const StoredUnits stored = ReadUnits(path);
  if (!stored.is_there) return false;
  if (stored.header == header) return IsWhole(stored);
  throw UserError(path.string(), 1, "",
                  "is of another job, program or input, expected a folder without it (--out)");
}

void FinishShard(const Options& options, const std::string& command, const Shard& shard,
                 const std::string& header, const Units& units) {
  const std::filesystem::path path = ShardPath(options.out, command, shard);
  Units whole = units;
  whole[kCountKey] = std::to_string(units.size());
  WriteWholeFile(path, StoreText(header, whole));
  if (!options.quiet) std::printf("written: %s, %zu units\n", path.c_str(), units.size());
}

std::string OptionsText(const Options& options) {
  std::string text;
  for (const auto& [name, value] : options.own) {
    if (name == kShardOption) continue;
    text += " " + name;
    if (!value.empty()) text += " " + value;
  }
  return text;
}

}  // namespace howl

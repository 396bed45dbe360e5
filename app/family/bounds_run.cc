#include "app/family/bounds_run.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <functional>
#include <optional>
#include <sstream>

#include "app/files/digest.h"
#include "app/jobs/config_inputs.h"
#include "app/process/interruption.h"
#include "estimation/family/bounds/bound_text.h"
#include "estimation/unit_seed.h"
#include "io/config/reading/config_reading.h"
#include "io/whole_file.h"
#include "model/version.h"

namespace howl {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kSecondsBetweenSaves = 2.0;
constexpr int kLeastBetweenSaves = 30;  // times what the last one took
// About what saving takes over the square of the number of experiments (bench/scaling_study), for
// the first one.
constexpr double kSecondsToSaveOne = 2e-5;
constexpr const char* kHead = "head";

std::filesystem::path StatePath(const Options& options) { return options.out / "bounds.state"; }

// Identifies what the state belongs to: this config, test, seed and program.
std::string Key(const Options& options) {
  const std::string text =
      ReadWholeFile(options.config).value_or("") + options.Text("--without").value_or("");
  const std::uint64_t hash = UnitSeed(options.seed, text);
  return "howl.bounds " + std::string(Version()) + " " + std::to_string(hash);
}

// The number of the state's searches that are damaged and begin anew; no value where there is no
// state of this problem.
std::optional<std::size_t> LoadState(const std::filesystem::path& path, const std::string& key,
                                     Enclosure& enclosure) {
  std::ifstream file(path, std::ios::binary);
  std::string line;
  if (!std::getline(file, line) || line != key) return std::nullopt;
  const std::istream::pos_type start = file.tellg();
  if (!enclosure.Load(file)) return std::nullopt;
  file.clear();
  file.seekg(start);
  return CountDamagedSearches(file);
}

void SaveState(const std::filesystem::path& path, const std::string& key,
               const Enclosure& enclosure) {
  std::ostringstream text;
  text << key << "\n";
  enclosure.Save(text);
  WriteWholeFile(path, text.str());
}

void ShowProgress(const Enclosure& enclosure, Clock::time_point start) {
  const CellCounts cells = enclosure.Counts();
  const auto seconds =
      std::chrono::duration_cast<std::chrono::seconds>(Clock::now() - start).count();
  std::fprintf(stderr, "\rbounds: %zu boxes left, %lld s ", cells.pending + cells.undecided,
               static_cast<long long>(seconds));
}

void StopIfInterrupted(const std::filesystem::path& state) {
  if (!IsInterrupted()) return;
  throw Interrupted("interrupted: nothing written; the same command goes on from " +
                    state.string() + " where it has saved its bounds");
}

std::string KeyOfSearch(std::size_t k) {
  std::array<char, 32> key{};
  std::snprintf(key.data(), key.size(), "search#%06zu", k);  // ordered as the numbers are
  return key.data();
}

// Runs the searches that are owned to their end.
void RunSearches(const std::filesystem::path& path, const std::string& key, const Config& config,
                 const Options& options, Enclosure& enclosure,
                 const std::function<bool(std::size_t)>& owned) {
  WatchForInterruption();
  const bool shown = !options.quiet && isatty(STDERR_FILENO) != 0;
  const std::optional<std::size_t> damaged = LoadState(path, key, enclosure);
  if (damaged && !options.quiet) {
    const std::string anew =
        *damaged == 0 ? ""
                      : " (" + std::to_string(*damaged) + " of its searches damaged, done anew)";
    std::fprintf(stderr, "bounds: going on from %s%s\n", path.c_str(), anew.c_str());
  }
  const Clock::time_point start = Clock::now();
  const double seconds = options.Number("--save-every").value_or(kSecondsBetweenSaves);
  if (!(seconds > 0.0)) throw UsageError("--save-every: expected a positive number of seconds");
  const auto between = std::chrono::duration_cast<Clock::duration>(
      std::chrono::duration<double>(std::min(seconds, 3600.0)));
  bool was_shown = false;
  bool was_saved = false;
  // The state of many experiments is long, a member for each end of each parameter: saving takes no
  // more than a share of the time.
  const auto experiments = static_cast<double>(config.experiments.size());
  auto saving = std::chrono::duration_cast<Clock::duration>(
      std::chrono::duration<double>(kSecondsToSaveOne * experiments * experiments));
  while (true) {
    const Clock::time_point until = Clock::now() + std::max(between, kLeastBetweenSaves * saving);
    const bool complete =
        enclosure.Run([&] { return IsInterrupted() || Clock::now() >= until; }, owned);
    if (complete) break;
    const Clock::time_point before = Clock::now();
    SaveState(path, key, enclosure);
    saving = Clock::now() - before;
    was_saved = true;
    StopIfInterrupted(path);
    if (shown) ShowProgress(enclosure, start);
    was_shown = shown;
  }
  if (was_shown) std::fprintf(stderr, "\r%60s\r", "");
  // A search that ended before its first save needs no file.
  if (was_saved) SaveState(path, key, enclosure);
}

}  // namespace

void RunBounds(const Config& config, const Options& options, Enclosure& enclosure) {
  RunSearches(StatePath(options), Key(options), config, options, enclosure, nullptr);
}

void RunBoundsShard(const Config& config, const Options& options, const Shard& shard,
                    Enclosure& enclosure) {
  const std::string header =
      ShardHeader("family", options, FamilyInputsSha256(config, options), shard);
  if (IsShardDone(options.out, "family", shard, header)) return;
  const std::filesystem::path part = ShardPartPath(options.out, "family", shard);
  RunSearches(part, header, config, options, enclosure,
              [&](std::size_t k) { return shard.Owns(k); });
  Units units;
  units[kHead] = enclosure.SavedHead();
  for (std::size_t k = shard.index - 1; k < enclosure.Searches(); k += shard.count) {
    units[KeyOfSearch(k)] = enclosure.SavedSearch(k);
  }
  FinishShard(options, "family", shard, header, units);
  std::error_code ignored;
  std::filesystem::remove(part, ignored);
}

void AdoptBounds(const Options& options, const Units& units) {
  std::string text = Key(options) + "\n";
  for (const auto& [key, bytes] : units) text += bytes;  // "head" comes before "search#"
  WriteWholeFile(StatePath(options), text);
}

std::string FamilyInputsSha256(const Config& config, const Options& options) {
  const std::optional<std::string> other = options.Text("--falsify");
  return Sha256(ConfigInputsSha256(config) + (other ? ConfigInputsSha256(LoadConfig(*other)) : ""));
}

void StopIfInterrupted(const Options& options) { StopIfInterrupted(StatePath(options)); }

void ForgetBounds(const Options& options) {
  std::error_code ignored;
  std::filesystem::remove(StatePath(options), ignored);
}

}  // namespace howl

#include "diagnosis/search/bootstrap.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstring>
#include <mutex>
#include <numeric>
#include <optional>
#include <string>

#include "diagnosis/cuts/make_cut_records.h"
#include "diagnosis/fit/fitted_rig.h"
#include "diagnosis/search/search.h"
#include "estimation/parallel.h"
#include "estimation/unit_seed.h"

namespace howl {
namespace {

constexpr double kLevel = 0.05;
constexpr std::size_t kFewReplicates = 8;
// Six standard deviations, because the candidate is the best of twenty, and eight replicates give
// its deviation only roughly.
constexpr double kDeviations = 6.0;

// The memory's key of a replicate: all that it depends on in addition to the records.
std::string KeyOf(const DiagnosisOptions& options, std::size_t replicate) {
  std::string key = "bootstrap#" + std::to_string(options.seed) + "#" + std::to_string(replicate);
  for (const std::string& id : options.withheld) key += "#" + id;
  return key;
}

// No value if the run was stopped.
std::optional<double> GainOfReplicate(const std::vector<CutRecord>& records, const EffectFit& base,
                                      const std::vector<DiagnosisExperiment>& experiments,
                                      const DiagnosisOptions& options, std::size_t i) {
  const std::string key = KeyOf(options, i);
  std::optional<std::string> kept;
  if (options.memory) kept = options.memory->Recall(key);
  if (kept && kept->size() == sizeof(double)) {
    double gain = 0.0;
    std::memcpy(&gain, kept->data(), sizeof gain);
    return gain;
  }
  if (options.stopped && options.stopped()) return std::nullopt;
  DiagnosisOptions alone;
  alone.threads = 1;
  alone.withheld = options.withheld;
  alone.further = options.further;
  alone.model = options.model;
  alone.stopped = options.stopped;
  const std::optional<double> gain =
      Search(Replicate(records, base, experiments, UnitSeed(options.seed, "bootstrap", i)), alone)
          .LargestGain();
  if (gain && options.memory) {
    options.memory->Keep(key, std::string(reinterpret_cast<const char*>(&*gain), sizeof *gain));
  }
  return gain;
}

}  // namespace

std::vector<double> BootstrapGains(const std::vector<CutRecord>& records, const EffectFit& base,
                                   const std::vector<DiagnosisExperiment>& experiments,
                                   const DiagnosisOptions& options) {
  std::vector<std::size_t> replicates;
  for (std::size_t i = 0; i < options.bootstrap; ++i) {
    if (!options.owns_replicate || options.owns_replicate(i)) replicates.push_back(i);
  }
  std::vector<double> gains(replicates.size());
  std::atomic<bool> stopped = false;
  std::atomic<std::size_t> done = 0;
  std::mutex progress_lock;
  RunUnits(gains.size(), options.threads, [&](std::size_t k) {
    const std::size_t i = replicates[k];
    const std::optional<double> gain = GainOfReplicate(records, base, experiments, options, i);
    if (!gain) {
      stopped = true;
      return;
    }
    gains[k] = *gain;
    const std::size_t now = ++done;
    if (options.bootstrap_progress) {
      const std::lock_guard<std::mutex> lock(progress_lock);
      options.bootstrap_progress(now, gains.size());
    }
  });
  if (stopped) return {};
  std::sort(gains.begin(), gains.end());
  return gains;
}

double GainOfNoise(const std::vector<CutRecord>& records, const EffectFit& base,
                   const std::vector<DiagnosisExperiment>& experiments,
                   const std::vector<EffectPointer>& forms, const DiagnosisOptions& options) {
  std::array<double, kFewReplicates> gains{};
  RunUnits(gains.size(), options.threads, [&](std::size_t i) {
    const std::vector<CutRecord> replicate = MakeCutRecords(
        Replicate(records, base, experiments, UnitSeed(options.seed, "gain of noise", i)),
        records[0].model);
    const EffectFit without = FitBase(replicate);
    const EffectFit with = FitBestForm(nullptr, "", replicate, forms, without);
    gains[i] = GainOver(without, with) - PriceOfParameters(static_cast<double>(with.values.size()));
  });
  const double count = static_cast<double>(gains.size());
  const double mean = std::accumulate(gains.begin(), gains.end(), 0.0) / count;
  double squares = 0.0;
  for (const double gain : gains) squares += (gain - mean) * (gain - mean);
  return mean + kDeviations * std::sqrt(squares / (count - 1.0));
}

double BootstrapPValue(const std::vector<double>& gains, double gain) {
  const auto reached = gains.end() - std::lower_bound(gains.begin(), gains.end(), gain);
  return (1.0 + static_cast<double>(reached)) / (1.0 + static_cast<double>(gains.size()));
}

double BootstrapDetectionGain(const std::vector<double>& gains) {
  const double rank = std::ceil((1.0 - kLevel) * static_cast<double>(gains.size() + 1));
  return gains[std::min(gains.size(), static_cast<std::size_t>(rank)) - 1];
}

}  // namespace howl

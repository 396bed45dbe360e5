#include "diagnosis/bootstrap/bootstrap.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstring>
#include <mutex>
#include <numeric>
#include <optional>
#include <string>

#include "diagnosis/bootstrap/fitted_rig.h"
#include "diagnosis/search.h"
#include "estimation/parallel.h"
#include "estimation/unit_seed.h"

namespace howl {
namespace {

constexpr double kLevel = 0.05;
constexpr std::size_t kFewReplicates = 8;
// The best of twenty candidates is looked at, and eight replicates give its deviation roughly.
constexpr double kDeviations = 6.0;

std::vector<DiagnosisExperiment> Replicate(const std::vector<CutRecord>& records,
                                           const EffectFit& base,
                                           const std::vector<DiagnosisExperiment>& experiments,
                                           std::uint64_t seed) {
  std::vector<DiagnosisExperiment> out;
  for (std::size_t e = 0; e < records.size(); ++e) {
    const SimulatedRecord record = Simulate(
        FittedRig(records[e], base, e, UnitSeed(seed, "point", e)), FittedRigOptions(records[e]));
    out.push_back({experiments[e].name,
                   experiments[e].phi,
                   {record.sampling_hz, record.pressure, record.heat_release}});
  }
  return out;
}

// With what the replicate depends on beside the records.
std::string KeyOf(const DiagnosisOptions& options, std::size_t replicate) {
  std::string key = "bootstrap#" + std::to_string(options.seed) + "#" + std::to_string(replicate);
  for (const std::string& id : options.withheld) key += "#" + id;
  return key;
}

}  // namespace

std::vector<double> BootstrapGains(const std::vector<CutRecord>& records, const EffectFit& base,
                                   const std::vector<DiagnosisExperiment>& experiments,
                                   const DiagnosisOptions& options) {
  std::vector<double> gains(options.bootstrap);
  DiagnosisOptions each;
  each.threads = 1;
  each.withheld = options.withheld;
  each.further = options.further;
  each.stopped = options.stopped;
  std::atomic<bool> stopped = false;
  std::atomic<std::size_t> done = 0;
  std::mutex progress_lock;
  RunUnits(gains.size(), options.threads, [&](std::size_t i) {
    const std::string key = KeyOf(options, i);
    std::optional<std::string> kept;
    if (options.memory) kept = options.memory->Recall(key);
    if (kept && kept->size() == sizeof gains[i]) {
      std::memcpy(&gains[i], kept->data(), sizeof gains[i]);
    } else {
      if (!(options.stopped && options.stopped())) {
        const std::optional<double> gain =
            Search(Replicate(records, base, experiments, UnitSeed(options.seed, "bootstrap", i)),
                   each)
                .LargestGain();
        if (gain) gains[i] = *gain;
      }
      if (options.stopped && options.stopped()) {
        stopped = true;
        return;
      }
      if (options.memory) {
        options.memory->Keep(
            key, std::string(reinterpret_cast<const char*>(&gains[i]), sizeof gains[i]));
      }
    }
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
    const std::vector<DiagnosisExperiment> replicate =
        Replicate(records, base, experiments, UnitSeed(options.seed, "gain of noise", i));
    const std::vector<CutRecord> replicate_records = MakeCutRecords(replicate);
    const EffectFit replicate_base = FitBase(replicate_records);
    Setting at{&replicate_records, &replicate_base, &replicate, {}, nullptr, nullptr};
    for (std::size_t e = 0; e < replicate_records.size(); ++e) {
      at.base_held_out.push_back(replicate_base.experiments[e]);
    }
    Attempt attempt = TryTransfer(at, forms);
    PayForParameters(&attempt);
    gains[i] = attempt.candidate.gain;
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

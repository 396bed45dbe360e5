#include "diagnosis/loop_budget/sample_facts.h"

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <string_view>
#include <utility>

#include "diagnosis/loop_budget/fine_steps.h"
#include "diagnosis/samples/hum_below_band.h"
#include "diagnosis/samples/sample_limits.h"
#include "estimation/health/clipped_samples.h"
#include "estimation/health/sample_health.h"
#include "estimation/health/stuck_samples.h"
#include "model/effects/catalogue.h"

namespace howl {
namespace {

struct Kind {
  const char* effect;
  std::string_view subject;  // of a finding (sample_health.h)
};

constexpr const char* kQuantisation = "quantisation";
constexpr std::string_view kPressureClipped = "p_clipped";
constexpr std::array<Kind, 5> kKinds = {{{"p_clipping", kPressureClipped},
                                         {"q_clipping", "q_clipped"},
                                         {kQuantisation, "p_coarse"},
                                         {"p_dropouts", "p_stuck"},
                                         {"q_dropouts", "q_stuck"}}};

Health FindingsOf(const LoopRecord& of) {
  const Record& record = of.record;
  Health out = CheckSamples(of.name, "p", record.pressure, record.sampling_hz);
  Append(CheckSamples(of.name, "q", record.heat_release, record.sampling_hz), out);
  return out;
}

LoopBlock BlockOf(std::string_view effect) {
  for (const EffectPointer& each : Catalogue()) {
    if (each->id() == effect) return each->block();
  }
  return effect.starts_with("q_") ? LoopBlock::kHeatReleaseInstrument
                                  : LoopBlock::kPressureInstrument;
}

// Zero where the samples do not show it.
double ValueOf(const Kind& kind, const Health& findings, const Record& record) {
  double value = 0.0;
  // A signal may be clipped at both ends: its shares are added.
  for (const Finding& finding : findings) {
    if (finding.subject == kind.subject) value += finding.value;
  }
  if (value == 0.0 && kind.subject == kPressureClipped) return ShareOnNoisyRails(record.pressure);
  return value;
}

// Of more than half of the records; `value_of` the e-th is zero where it does not show it.
std::optional<SampleFact> FactOf(const std::string& effect, std::size_t records,
                                 const std::vector<std::string>& withheld,
                                 const std::function<double(std::size_t)>& value_of) {
  if (std::ranges::find(withheld, effect) != withheld.end()) return std::nullopt;
  SampleFact out{.effect = effect, .rest_can_be_found = true, .block = BlockOf(effect)};
  for (std::size_t e = 0; e < records; ++e) {
    const double value = value_of(e);
    out.value += value;
    if (value != 0.0) ++out.experiments;
  }
  if (2 * out.experiments <= records) return std::nullopt;
  out.value /= static_cast<double>(out.experiments);
  return out;
}

// Of the channel that has more of it.
std::optional<SampleFact> HumOf(const std::vector<LoopRecord>& records,
                                const std::vector<std::string>& withheld) {
  std::optional<SampleFact> out;
  for (const auto& [block, signal] :
       {std::pair(LoopBlock::kPressureInstrument, &Record::pressure),
        std::pair(LoopBlock::kHeatReleaseInstrument, &Record::heat_release)}) {
    double line_hz = 0.0;
    std::optional<SampleFact> seen =
        FactOf("mains_hum", records.size(), withheld, [&, signal = signal](std::size_t e) {
          const Record& record = records[e].record;
          const MainsLine line =
              HumBelowBand(record.*signal, record.sampling_hz, records[e].cycle_hz);
          if (line.of_cycle > 0.0) line_hz = line.frequency_hz;
          return line.of_cycle;
        });
    if (!seen || (out && out->value >= seen->value)) continue;
    out = std::move(seen);
    out->block = block;
    out->line_hz = line_hz;
  }
  return out;
}

bool CanBeMadeGood(const std::string& effect, const std::vector<LoopRecord>& records) {
  return std::ranges::all_of(records, [&](const LoopRecord& each) {
    const Record& record = each.record;
    if (effect == "p_clipping") {
      const double share = ShareClipped(record.pressure);
      return share <= kMostClipped && (share > 0.0 || ShareOnNoisyRails(record.pressure) == 0.0);
    }
    if (effect == "p_dropouts") return ShareStuck(record.pressure) <= kMostStuck;
    return effect == "q_dropouts" && ShareStuck(record.heat_release) <= kMostStuck;
  });
}

}  // namespace

std::vector<std::string> SampleFactIds() {
  std::vector<std::string> out;
  for (const Kind& kind : kKinds) out.emplace_back(kind.effect);
  return out;
}

bool RestCanBeFound(const std::vector<SampleFact>& facts) {
  return std::ranges::all_of(facts, &SampleFact::rest_can_be_found);
}

std::vector<SampleFact> SampleFactsOf(const std::vector<LoopRecord>& records,
                                      const std::vector<std::string>& withheld) {
  std::vector<Health> findings;
  for (const LoopRecord& record : records) findings.push_back(FindingsOf(record));
  std::vector<SampleFact> out;
  for (const Kind& kind : kKinds) {
    std::optional<SampleFact> fact =
        FactOf(kind.effect, records.size(), withheld,
               [&](std::size_t e) { return ValueOf(kind, findings[e], records[e].record); });
    if (!fact) continue;
    fact->rest_can_be_found = CanBeMadeGood(kind.effect, records);
    out.push_back(*std::move(fact));
  }
  if (std::optional<SampleFact> hum = HumOf(records, withheld)) {
    out.push_back(*std::move(hum));
  }
  // Coarse steps are called so already.
  if (std::ranges::find(out, kQuantisation, &SampleFact::effect) != out.end()) return out;
  if (std::optional<SampleFact> steps =
          FactOf(kQuantisation, records.size(), withheld,
                 [&](std::size_t e) { return LevelsOfFineSteps(records[e].record.pressure); })) {
    out.insert(out.begin(), *std::move(steps));
  }
  return out;
}

}  // namespace howl

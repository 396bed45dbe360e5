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

// Of p's samples, those that a saturation held before noise was added to them.
double ShareOnNoisyRails(const std::vector<double>& pressure) {
  const Eigen::Map<const Eigen::VectorXd> x(pressure.data(),
                                            static_cast<Eigen::Index>(pressure.size()));
  if (!HasNoisyRails(x)) return 0.0;
  const Plateaus plateaus = FindPlateaus(x);
  return (plateaus.upper + plateaus.lower).mean();
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

// Of more than half of the records; `value_of` is zero for one that does not show it.
std::optional<SampleFact> FactOf(const std::string& effect, const std::vector<LoopRecord>& records,
                                 const std::vector<std::string>& withheld,
                                 const std::function<double(const LoopRecord&)>& value_of) {
  if (std::ranges::find(withheld, effect) != withheld.end()) return std::nullopt;
  SampleFact out{.effect = effect, .rest_can_be_found = true, .block = BlockOf(effect)};
  for (const LoopRecord& each : records) {
    const double value = value_of(each);
    out.value += value;
    if (value > 0.0) ++out.experiments;
  }
  if (2 * out.experiments <= records.size()) return std::nullopt;
  out.value /= static_cast<double>(out.experiments);
  return out;
}

double FineSteps(const LoopRecord& of) { return LevelsOfFineSteps(of.record.pressure); }

// Of the channel that has more of it.
std::optional<SampleFact> HumOf(const std::vector<LoopRecord>& records,
                                const std::vector<std::string>& withheld) {
  std::optional<SampleFact> out;
  for (const auto& [block, signal] :
       {std::pair(LoopBlock::kPressureInstrument, &Record::pressure),
        std::pair(LoopBlock::kHeatReleaseInstrument, &Record::heat_release)}) {
    double line_hz = 0.0;
    std::optional<SampleFact> seen =
        FactOf("mains_hum", records, withheld, [&, signal = signal](const LoopRecord& of) {
          const MainsLine line =
              HumBelowBand(of.record.*signal, of.record.sampling_hz, of.cycle_hz);
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

bool CanBeFilled(const std::string& effect, const std::vector<LoopRecord>& records) {
  if (!effect.ends_with("dropouts")) return false;
  return std::ranges::all_of(records, [&](const LoopRecord& each) {
    const Record& record = each.record;
    return ShareStuck(effect[0] == 'p' ? record.pressure : record.heat_release) <= kMostStuck;
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

bool CanBeRepaired(const std::vector<SampleFact>& facts) {
  return !RestCanBeFound(facts) && std::ranges::none_of(facts, [](const SampleFact& fact) {
    return fact.effect.ends_with("dropouts");
  });
}

std::vector<SampleFact> SampleFactsOf(const std::vector<LoopRecord>& records,
                                      const std::vector<std::string>& withheld) {
  std::array<SampleFact, kKinds.size()> seen;
  for (const LoopRecord& record : records) {
    const Health findings = FindingsOf(record);
    for (std::size_t k = 0; k < kKinds.size(); ++k) {
      const double value = ValueOf(kKinds[k], findings, record.record);
      if (value == 0.0) continue;
      seen[k].value += value;
      ++seen[k].experiments;
    }
  }
  std::vector<SampleFact> out;
  for (std::size_t k = 0; k < kKinds.size(); ++k) {
    if (2 * seen[k].experiments <= records.size()) continue;
    if (std::ranges::find(withheld, kKinds[k].effect) != withheld.end()) continue;
    out.push_back({kKinds[k].effect, seen[k].value / static_cast<double>(seen[k].experiments),
                   seen[k].experiments, CanBeFilled(kKinds[k].effect, records),
                   BlockOf(kKinds[k].effect)});
  }
  if (std::optional<SampleFact> hum = HumOf(records, withheld)) {
    out.push_back(*std::move(hum));
  }
  // Coarse steps are called so already.
  if (std::ranges::find(out, kQuantisation, &SampleFact::effect) != out.end()) return out;
  if (std::optional<SampleFact> steps = FactOf(kQuantisation, records, withheld, FineSteps)) {
    out.insert(out.begin(), *std::move(steps));
  }
  return out;
}

}  // namespace howl

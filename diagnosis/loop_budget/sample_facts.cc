#include "diagnosis/loop_budget/sample_facts.h"

#include <algorithm>
#include <array>

#include "estimation/health/sample_health.h"

namespace howl {
namespace {

struct Kind {
  const char* effect;
  const char* subject;  // of a finding (sample_health.h)
};

constexpr std::array<Kind, 3> kKinds = {
    {{"p_clipping", "p_clipped"}, {"q_clipping", "q_clipped"}, {"quantisation", "p_coarse"}}};

Health FindingsOf(const LoopRecord& of) {
  const Record& record = of.record;
  Health out = CheckSamples(of.name, "p", record.pressure, record.sampling_hz);
  Append(CheckSamples(of.name, "q", record.heat_release, record.sampling_hz), out);
  return out;
}

}  // namespace

std::vector<std::string> SampleFactIds() {
  std::vector<std::string> out;
  for (const Kind& kind : kKinds) out.emplace_back(kind.effect);
  return out;
}

std::vector<SampleFact> SampleFactsOf(const std::vector<LoopRecord>& records,
                                      const std::vector<std::string>& withheld) {
  std::array<SampleFact, kKinds.size()> seen;
  for (const LoopRecord& record : records) {
    const Health findings = FindingsOf(record);
    for (std::size_t k = 0; k < kKinds.size(); ++k) {
      double value = 0.0;
      // A signal may be clipped at both ends: its shares are added.
      for (const Finding& finding : findings) {
        if (finding.subject == kKinds[k].subject) value += finding.value;
      }
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
                   seen[k].experiments});
  }
  return out;
}

}  // namespace howl

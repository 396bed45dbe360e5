#include "io/results/plan_json.h"

#include "io/results/solution_json.h"

namespace howl {
namespace {

using Json = nlohmann::ordered_json;

Json SizeJson(const PlannedSize& size) {
  Json others = Json::object();
  for (const auto& [name, value] : size.others) others[name] = NumberOrNull(value);
  if (!size.form.key.empty()) others[size.form.key] = size.form.value;
  return {{"smallest", NumberOrNull(size.smallest)}, {"at", others}};
}

Json EffectJson(const PlannedEffect& effect) {
  Json sizes = Json::array();
  for (const PlannedSize& size : effect.sizes) sizes.push_back(SizeJson(size));
  Json rivals = Json::object();
  for (const PlannedRival& rival : effect.rivals) {
    rivals[rival.effect] = {{"told_apart_at", NumberOrNull(rival.told_apart_at)},
                            {"nats", NumberOrNull(rival.nats)},
                            {"nats_needed", NumberOrNull(rival.nats_needed)}};
  }
  return {{"effect", effect.effect},
          {"block", LoopBlockName(effect.block)},
          {"parameter", effect.parameter},
          {"unit", effect.unit},
          {"null", NumberOrNull(effect.null_value)},
          {"smallest", NumberOrNull(effect.size.smallest)},
          {"at", SizeJson(effect.size)["at"]},
          {"sizes", sizes},
          {"nats_needed", effect.gain_needed},
          {"reference", NumberOrNull(effect.reference)},
          {"reference_nats", NumberOrNull(effect.reference_gain)},
          {"rivals", rivals}};
}

Json PairJson(const PlannedPair& pair) {
  Json trials = Json::array();
  for (const PlannedTrial& trial : pair.trials) {
    trials.push_back({{"what", trial.what},
                      {"nats", NumberOrNull(trial.nats)},
                      {"nats_needed", NumberOrNull(trial.nats_needed)}});
  }
  return {{"effects", {pair.effect, pair.other}},
          {"nats", NumberOrNull(pair.nats)},
          {"nats_needed", NumberOrNull(pair.nats_needed)},
          {"measurements", trials}};
}

}  // namespace

Json PlanJson(const Plan& plan, bool simulated) {
  Json effects = Json::array();
  for (const PlannedEffect& effect : plan.effects) effects.push_back(EffectJson(effect));
  Json pairs = Json::array();
  for (const PlannedPair& pair : plan.pairs) pairs.push_back(PairJson(pair));
  return {{"schema", "howl.plan/1"},
          {"records", simulated ? "simulated" : "measured"},
          {"base",
           {{"modes", plan.model.modes},
            {"harmonic_ratio", plan.model.harmonic_ratio},
            {"own_delays", plan.model.own_delays},
            {"tau_s", plan.tau_s},
            {"delay_scatter", plan.delay_scatter}}},
          {"effects", effects},
          {"classes", plan.classes},
          {"pairs", pairs}};
}

}  // namespace howl

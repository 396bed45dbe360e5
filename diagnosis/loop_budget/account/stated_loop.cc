#include "diagnosis/loop_budget/account/stated_loop.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <string_view>
#include <vector>

#include "estimation/joint_records/loop_names.h"

namespace howl {
namespace {

constexpr std::string_view kSkewId = "channel_skew";

std::string RadiansAt(double frequency_hz) { return "(2 pi " + ShortNumber(frequency_hz) + ")"; }

// 1 / (1 + 2 zeta s / w + (s / w)^2), with twice zeta as it is written.
std::string SecondOrder(double frequency_hz, const std::string& twice_zeta) {
  const std::string s = "s / " + RadiansAt(frequency_hz);
  return "1 / (1 + " + twice_zeta + " * " + s + " + (" + s + ")^2)";
}

void Multiply(const std::string& factor, std::string* product) {
  if (factor.empty()) return;
  *product = product->empty() ? factor : "(" + *product + ") * (" + factor + ")";
}

// With the values that a reader of the budget sees.
SharedEffect AsReported(SharedEffect shared, const Budget& budget) {
  const LoopItem item = SharedItem(shared.effect);
  const auto take = [&](const auto& reported) {
    for (const auto& each : reported) {
      if (each.item != item.id || each.form != FormOf(item)) continue;
      for (std::size_t i = 0; i < each.parameters.size(); ++i) {
        shared.values[i] = each.parameters[i].value;
      }
    }
  };
  take(budget.given);
  take(budget.entries);
  return shared;
}

void State(const SharedEffect& shared, const LoopRecords& records, StatedLoop* out) {
  const std::string_view id = shared.effect->id();
  if (id == kSkewId) out->delay_s += shared.values[0];
  if (id == kLeakId) {
    // The leak is relative to each record's own q over p.
    out->pressure_in_heat_release.resize(records.size(), 0.0);
    for (std::size_t e = 0; e < records.size(); ++e) {
      const RecordScale& scale = records.Scale(e);
      out->pressure_in_heat_release[e] += shared.values[0] * scale.heat_release / scale.pressure;
    }
  }
  Multiply(ResponseFormula(shared), shared.effect->block() == LoopBlock::kPressureInstrument
                                        ? &out->pressure_response
                                        : &out->heat_release_response);
}

}  // namespace

std::string ShortNumber(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

std::string ResponseFormula(const SharedEffect& shared) {
  const std::string_view id = shared.effect->id();
  const double hz = shared.values[0];
  if (hz == shared.effect->parameters()[0].null_value) return "";
  if (id == "q_sensor_lowpass") {
    return shared.effect->form().value == "1" ? "1 / (1 + s / " + RadiansAt(hz) + ")"
                                              : SecondOrder(hz, "sqrt(2)");
  }
  if (id == "q_sensor_highpass" || id == "p_sensor_highpass") {
    return "s / (s + 2 pi " + ShortNumber(hz) + ")";
  }
  if (id == "p_sensor_resonance") return SecondOrder(hz, ShortNumber(2.0 * shared.values[1]));
  return "";
}

bool IsStated(const LoopItem& item) {
  switch (item.kind) {
    case LoopItemKind::kNoise:
      return !HasLines(item.noise.source) && item.noise.source != LoopNoise::kFlameGain;
    case LoopItemKind::kSharedEffect: {
      const std::string_view id = item.effect->id();
      const bool catalogued = std::ranges::any_of(
          SharedEffects(), [&](const EffectPointer& each) { return each->id() == id; });
      return catalogued && !IsFlameFilter(*item.effect);
    }
    case LoopItemKind::kSlowChange:
      return false;
    default:
      return true;
  }
}

StatedLoop StatedLoopOf(const LoopRecords& records, const LoopFound& found, const Budget& budget) {
  const auto model_of = [](const LoopForm& form) {
    return ModelLine(form.structure, form.flame_input);
  };
  const LoopForm& best = found.best.model;
  const LoopForm& config = found.without_given ? found.without_given->model : found.base.model;
  StatedLoop out;
  out.model = model_of(best);
  out.is_another_model = out.model != model_of(config);
  for (const SharedEffect& each : best.effects) {
    State(AsReported(each, budget), records, &out);
  }
  const auto add = [&](const LoopItem& item) {
    if (!IsStated(item)) out.not_stated.push_back(item.id);
  };
  for (const LoopItem& item : found.given) add(item);
  for (const LoopStep& step : found.steps) add(step.item);
  return out;
}

}  // namespace howl

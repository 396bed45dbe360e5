#include "diagnosis/loop_budget/forms/shared_effect.h"

#include <cmath>
#include <complex>
#include <memory>
#include <utility>

#include "model/effects/catalogue.h"

namespace howl {
namespace {

std::complex<double> ResponseOf(const SharedEffect& shared, double frequency_hz) {
  return shared.effect->HeatReleaseInstrument(frequency_hz, shared.values);
}

// In units of the record: a leak is relative to the record's own q over p.
std::complex<double> LeakOf(const SharedEffect& shared, double frequency_hz) {
  EffectContext at;
  at.heat_release_over_pressure = at.own_heat_release_over_pressure = 1.0;
  return shared.effect->PressureLeak(frequency_hz, at, shared.values);
}

bool IsAtNull(const SharedEffect& shared) {
  return shared.values[0] == shared.effect->parameters()[0].null_value;
}

// A filter turns the cycle's phase. Its turn is taken back, as a delay at all frequencies, so that
// the loop's own delay stays that of the cycle, which records tell best.
FlameFilters FiltersOf(const SharedEffect& filter, double cycle_hz) {
  const auto at = [filter, cycle_hz](auto response) {
    const auto plain = [filter, cycle_hz, response](std::complex<double> s) {
      return ((*filter.effect).*response)(s.imag() * cycle_hz, {}, filter.values);
    };
    const double turn = std::arg(plain({0.0, 1.0}));
    return [plain, turn](std::complex<double> s) { return plain(s) * std::exp(-turn * s); };
  };
  return filter.effect->ChangesFlameInput() ? FlameFilters{at(&Effect::FlameIn), nullptr}
                                            : FlameFilters{nullptr, at(&Effect::FlameOut)};
}

}  // namespace

bool IsFlameFilter(const Effect& effect) {
  return effect.id() == "flame_lowpass" ||
         (effect.id() == "second_delay_path" && effect.ChangesFlameInput());
}

std::vector<EffectPointer> SharedEffects() {
  std::vector<EffectPointer> out;
  for (const EffectPointer& effect : Catalogue()) {
    const bool of_q = effect->kind() == EffectKind::kTransfer &&
                      effect->block() == LoopBlock::kHeatReleaseInstrument;
    // Relative to the mean of all points a leak is the same thing in other units.
    const bool again = effect->form().key == "range" && effect->form().value != "own";
    if (of_q && effect->parameters().size() == 1 && !again) out.push_back(effect);
    if (IsFlameFilter(*effect)) out.push_back(effect);
  }
  return out;
}

RecordSpectra RecordBeside(RecordSpectra record, const SharedEffect& shared) {
  if (IsAtNull(shared)) return record;
  if (IsFlameFilter(*shared.effect)) {
    const FlameFilters filters = FiltersOf(shared, record.scale.cycle_hz);
    return WithFilters(std::move(record), filters);
  }
  for (Eigen::Index i = 0; i < record.edge_s.size(); ++i) {
    const double hz = record.edge_s[i].imag() * record.scale.cycle_hz;
    record.heat_release[i] =
        (record.heat_release[i] - LeakOf(shared, hz) * record.pressure[i]) / ResponseOf(shared, hz);
  }
  if (record.instrument_power.size() == 0) record.instrument_power.setOnes(record.bins());
  for (Eigen::Index i = 0; i < record.bins(); ++i) {
    const double hz = record.s[i].imag() * record.scale.cycle_hz;
    record.instrument_power[i] *= std::norm(ResponseOf(shared, hz));
  }
  if (record.middle) {
    record.middle = std::make_shared<const RecordSpectra>(RecordBeside(*record.middle, shared));
  }
  return record;
}

double LogJacobian(const RecordSpectra& record, const SharedEffect& shared) {
  if (IsAtNull(shared) || IsFlameFilter(*shared.effect)) return 0.0;
  double sum = 0.0;
  for (Eigen::Index i = 0; i < record.bins(); ++i) {
    const double hz = record.s[i].imag() * record.scale.cycle_hz;
    sum -= record.share[i] * std::log(std::norm(ResponseOf(shared, hz)));
  }
  return sum;
}

double LogJacobian(const RecordSpectra& record, const std::vector<SharedEffect>& effects) {
  double sum = 0.0;
  for (const SharedEffect& each : effects) sum += LogJacobian(record, each);
  return sum;
}

}  // namespace howl

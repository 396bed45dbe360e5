#include "diagnosis/loop_budget/forms/shared_effect.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <iterator>
#include <memory>
#include <utility>

#include "estimation/record_fit/spectra/unitary_transform.h"
#include "model/effects/catalogue.h"

namespace howl {
namespace {

using C = std::complex<double>;

// In the order in which they are taken out of a record: a leak is of p as it was recorded, and what
// makes the flame's functions anew makes the record's middle anew as well.
enum class Stage : std::uint8_t { kLeak, kFlame, kPressure, kHeatRelease };
constexpr std::array kStages = {Stage::kLeak, Stage::kFlame, Stage::kPressure, Stage::kHeatRelease};

Stage StageOf(const Effect& effect) {
  if (effect.id() == kLeakId) return Stage::kLeak;
  if (IsFlameFilter(effect)) return Stage::kFlame;
  return effect.block() == LoopBlock::kPressureInstrument ? Stage::kPressure : Stage::kHeatRelease;
}

bool IsAtNull(const SharedEffect& shared) {
  return shared.values[0] == shared.effect->parameters()[0].null_value;
}

// Of a stage, those that change anything.
std::vector<SharedEffect> InStage(const std::vector<SharedEffect>& effects, Stage stage) {
  std::vector<SharedEffect> out;
  std::ranges::copy_if(effects, std::back_inserter(out), [&](const SharedEffect& each) {
    return StageOf(*each.effect) == stage && !IsAtNull(each);
  });
  return out;
}

// In units of the record: a leak is relative to the record's own q over p.
C LeakOf(const SharedEffect& shared, double frequency_hz) {
  EffectContext at;
  at.heat_release_over_pressure = at.own_heat_release_over_pressure = 1.0;
  return shared.effect->PressureLeak(frequency_hz, at, shared.values);
}

TransferFunction HeatReleaseInstrumentOf(const SharedEffect& shared, double cycle_hz) {
  return [shared, cycle_hz](C s) {
    return shared.effect->HeatReleaseInstrument(s.imag() * cycle_hz, shared.values);
  };
}

// Over its size at the cycle.
TransferFunction PressureInstrumentOf(const SharedEffect& shared, double cycle_hz) {
  const double size = std::abs(shared.effect->PressureInstrument(cycle_hz, shared.values));
  return [shared, cycle_hz, size](C s) {
    return shared.effect->PressureInstrument(s.imag() * cycle_hz, shared.values) / size;
  };
}

// A delay at all frequencies that takes back this phase at the cycle.
TransferFunction TurnBack(C at_cycle) {
  const double turn = std::arg(at_cycle);
  return [turn](C s) { return std::exp(-turn * s); };
}

TransferFunction FilterOf(const SharedEffect& filter, double cycle_hz) {
  const auto response = filter.effect->ChangesFlameInput() ? &Effect::FlameIn : &Effect::FlameOut;
  return [filter, cycle_hz, response](C s) {
    return ((*filter.effect).*response)(s.imag() * cycle_hz, {}, filter.values);
  };
}

// The factor of what drives the flame, or of what it answers, at the cycle, whose turn is taken
// back.
C FactorAtCycle(const SharedEffect& shared, double cycle_hz) {
  constexpr C kCycle(0.0, 1.0);
  switch (StageOf(*shared.effect)) {
    case Stage::kFlame:
      return FilterOf(shared, cycle_hz)(kCycle);
    case Stage::kPressure:
      return 1.0 / PressureInstrumentOf(shared, cycle_hz)(kCycle);
    case Stage::kLeak:
    case Stage::kHeatRelease:
      break;
  }
  return 1.0;
}

FlameFilters FiltersOf(const SharedEffect& filter, double cycle_hz) {
  const TransferFunction turned = [plain = FilterOf(filter, cycle_hz),
                                   back = TurnBack(FactorAtCycle(filter, cycle_hz))](C s) {
    return plain(s) * back(s);
  };
  return filter.effect->ChangesFlameInput() ? FlameFilters{turned, nullptr}
                                            : FlameFilters{nullptr, turned};
}

void TakeLeak(const SharedEffect& shared, RecordSpectra* record) {
  for (Eigen::Index i = 0; i < record->edge_s.size(); ++i) {
    const double hz = record->edge_s[i].imag() * record->scale.cycle_hz;
    record->heat_release[i] -= LeakOf(shared, hz) * record->pressure[i];
  }
}

void TakeHeatReleaseInstrument(const SharedEffect& shared, RecordSpectra* record) {
  const TransferFunction instrument = HeatReleaseInstrumentOf(shared, record->scale.cycle_hz);
  record->heat_release = record->heat_release.cwiseQuotient(record->edge_s.unaryExpr(instrument));
  record->heat_release_instrument = Product(record->heat_release_instrument, instrument);
}

void Take(const SharedEffect& shared, Stage stage, RecordSpectra* record) {
  const double cycle_hz = record->scale.cycle_hz;
  switch (stage) {
    case Stage::kFlame:
      *record = WithFilters(std::move(*record), FiltersOf(shared, cycle_hz));
      return;
    case Stage::kPressure: {
      const TransferFunction instrument = PressureInstrumentOf(shared, cycle_hz);
      const FlameFilters back = {TurnBack(FactorAtCycle(shared, cycle_hz)), nullptr};
      *record = WithoutPressureInstrument(std::move(*record), instrument, back);
      return;
    }
    case Stage::kLeak:
    case Stage::kHeatRelease:
      break;
  }
  const auto take = stage == Stage::kLeak ? TakeLeak : TakeHeatReleaseInstrument;
  take(shared, record);
  if (record->middle) {
    RecordSpectra middle = *record->middle;
    take(shared, &middle);
    record->middle = std::make_shared<const RecordSpectra>(std::move(middle));
  }
}

double LogJacobianOf(const RecordSpectra& record, const TransferFunction& instrument) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < record.bins(); ++i) {
    sum -= record.share[i] * std::log(std::norm(instrument(record.s[i])));
  }
  return sum;
}

}  // namespace

// A path or a spread behind the curve is each point's own (loop_point.h), and a change of the whole
// delay is no filter.
bool IsFlameFilter(const Effect& effect) {
  if (effect.kind() != EffectKind::kTransfer) return false;
  return effect.block() == LoopBlock::kFlame ||
         (effect.block() == LoopBlock::kDelay && effect.ChangesFlameInput());
}

std::vector<EffectPointer> SharedEffects() {
  std::vector<EffectPointer> out;
  for (const EffectPointer& effect : Catalogue()) {
    const bool transfer = effect->kind() == EffectKind::kTransfer;
    const bool of_p = transfer && effect->block() == LoopBlock::kPressureInstrument;
    const bool of_q = transfer && effect->block() == LoopBlock::kHeatReleaseInstrument &&
                      effect->parameters().size() == 1;
    // Relative to the mean of all points a leak is the same thing in other units.
    const bool again = effect->form().key == "range" && effect->form().value != "own";
    if (of_p || (of_q && !again)) out.push_back(effect);
    if (IsFlameFilter(*effect)) out.push_back(effect);
  }
  return out;
}

RecordSpectra RecordBeside(RecordSpectra record, const std::vector<SharedEffect>& effects) {
  for (const Stage stage : kStages) {
    for (const SharedEffect& each : InStage(effects, stage)) Take(each, stage, &record);
  }
  return record;
}

Eigen::VectorXd PressureAsRecorded(const RecordSpectra& record,
                                   const std::vector<SharedEffect>& effects,
                                   Eigen::VectorXd noise) {
  const double bin = record.bin_hz / record.scale.cycle_hz;
  for (const SharedEffect& each : InStage(effects, Stage::kPressure)) {
    const TransferFunction instrument = PressureInstrumentOf(each, record.scale.cycle_hz);
    const Eigen::Index samples = noise.size();
    Eigen::VectorXcd spectrum = UnitarySpectrum(noise);
    for (Eigen::Index k = 0; k < spectrum.size(); ++k) {
      spectrum[k] *= instrument(C(0.0, bin * static_cast<double>(k)));
    }
    noise = UnitarySignal(std::move(spectrum), samples);
  }
  return noise;
}

Eigen::Matrix2cd ByRecorded(const std::vector<SharedEffect>& effects, double cycle_hz, C s) {
  Eigen::Matrix2cd out = Eigen::Matrix2cd::Identity();
  for (const SharedEffect& each : InStage(effects, Stage::kLeak)) {
    out(1, 0) -= LeakOf(each, s.imag() * cycle_hz);
  }
  for (const SharedEffect& each : InStage(effects, Stage::kPressure)) {
    out.row(0) /= PressureInstrumentOf(each, cycle_hz)(s);
  }
  for (const SharedEffect& each : InStage(effects, Stage::kHeatRelease)) {
    out.row(1) /= HeatReleaseInstrumentOf(each, cycle_hz)(s);
  }
  return out;
}

double LogJacobian(const RecordSpectra& record, const std::vector<SharedEffect>& effects) {
  double sum = 0.0;
  for (const SharedEffect& each : InStage(effects, Stage::kPressure)) {
    sum += LogJacobianOf(record, PressureInstrumentOf(each, record.scale.cycle_hz));
  }
  for (const SharedEffect& each : InStage(effects, Stage::kHeatRelease)) {
    sum += LogJacobianOf(record, HeatReleaseInstrumentOf(each, record.scale.cycle_hz));
  }
  return sum;
}

double TurnOfCycle(const std::vector<SharedEffect>& effects, double cycle_hz) {
  double turn = 0.0;
  for (const SharedEffect& each : effects) {
    if (!IsAtNull(each)) turn -= std::arg(FactorAtCycle(each, cycle_hz));
  }
  return turn;
}

}  // namespace howl

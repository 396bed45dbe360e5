#include "model/effects/combined.h"

#include <glog/logging.h>

#include <memory>
#include <utility>
#include <vector>

namespace howl {
namespace {

std::vector<EffectParameter> Both(const Effect& first, const Effect& second) {
  std::vector<EffectParameter> all;
  for (const Effect* effect : {&first, &second}) {
    for (EffectParameter parameter : effect->parameters()) {
      parameter.name = std::string(effect->id()) + "." + parameter.name;
      all.push_back(std::move(parameter));
    }
  }
  return all;
}

class Combined final : public NamedEffect {
 public:
  Combined(EffectPointer first, EffectPointer second)
      : NamedEffect(CombinedId(first->id(), second->id()), first->block(), Both(*first, *second)),
        first_(std::move(first)),
        second_(std::move(second)) {}

  bool ChangesAcousticCut() const override {
    return first_->ChangesAcousticCut() || second_->ChangesAcousticCut();
  }
  bool ChangesFlameCut() const override {
    return first_->ChangesFlameCut() || second_->ChangesFlameCut();
  }
  bool ChangesFlameInput() const override {
    return first_->ChangesFlameInput() || second_->ChangesFlameInput();
  }
  bool ModulatesAcoustics() const override {
    return first_->ModulatesAcoustics() || second_->ModulatesAcoustics();
  }
  bool ModulatesDelay() const override {
    return first_->ModulatesDelay() || second_->ModulatesDelay();
  }
  Response Acoustics(const howl::Acoustics<double>& acoustics, double frequency_hz,
                     const EffectContext& at, EffectValues x) const override {
    return first_->Acoustics(acoustics, frequency_hz, at, First(x)) +
           second_->Acoustics(acoustics, frequency_hz, at, Second(x)) -
           Effect::Acoustics(acoustics, frequency_hz, at, x);
  }
  Response PressureInstrument(double frequency_hz, EffectValues x) const override {
    return first_->PressureInstrument(frequency_hz, First(x)) *
           second_->PressureInstrument(frequency_hz, Second(x));
  }
  Response HeatReleaseInstrument(double frequency_hz, EffectValues x) const override {
    return first_->HeatReleaseInstrument(frequency_hz, First(x)) *
           second_->HeatReleaseInstrument(frequency_hz, Second(x));
  }
  Response PressureLeak(double frequency_hz, const EffectContext& at,
                        EffectValues x) const override {
    return first_->PressureLeak(frequency_hz, at, First(x)) +
           second_->PressureLeak(frequency_hz, at, Second(x));
  }
  Response FlameIn(double frequency_hz, const EffectContext& at, EffectValues x) const override {
    return first_->FlameIn(frequency_hz, at, First(x)) *
           second_->FlameIn(frequency_hz, at, Second(x));
  }
  bool IsOwnCause(EffectValues x) const override {
    return first_->IsOwnCause(First(x)) && second_->IsOwnCause(Second(x));
  }
  std::vector<double> ModeRatios(EffectValues x) const override {
    std::vector<double> ratios = first_->ModeRatios(First(x));
    for (const double ratio : second_->ModeRatios(Second(x))) ratios.push_back(ratio);
    return ratios;
  }
  Response FlameOut(double frequency_hz, const EffectContext& at, EffectValues x) const override {
    return first_->FlameOut(frequency_hz, at, First(x)) *
           second_->FlameOut(frequency_hz, at, Second(x));
  }
  double DelayFactor(const EffectContext& at, EffectValues x) const override {
    return first_->DelayFactor(at, First(x)) * second_->DelayFactor(at, Second(x));
  }
  double DelayPerAmplitude(EffectValues x) const override {
    return first_->DelayPerAmplitude(First(x)) + second_->DelayPerAmplitude(Second(x));
  }
  // Of two that look at an amplitude, the first's.
  std::optional<AmplitudeSense> DelaySense(EffectValues x) const override {
    const auto first = first_->DelaySense(First(x));
    return first ? first : second_->DelaySense(Second(x));
  }
  std::optional<AmplitudeSense> AcousticSense(EffectValues x) const override {
    const auto first = first_->AcousticSense(First(x));
    return first ? first : second_->AcousticSense(Second(x));
  }
  void ModulateAcoustics(double position, double amplitude, EffectValues x, double* omega_factor,
                         double* xi_add) const override {
    first_->ModulateAcoustics(position, amplitude, First(x), omega_factor, xi_add);
    second_->ModulateAcoustics(position, amplitude, Second(x), omega_factor, xi_add);
  }

 private:
  EffectValues First(EffectValues x) const { return x.first(first_->parameters().size()); }
  EffectValues Second(EffectValues x) const { return x.subspan(first_->parameters().size()); }

  EffectPointer first_;
  EffectPointer second_;
};

}  // namespace

std::string CombinedId(std::string_view first, std::string_view second) {
  return std::string(first) + "+" + std::string(second);
}

EffectPointer Combine(const EffectPointer& first, const EffectPointer& second) {
  CHECK(first->kind() == EffectKind::kTransfer && second->kind() == EffectKind::kTransfer);
  return std::make_shared<Combined>(first, second);
}

}  // namespace howl

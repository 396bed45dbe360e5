#include "model/simulation/noise_source.h"

#include <glog/logging.h>

#include <memory>

#include "model/loop/instrument.h"
#include "model/loop/loop_effect.h"

namespace howl {
namespace {

class NoiseInLoop final : public LoopEffect {
 public:
  explicit NoiseInLoop(const NoiseSource& source) : source_(source) {}
  std::unique_ptr<LoopEffect> Clone() const override {
    return std::make_unique<NoiseInLoop>(source_);
  }
  void Start(const RigParameters& /*rig*/, double step_s, std::uint64_t seed) override {
    process_ = NoiseProcess(source_.spectrum, source_.heat_release_std, 1.0 / step_s, seed);
  }
  void Source(const LoopContext& /*at*/, std::span<double> heat_release) override {
    if (source_.place == NoisePlace::kCombustion) process_.AddTo(heat_release);
  }
  bool Drives() const override { return source_.place == NoisePlace::kDuct; }
  void Drive(const LoopContext& /*at*/, std::span<double> drive) override { process_.AddTo(drive); }

 private:
  NoiseSource source_;
  NoiseProcess process_;
};

class NoiseOnRecord final : public Instrument {
 public:
  explicit NoiseOnRecord(const NoiseSource& source) : source_(source) {}
  std::unique_ptr<Instrument> Clone() const override {
    return std::make_unique<NoiseOnRecord>(source_);
  }
  void Start(double rate_hz, std::uint64_t seed) override {
    process_ = NoiseProcess(source_.spectrum, 1.0, rate_hz, seed);
  }
  void Apply(double /*time_s*/, std::span<double> pressure,
             std::span<double> heat_release) override {
    for (std::size_t i = 0; i < pressure.size(); ++i) {
      const double noise = process_.Next();
      if (source_.pressure_std != 0.0) pressure[i] += source_.pressure_std * noise;
      if (source_.heat_release_std != 0.0) heat_release[i] += source_.heat_release_std * noise;
    }
  }

 private:
  NoiseSource source_;
  NoiseProcess process_;
};

}  // namespace

void AddNoiseSource(const NoiseSource& source, RigParameters* rig) {
  if (source.pressure_std == 0.0 && source.heat_release_std == 0.0) return;
  if (source.place == NoisePlace::kCombustion || source.place == NoisePlace::kDuct) {
    CHECK(source.spectrum.colour != NoiseColour::kWhite) << "white noise in the loop";
    rig->effects.push_back(std::make_shared<NoiseInLoop>(source));
  } else {
    rig->digitisers.push_back(std::make_shared<NoiseOnRecord>(source));
  }
}

}  // namespace howl

// An effect: a nested extension of the base loop, and a candidate cause of the gap between model
// and rig. With every parameter at its null it is bit for bit the base.
//
// The base, and the places where an effect can act (s = j 2 pi f; true signals p, q; recorded
// signals p_r, q_r):
//
//   p   = G q                                 Acoustics, ModulateAcoustics
//   v   = FlameIn s e^(-tau s) p              FlameIn, DelayFactor, DelayPerAmplitude
//   q   = FlameOut Phi(v) + n                 FlameOut
//   p_r = PressureInstrument p                PressureInstrument
//   q_r = HeatReleaseInstrument q + leak p_r  HeatReleaseInstrument, PressureLeak
//
// Effects that are no transfer function of this kind (clipping, quantisation, coherent lines, a
// fluctuating gain) say so by kind(); they are found by estimators of their own.
//
// Frequencies in Hz; parameters in the units that EffectParameter names.
#ifndef HOWL_MODEL_EFFECTS_EFFECT_H_
#define HOWL_MODEL_EFFECTS_EFFECT_H_

#include <complex>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/loop/acoustics.h"

namespace howl {

enum class LoopBlock : std::uint8_t {
  kAcoustics,
  kFlame,
  kDelay,
  kSource,
  kPressureInstrument,
  kHeatReleaseInstrument,
  kOperatingPoint
};

std::string_view LoopBlockName(LoopBlock block);

// How the effect is recognised in records.
enum class EffectKind : std::uint8_t {
  kTransfer,       // a transfer function or a slow modulation: fitted
  kColouredGain,   // the flame's gain fluctuates as coloured noise does
  kSwitchingGain,  // or between two levels
  kHum,            // coherent lines of the mains in a recorded signal
  kTone,           // a coherent line of a source, no harmonic of the cycle
  kClipping,       // a recorded signal saturates
  kQuantisation,   // a recorded signal has few levels
  kDeclaredMap,    // declared_effect.h: a static map of a recorded signal
  kDeclaredLine    // and a coherent line between two frequencies
};

// One estimator finds both of these kinds, and says which of the two it is.
inline bool IsGainKind(EffectKind kind) {
  return kind == EffectKind::kColouredGain || kind == EffectKind::kSwitchingGain;
}
inline bool IsLineKind(EffectKind kind) {
  return kind == EffectKind::kHum || kind == EffectKind::kTone;
}

// The further measurement that best separates an effect from those like it.
enum class Separation : std::uint8_t {
  kOperatingPoint,   // another one, far away
  kHighFrequencies,  // the flame's response above three times the cycle
  kCycleAmplitude,   // a weaker cycle
  kLongRecord        // the statistics of the slow envelope
};

enum class ParameterScale : std::uint8_t { kLinear, kLogarithmic };

struct EffectParameter {
  std::string name;
  std::string unit;
  double null_value = 0.0;  // may be infinite
  double low = 0.0;         // the search's bounds
  double high = 0.0;
  std::vector<double> starts;  // of the search
  ParameterScale scale = ParameterScale::kLinear;
  // Values at which a weak effect is looked for, to first order in the parameter after this one.
  std::vector<double> scan = {};
};

// What an effect may know of an experiment.
struct EffectContext {
  double phi_position = 0.0;        // operating parameter, -1/2 ... 1/2 over the experiments
  double cycle_frequency_hz = 0.0;  // of this experiment
  double relative_amplitude = 1.0;  // of this experiment's cycle, 1 in the mean of all
  // Amplitude of q over that of p at the cycle, in the mean of all experiments.
  double heat_release_over_pressure = 1.0;
  double own_heat_release_over_pressure = 1.0;  // of this experiment
  double relative_rate_amplitude = 1.0;         // of p' at the cycle, 1 in the mean of all
};

// The slow amplitude that an effect feels: the root of twice the mean square of p, or of p', over
// the recent past. The mean is taken by `lags` equal first-order lags, 1 / (1 + s memory / lags).
struct AmplitudeSense {
  double memory_s = 0.02;
  int lags = 1;
  bool of_rate = false;
  bool over_own = false;  // over the experiment's own cycle, not the mean of all
};

struct RigParameters;

// What a simulated effect's parameters are relative to.
struct SimulationScale {
  EffectContext at;
  double pressure_amplitude = 1.0;      // of this experiment's cycle, without the effect
  double heat_release_amplitude = 1.0;  // of this experiment's cycle, without the effect
  double mean_pressure_amplitude = 1.0;
  double mean_rate_amplitude = 1.0;  // of p'
  double duration_s = 1.0;
};

// One of an effect's forms, as configs tell it: "order" "2". Empty where there is one form.
struct EffectForm {
  std::string key;
  std::string value;
};

using EffectValues = std::span<const double>;
using Response = std::complex<double>;

class Effect {
 public:
  virtual ~Effect() = default;

  virtual std::string_view id() const = 0;
  virtual LoopBlock block() const = 0;
  virtual const std::vector<EffectParameter>& parameters() const = 0;
  virtual EffectKind kind() const { return EffectKind::kTransfer; }
  virtual Separation SeparatedBy() const { return Separation::kOperatingPoint; }

  // Which cuts of the loop it changes: p from q (acoustics), q from p (delay and flame).
  virtual bool ChangesAcousticCut() const { return false; }
  virtual bool ChangesFlameCut() const { return false; }
  // True if the wave form at the flame changes by more than a delay.
  virtual bool ChangesFlameInput() const { return false; }
  virtual bool ModulatesAcoustics() const { return false; }
  virtual bool ModulatesDelay() const { return false; }

  virtual EffectForm form() const { return {}; }

  // Whether ranges and starts in Hz and s were made for the cycles of the paper's rig, and go with
  // those of another; else they are as its user has stated them.
  virtual bool RangesGoWithCycle() const { return true; }

  // Frequencies over omega of modes that it adds: one of them may carry an experiment's cycle.
  virtual std::vector<double> ModeRatios(EffectValues /*x*/) const { return {}; }

  // False where these values are no cause of their own, but a sign that the base's form is wrong.
  virtual bool IsOwnCause(EffectValues /*x*/) const { return true; }

  // Puts the effect into a rig that is to be simulated. False: it has no form in time. At the null
  // the record keeps every bit.
  virtual bool AddTo(const SimulationScale& /*scale*/, EffectValues /*x*/,
                     RigParameters* /*rig*/) const {
    return false;
  }
  // Why it cannot be put there with these values; empty if it can.
  virtual std::string SimulationFault(const RigParameters& /*rig*/, EffectValues /*x*/) const {
    return "";
  }

  virtual Response Acoustics(const howl::Acoustics<double>& acoustics, double frequency_hz,
                             const EffectContext& /*at*/, EffectValues /*x*/) const {
    const Complex<double> g = AcousticResponse(acoustics, frequency_hz);
    return {g.re, g.im};
  }
  virtual Response PressureInstrument(double /*frequency_hz*/, EffectValues /*x*/) const {
    return 1.0;
  }
  virtual Response HeatReleaseInstrument(double /*frequency_hz*/, EffectValues /*x*/) const {
    return 1.0;
  }
  virtual Response PressureLeak(double /*frequency_hz*/, const EffectContext& /*at*/,
                                EffectValues /*x*/) const {
    return 0.0;
  }
  virtual Response FlameIn(double /*frequency_hz*/, const EffectContext& /*at*/,
                           EffectValues /*x*/) const {
    return 1.0;
  }
  virtual Response FlameOut(double /*frequency_hz*/, const EffectContext& /*at*/,
                            EffectValues /*x*/) const {
    return 1.0;
  }
  // tau of the experiment over the shared tau.
  virtual double DelayFactor(const EffectContext& /*at*/, EffectValues /*x*/) const { return 1.0; }
  // d tau / d(amplitude relative to the mean of all experiments), as a fraction of tau.
  virtual double DelayPerAmplitude(EffectValues /*x*/) const { return 0.0; }
  // The amplitude by which it moves the delay, or the acoustics; none if it does not look at one.
  virtual std::optional<AmplitudeSense> DelaySense(EffectValues /*x*/) const { return {}; }
  virtual std::optional<AmplitudeSense> AcousticSense(EffectValues /*x*/) const { return {}; }
  // Slow changes: position in the record -1/2 ... 1/2; amplitude relative to the mean of all
  // experiments' cycles. The frequencies are multiplied, the damping is added.
  virtual void ModulateAcoustics(double /*position*/, double /*amplitude*/, EffectValues /*x*/,
                                 double* /*omega_factor*/, double* /*xi_add*/) const {}

 protected:
  Effect() = default;
  Effect(const Effect&) = default;
  Effect& operator=(const Effect&) = default;
};

using EffectPointer = std::shared_ptr<const Effect>;

// An identifier and a table of parameters: what all effects of the catalogue share.
class NamedEffect : public Effect {
 public:
  std::string_view id() const override { return id_; }
  LoopBlock block() const override { return block_; }
  const std::vector<EffectParameter>& parameters() const override { return parameters_; }

 protected:
  NamedEffect(std::string id, LoopBlock block, std::vector<EffectParameter> parameters)
      : id_(std::move(id)), block_(block), parameters_(std::move(parameters)) {}

 private:
  std::string id_;
  LoopBlock block_;
  std::vector<EffectParameter> parameters_;
};

// The effect's nulls, in the order of its parameters.
std::vector<double> NullValues(const Effect& effect);

// j 2 pi f
inline Response LaplaceVariable(double frequency_hz) { return {0.0, kRadPerSPerHz * frequency_hz}; }

}  // namespace howl

#endif  // HOWL_MODEL_EFFECTS_EFFECT_H_

// What lies between true and recorded signals. An instrument sees both channels, since some mix
// them (crosstalk) or act on one (a filter), in blocks of consecutive samples at one rate, and
// keeps its state from block to block. At its null value it leaves every bit alone.
//
// Filters are discretised exactly for a signal that is linear between samples.
#ifndef HOWL_MODEL_LOOP_INSTRUMENT_H_
#define HOWL_MODEL_LOOP_INSTRUMENT_H_

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace howl {

enum class Channel : std::uint8_t { kPressure, kHeatRelease };

class Instrument {
 public:
  virtual ~Instrument() = default;
  // Before the first block; `seed` is for instruments with randomness of their own.
  virtual void Start(double rate_hz, std::uint64_t seed) = 0;
  // time_s: of the first sample, from the start of the record.
  virtual void Apply(double time_s, std::span<double> pressure, std::span<double> heat_release) = 0;
  virtual std::unique_ptr<Instrument> Clone() const = 0;
};

// An instrument on one channel.
class ChannelInstrument : public Instrument {
 public:
  explicit ChannelInstrument(Channel channel) : channel_(channel) {}
  void Start(double /*rate_hz*/, std::uint64_t /*seed*/) override {}
  void Apply(double time_s, std::span<double> pressure, std::span<double> heat_release) final {
    ApplyToChannel(time_s, channel_ == Channel::kPressure ? pressure : heat_release);
  }

 protected:
  virtual void ApplyToChannel(double time_s, std::span<double> signal) = 0;

 private:
  Channel channel_;
};

// x -> gain x
class GainInstrument final : public ChannelInstrument {
 public:
  GainInstrument(Channel channel, double gain) : ChannelInstrument(channel), gain_(gain) {}
  std::unique_ptr<Instrument> Clone() const override;

 protected:
  void ApplyToChannel(double time_s, std::span<double> signal) override;

 private:
  double gain_;
};

// x -> min(max(x, -limit), limit)
class ClippingInstrument final : public ChannelInstrument {
 public:
  ClippingInstrument(Channel channel, double limit) : ChannelInstrument(channel), limit_(limit) {}
  std::unique_ptr<Instrument> Clone() const override;

 protected:
  void ApplyToChannel(double time_s, std::span<double> signal) override;

 private:
  double limit_;
};

// First order: H(s) = 1 / (1 + s / w_c), w_c = 2 pi cutoff_hz. Null: an infinite cut-off.
class FirstOrderLowPass final : public ChannelInstrument {
 public:
  FirstOrderLowPass(Channel channel, double cutoff_hz)
      : ChannelInstrument(channel), cutoff_hz_(cutoff_hz) {}
  void Start(double rate_hz, std::uint64_t seed) override;
  std::unique_ptr<Instrument> Clone() const override;

 protected:
  void ApplyToChannel(double time_s, std::span<double> signal) override;

 private:
  double cutoff_hz_;
  double decay_ = 0.0;  // y' = decay y + before x + after x'
  double weight_before_ = 0.0;
  double weight_after_ = 0.0;
  double input_ = 0.0;
  double output_ = 0.0;
  bool first_ = true;
};

// First order: H(s) = s / (s + w_c), what a low-pass leaves. Null: a cut-off of zero.
class FirstOrderHighPass final : public ChannelInstrument {
 public:
  FirstOrderHighPass(Channel channel, double cutoff_hz)
      : ChannelInstrument(channel), cutoff_hz_(cutoff_hz), slow_(channel, cutoff_hz) {}
  void Start(double rate_hz, std::uint64_t seed) override;
  std::unique_ptr<Instrument> Clone() const override;

 protected:
  void ApplyToChannel(double time_s, std::span<double> signal) override;

 private:
  double cutoff_hz_;
  FirstOrderLowPass slow_;
  std::vector<double> slow_signal_;
};

// Second order: H(s) = w0^2 / (s^2 + 2 zeta w0 s + w0^2). zeta of 1 / sqrt(2) is Butterworth's
// low-pass, a small zeta a transducer's resonance. Null: an infinite frequency.
class SecondOrderResponse final : public ChannelInstrument {
 public:
  SecondOrderResponse(Channel channel, double frequency_hz, double zeta)
      : ChannelInstrument(channel), frequency_hz_(frequency_hz), zeta_(zeta) {}
  void Start(double rate_hz, std::uint64_t seed) override;
  std::unique_ptr<Instrument> Clone() const override;

 protected:
  void ApplyToChannel(double time_s, std::span<double> signal) override;

 private:
  double frequency_hz_;
  double zeta_;
  double e_[4] = {};
  double before_[2] = {};
  double after_[2] = {};
  double state_[2] = {};  // output, its rate / w0
  double input_ = 0.0;
  bool first_ = true;
};

}  // namespace howl

#endif  // HOWL_MODEL_LOOP_INSTRUMENT_H_

// Random numbers for simulated records: one stream for each member of a batch and each use, so
// that neither the number of threads, nor the company in a batch, nor another source of noise
// changes a draw.
//
// xoshiro256++ (Blackman & Vigna 2021), its state filled by SplitMix64 from a hash of the member's
// seed and the stream's number. Normal deviates are Boost.Random's (ziggurat).
#ifndef HOWL_MODEL_NOISE_RANDOM_STREAM_H_
#define HOWL_MODEL_NOISE_RANDOM_STREAM_H_

#include <array>
#include <bit>
#include <boost/random/normal_distribution.hpp>
#include <cstdint>
#include <limits>

#include "model/noise/split_mix.h"

namespace howl {

// A seed of its own for the unit of work `key` of a run.
inline std::uint64_t DeriveSeed(std::uint64_t seed, std::uint64_t key) {
  std::uint64_t state = seed;
  std::uint64_t mixed = SplitMix64(&state) ^ (key * 0xd1342543de82ef95u);
  return SplitMix64(&mixed);
}

class RandomStream {
 public:
  using result_type = std::uint64_t;

  explicit RandomStream(std::uint64_t seed) {
    for (std::uint64_t& word : state_) word = SplitMix64(&seed);
  }

  static constexpr result_type min() { return 0; }
  static constexpr result_type max() { return std::numeric_limits<result_type>::max(); }

  result_type operator()() {
    const result_type result = std::rotl(state_[0] + state_[3], 23) + state_[0];
    const result_type shifted = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= shifted;
    state_[3] = std::rotl(state_[3], 45);
    return result;
  }

  double Normal() { return normal_(*this); }
  double Uniform() { return static_cast<double>((*this)() >> 11) * 0x1p-53; }  // [0, 1)

 private:
  std::array<std::uint64_t, 4> state_{};
  boost::random::normal_distribution<double> normal_;
};

}  // namespace howl

#endif  // HOWL_MODEL_NOISE_RANDOM_STREAM_H_

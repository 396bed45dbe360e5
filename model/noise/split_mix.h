// SplitMix64 (Steele, Lea, Flood 2014): its step, and its finaliser, in which every input bit
// reaches every output bit.
#ifndef HOWL_MODEL_NOISE_SPLIT_MIX_H_
#define HOWL_MODEL_NOISE_SPLIT_MIX_H_

#include <cstdint>

namespace howl {

inline constexpr std::uint64_t kSplitMixStep = 0x9e3779b97f4a7c15u;

constexpr std::uint64_t FinaliseBits(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

constexpr std::uint64_t SplitMix64(std::uint64_t* state) {
  return FinaliseBits(*state += kSplitMixStep);
}

}  // namespace howl

#endif  // HOWL_MODEL_NOISE_SPLIT_MIX_H_

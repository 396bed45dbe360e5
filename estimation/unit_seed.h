// Every independent unit of work (a start, a member, a bootstrap replicate) draws from a generator
// of its own, seeded by the run's seed and the unit's key. Therefore the answer does not depend on
// how units are spread over threads.
#ifndef HOWL_ESTIMATION_UNIT_SEED_H_
#define HOWL_ESTIMATION_UNIT_SEED_H_

#include <cstdint>
#include <string_view>

#include "model/noise/split_mix.h"

namespace howl {

constexpr std::uint64_t MixBits(std::uint64_t x) { return FinaliseBits(x + kSplitMixStep); }

constexpr std::uint64_t UnitSeed(std::uint64_t run_seed, std::string_view key,
                                 std::uint64_t index = 0) {
  std::uint64_t hash = 0xcbf29ce484222325u;  // FNV-1a
  for (const char c : key) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return MixBits(MixBits(run_seed ^ hash) + index);
}

}  // namespace howl

#endif  // HOWL_ESTIMATION_UNIT_SEED_H_

// A small generator whose stream depends on a seed and a unit's key alone, so that units of work
// draw the same whatever thread takes them.
#ifndef HOWL_ESTIMATION_FAMILY_PROBLEM_RANDOM_H_
#define HOWL_ESTIMATION_FAMILY_PROBLEM_RANDOM_H_

#include <cmath>
#include <cstdint>

#include "estimation/family/problem/problem.h"
#include "estimation/unit_seed.h"

namespace howl {

class UnitRandom {
 public:
  UnitRandom(std::uint64_t seed, std::uint64_t key)
      : state_(FinaliseBits(FinaliseBits(seed) ^ (key * kSplitMixStep))) {}

  std::uint64_t Next() { return FinaliseBits(state_ += kSplitMixStep); }
  // In (0, 1).
  double Uniform() { return (static_cast<double>(Next() >> 11) + 0.5) * 0x1p-53; }
  double Uniform(const Range& range) { return range.lo + (range.hi - range.lo) * Uniform(); }
  double LogUniform(const Range& range) {
    return range.lo * std::exp(std::log(range.hi / range.lo) * Uniform());
  }
  std::size_t Index(std::size_t size) {
    return static_cast<std::size_t>(Uniform() * static_cast<double>(size));
  }
  double Exponential() { return -std::log(Uniform()); }
  double Normal() {
    return std::sqrt(2.0 * Exponential()) * std::cos(2.0 * std::numbers::pi * Uniform());
  }
  // As if that many numbers had been drawn.
  void Skip(std::uint64_t numbers) { state_ += numbers * kSplitMixStep; }
  std::uint64_t State() const { return state_; }
  void SetState(std::uint64_t state) { state_ = state; }

 private:
  std::uint64_t state_;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_PROBLEM_RANDOM_H_

// A small generator whose stream depends on a seed and a unit's key alone, so that units of work
// draw the same whatever thread takes them.
#ifndef HOWL_ESTIMATION_FAMILY_PROBLEM_RANDOM_H_
#define HOWL_ESTIMATION_FAMILY_PROBLEM_RANDOM_H_

#include <cmath>
#include <cstdint>

#include "estimation/family/problem/problem.h"

namespace howl {

class UnitRandom {
 public:
  UnitRandom(std::uint64_t seed, std::uint64_t key) : state_(Mix(Mix(seed) ^ (key * kStep))) {}

  // Splitmix64 (Steele, Lea, Flood 2014).
  std::uint64_t Next() { return Mix(state_ += kStep); }
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
  void Skip(std::uint64_t numbers) { state_ += numbers * kStep; }
  std::uint64_t State() const { return state_; }
  void SetState(std::uint64_t state) { state_ = state; }

 private:
  static constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15;
  static std::uint64_t Mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }
  std::uint64_t state_;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_PROBLEM_RANDOM_H_

// The simulator's inner loops over W members side by side ("lanes"; W = 1 or 8): data in rows
// [time][lane], so that with W = 8 a vector holds members and with W = 1 consecutive times.
// Each number comes out of the same operations in the same order whatever W is, and products and
// sums are never fused here, so that results agree to the last bit.
//
//   v_m = sum_j l_j p'_(m - D + j)          delayed rate, D = ceil(tau / h)
//   q_m = Q sigma(k (v_m - v0) / Q)         flame
//   x_(m+1) = E x_m + sum_j w_j q_(m + j)   each mode, j = -2 .. 3
//   p' = sum(-omega y - 2 omega xi p) + (N + M + ...) q
#ifndef HOWL_MODEL_SIMULATION_LANE_LOOP_H_
#define HOWL_MODEL_SIMULATION_LANE_LOOP_H_

#include <array>
#include <cstddef>
#include <vector>

#include "model/loop/flame.h"
#include "model/loop/loop_effect.h"
#include "model/loop/mode_step.h"

namespace howl::internal {

inline constexpr int kOrder = 6;
inline constexpr int kAhead = 3;  // heat release is known this many steps beyond the state
inline constexpr int kBehind = 2;
inline constexpr int kMaxModes = 4;
inline constexpr int kMinDelaySteps = kLoopBlock + 5;
inline constexpr int kMaxLanes = 8;

// What the scheme needs of one rig.
struct LaneCoefficients {
  std::array<ModeStep<kOrder>, kMaxModes> steps{};
  std::array<double, kMaxModes> omega_rad_s{};
  std::array<double, kMaxModes> damping_rad_s{};  // 2 omega xi
  double direct = 0.0;                            // N + M + ...
  int delay_steps = 0;
  std::array<double, kOrder> delay_weights{};
  double flame_gain = 0.0;  // k / Q
  double flame_offset = 0.0;
  double saturation = 1.0;
};

struct DelaySteps {
  int steps;
  std::array<double, kOrder> weights;
};
// One place for this computation, so that a constant and a moving delay agree to the last bit.
DelaySteps SplitDelay(double tau_s, double step_s);

template <int W>
struct LaneBlock {
  static constexpr std::size_t kLanes = W;
  using Lane = std::array<double, kLanes>;

  int modes = 2;
  FlameShape shape = FlameShape::kTanh;
  // Coefficients by lane.
  alignas(64) std::array<std::array<Lane, 4>, kMaxModes> exponential{};
  alignas(64) std::array<std::array<Lane, kOrder>, kMaxModes> weight_y{};
  alignas(64) std::array<std::array<Lane, kOrder>, kMaxModes> weight_p{};
  alignas(64) std::array<Lane, kMaxModes> omega{};
  alignas(64) std::array<Lane, kMaxModes> damping{};
  alignas(64) std::array<Lane, kOrder> delay_weights{};
  alignas(64) Lane direct{};
  alignas(64) Lane flame_gain{};
  alignas(64) Lane flame_offset{};
  alignas(64) Lane saturation{};
  // States.
  alignas(64) std::array<Lane, kMaxModes> y{};
  alignas(64) std::array<Lane, kMaxModes> p{};
  // Scratch: the past as each lane needs it, the states over a block.
  alignas(64) std::array<double, (kLoopBlock + kOrder) * kLanes> window{};
  alignas(64) std::array<std::array<double, kLoopBlock * kLanes>, kMaxModes> path_y{};
  alignas(64) std::array<std::array<double, kLoopBlock * kLanes>, kMaxModes> path_p{};

  void Set(int lane, const LaneCoefficients& c);
};

// From window (count + 5 rows) to v (count rows).
void Interpolate(const LaneBlock<1>& block, int count, double* v);
void Interpolate(const LaneBlock<8>& block, int count, double* v);
// v in place to Phi(v).
void ApplyFlame(const LaneBlock<1>& block, int count, double* v);
void ApplyFlame(const LaneBlock<8>& block, int count, double* v);
// `count` steps. heat: first row is that of the step two before the present one; pressure and
// rate: rows of the steps after the present one.
void Propagate(LaneBlock<1>* block, int count, const double* heat, double* pressure, double* rate);
void Propagate(LaneBlock<8>* block, int count, const double* heat, double* pressure, double* rate);

// sum_i a_i b_i, for the anti-alias filter.
double DotProduct(const double* a, const double* b, std::size_t n);

}  // namespace howl::internal

#endif  // HOWL_MODEL_SIMULATION_LANE_LOOP_H_

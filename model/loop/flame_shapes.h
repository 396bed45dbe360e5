// The flame shapes that a measured curve is compared with, all of flame.h that saturate; and those
// that a config names, King's law among them.
#ifndef HOWL_MODEL_LOOP_FLAME_SHAPES_H_
#define HOWL_MODEL_LOOP_FLAME_SHAPES_H_

#include <array>
#include <cstddef>
#include <string_view>

#include "model/loop/flame.h"

namespace howl {

inline constexpr std::array kFlameShapes = {FlameShape::kTanh, FlameShape::kArctan,
                                            FlameShape::kCubic, FlameShape::kPiecewiseLinear,
                                            FlameShape::kAlgebraic};

inline constexpr std::array kStatedFlameShapes = {
    FlameShape::kTanh,      FlameShape::kArctan,
    FlameShape::kCubic,     FlameShape::kPiecewiseLinear,
    FlameShape::kAlgebraic, FlameShape::kSquareRoot};

// The name in configs.
constexpr std::string_view FlameShapeName(FlameShape shape) {
  constexpr std::array<std::string_view, kStatedFlameShapes.size()> kNames = {
      "tanh", "arctan", "cubic", "piecewise_linear", "algebraic", "square_root"};
  return kNames[static_cast<std::size_t>(shape)];
}

}  // namespace howl

#endif  // HOWL_MODEL_LOOP_FLAME_SHAPES_H_

// The flame shapes that a config names and that a measured curve is compared with: all of flame.h
// that saturate.
#ifndef HOWL_MODEL_FLAME_SHAPES_H_
#define HOWL_MODEL_FLAME_SHAPES_H_

#include <array>
#include <cstddef>
#include <string_view>

#include "model/flame.h"

namespace howl {

inline constexpr std::array kFlameShapes = {FlameShape::kTanh, FlameShape::kArctan,
                                            FlameShape::kCubic, FlameShape::kPiecewiseLinear,
                                            FlameShape::kAlgebraic};

// The name in configs.
constexpr std::string_view FlameShapeName(FlameShape shape) {
  constexpr std::array<std::string_view, kFlameShapes.size()> kNames = {
      "tanh", "arctan", "cubic", "piecewise_linear", "algebraic"};
  return kNames[static_cast<std::size_t>(shape)];
}

}  // namespace howl

#endif  // HOWL_MODEL_FLAME_SHAPES_H_

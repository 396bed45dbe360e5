// Reading a sampled signal between its samples: the polynomial through six neighbours, its value
// or its derivative. Order 6 and 5 in the grid's step.
#ifndef HOWL_RIG_DELAY_LINE_H_
#define HOWL_RIG_DELAY_LINE_H_

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace rig {

inline constexpr int kStencil = 6;

struct Stencil {
  std::ptrdiff_t first = 0;  // samples back in time of the first weight; the next ones go further
  std::array<double, kStencil> weight{};
};

// What stands `delay` samples back. The stencil never asks for the future.
inline Stencil ValueAt(double delay) {
  Stencil out;
  out.first = std::max<std::ptrdiff_t>(0, static_cast<std::ptrdiff_t>(std::floor(delay)) - 2);
  const double u = delay - static_cast<double>(out.first);
  for (int i = 0; i < kStencil; ++i) {
    double weight = 1.0;
    for (int j = 0; j < kStencil; ++j) {
      if (j != i) weight *= (u - j) / (i - j);
    }
    out.weight[static_cast<std::size_t>(i)] = weight;
  }
  return out;
}

// The derivative with respect to time, in units of 1 / step.
inline Stencil SlopeAt(double delay) {
  Stencil out;
  out.first = std::max<std::ptrdiff_t>(0, static_cast<std::ptrdiff_t>(std::floor(delay)) - 2);
  const double u = delay - static_cast<double>(out.first);
  for (int i = 0; i < kStencil; ++i) {
    double sum = 0.0;
    for (int k = 0; k < kStencil; ++k) {
      if (k == i) continue;
      double product = 1.0 / (i - k);
      for (int j = 0; j < kStencil; ++j) {
        if (j != i && j != k) product *= (u - j) / (i - j);
      }
      sum += product;
    }
    out.weight[static_cast<std::size_t>(i)] = -sum;  // delay grows against time
  }
  return out;
}

// A sum of delayed readings as one filter over the grid: taps[k] stands k samples back.
class Filter {
 public:
  void Clear() { taps_.assign(taps_.size(), 0.0); }
  void Add(const Stencil& stencil, double factor) {
    const auto end = static_cast<std::size_t>(stencil.first) + kStencil;
    if (taps_.size() < end) taps_.resize(end, 0.0);
    for (std::size_t i = 0; i < kStencil; ++i) {
      taps_[static_cast<std::size_t>(stencil.first) + i] += factor * stencil.weight[i];
    }
  }
  void AddTap(std::size_t back, double value) {
    if (taps_.size() <= back) taps_.resize(back + 1, 0.0);
    taps_[back] += value;
  }
  // Only what Finish() has seen is used; call it after the last Add.
  void Finish() {
    begin_ = 0;
    while (begin_ < taps_.size() && taps_[begin_] == 0.0) ++begin_;
    std::size_t end = taps_.size();
    while (end > begin_ && taps_[end - 1] == 0.0) --end;
    reversed_.assign(taps_.rend() - static_cast<std::ptrdiff_t>(end),
                     taps_.rend() - static_cast<std::ptrdiff_t>(begin_));
  }
  std::size_t reach() const { return begin_ + reversed_.size(); }
  // newest: the sample that stands no time back.
  double operator()(const double* newest) const {
    const double* x = newest - begin_ - reversed_.size() + 1;
    double a = 0.0;
    double b = 0.0;
    double c = 0.0;
    double d = 0.0;
    std::size_t i = 0;
    const std::size_t n = reversed_.size();
    for (; i + 4 <= n; i += 4) {
      a += reversed_[i] * x[i];
      b += reversed_[i + 1] * x[i + 1];
      c += reversed_[i + 2] * x[i + 2];
      d += reversed_[i + 3] * x[i + 3];
    }
    for (; i < n; ++i) a += reversed_[i] * x[i];
    return (a + b) + (c + d);
  }

 private:
  std::vector<double> taps_;
  std::vector<double> reversed_;
  std::size_t begin_ = 0;
};

}  // namespace rig

#endif  // HOWL_RIG_DELAY_LINE_H_

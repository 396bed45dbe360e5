#include "estimation/record_fit/growing_roots.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "estimation/record_fit/return_difference.h"

namespace howl {
namespace {

using C = std::complex<double>;

constexpr double kLowest = 1e-3;  // of the cycle's frequency
constexpr double kTurn = 0.5;     // radians that one step may turn
constexpr double kLongest = 0.1;  // step
constexpr int kDeepest = 24;      // halvings of a step

class ReturnDifference {
 public:
  ReturnDifference(const RecordSpectra& record, const LoopPoint& point)
      : record_(record), point_(point), slope_(record.slopes.dot(point.flame)) {}

  C At(double frequency) const {
    return 1.0 - slope_ * OpenLoop(record_, point_, C(0.0, frequency));
  }

  // By how much the phase rises from one frequency to another.
  double Turn(double low, C at_low, double high, C at_high, int depth) const {
    const double turn = std::arg(at_high / at_low);
    if (depth >= kDeepest) return turn;
    const double middle = 0.5 * (low + high);
    const C at_middle = At(middle);
    const double first = std::arg(at_middle / at_low);
    const double second = std::arg(at_high / at_middle);
    if (std::max(std::abs(first), std::abs(second)) < kTurn) return first + second;
    return Turn(low, at_low, middle, at_middle, depth + 1) +
           Turn(middle, at_middle, high, at_high, depth + 1);
  }

 private:
  const RecordSpectra& record_;
  const LoopPoint& point_;
  double slope_;
};

// So that no step passes over a resonance or over a turn of the delay unseen.
std::vector<double> Frequencies(const LoopPoint& point, double highest) {
  const double step = std::min(kLongest, kTurn / std::max(point.tau, kLowest));
  std::vector<double> out;
  for (double at = kLowest + step; at < highest; at += step) out.push_back(at);
  for (const LoopMode& mode : point.modes) {
    for (const double widths : {-8.0, -4.0, -2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 2.0, 4.0, 8.0}) {
      out.push_back(mode.omega * (1.0 + widths * mode.xi));
    }
  }
  std::erase_if(out, [&](double at) { return at <= kLowest || at >= highest; });
  out.push_back(highest);
  std::ranges::sort(out);
  return out;
}

}  // namespace

int GrowingRoots(const RecordSpectra& record, const LoopPoint& point) {
  const ReturnDifference difference(record, point);
  const std::vector<double> frequencies = Frequencies(point, std::abs(record.s[record.bins() - 1]));
  double low = kLowest;
  C at_low = difference.At(low);
  // A loop that integrates comes from the real axis by a quarter turn about the origin's pole.
  const bool integrates = std::abs(at_low.imag()) > std::abs(at_low.real());
  double rise = integrates ? -0.5 * std::numbers::pi : 0.0;
  for (const double high : frequencies) {
    const C at_high = difference.At(high);
    rise += difference.Turn(low, at_low, high, at_high, 0);
    low = high;
    at_low = at_high;
  }
  // Above the band the loop is taken to go on to the real axis the short way.
  rise -= std::arg(at_low.real() > 0.0 ? at_low : -at_low);
  return static_cast<int>(std::lround(-rise / std::numbers::pi));
}

}  // namespace howl

#include "estimation/record_fit/loop/beside_band.h"

#include <complex>

#include "estimation/record_fit/whittle/log_of_product.h"
#include "model/numerics/complex_products.h"

namespace howl {
namespace {

using C = std::complex<double>;

constexpr int kBelow = 16;   // points from zero to the band
constexpr int kAbove = 160;  // of the octave above it

double BinsEach(const RecordSpectra& record) {
  return 2.0 * record.share[0] * record.scale.cycle_hz / record.bin_hz;
}

// Calls `take` with each frequency beside the band and what it counts for: twice the weight of the
// bins that it stands for.
template <typename Take>
void ForEachBeside(const RecordSpectra& record, const Take& take) {
  const double lowest = std::abs(record.s[0]);
  const double below = lowest / kBelow;
  const double weight = BinsEach(record);
  for (int i = 0; i < kBelow; ++i) take(C(0.0, (i + 0.5) * below), weight * below);
  const double highest = std::abs(record.s[record.bins() - 1]);
  const double above = highest / kAbove;
  for (int i = 0; i < kAbove; ++i) take(C(0.0, highest + (i + 0.5) * above), weight * above);
}

}  // namespace

double BesideBand(const RecordSpectra& record, const LoopPoint& point, const LoopTail& tail) {
  const double slope = record.slopes.dot(point.flame);
  LogOfProduct squares;
  ForEachBeside(record, [&](C s, double weight) {
    squares.Multiply(std::norm(1.0 - slope * LoopAt(record, point, s).u), weight);
  });
  return BinsEach(record) * tail.Value().real() - 0.5 * squares.Sum();
}

LoopGradient BesideBandGradient(const RecordSpectra& record, const PointStructure& structure,
                                const LoopPoint& point, const LoopTail& tail) {
  const double slope = record.slopes.dot(point.flame);
  LoopGradient out{Eigen::VectorXd::Zero(structure.Flame())};
  LogOfProduct squares;
  ForEachBeside(record, [&](C s, double weight) {
    const LoopAt loop(record, point, s);
    const C d = 1.0 - slope * loop.u;
    squares.Multiply(std::norm(d), weight);
    out.Add(structure, point, slope, loop, weight * Reciprocal(d));
  });
  out.value = BinsEach(record) * tail.Value().real() - 0.5 * squares.Sum();
  const double bins = BinsEach(record);
  if (tail.u != 0.0) out.Add(structure, point, slope, tail.loop, bins * tail.ByLoop() / tail.u);
  if (tail.constant != 0.0) {
    const double by_constant = bins * tail.ByConstant().real();
    out.slope += by_constant / slope;
    const Eigen::Index residues = structure.Frequencies() + structure.Dampings();
    out.loop.segment(residues, structure.modes).array() += by_constant / SumOfResidues(point);
  }
  const C s = tail.loop.s;
  const auto by_path = [&](C by_log, C fall_by_log) {
    return bins * (tail.ByConstant() * by_log + tail.ByFall() * fall_by_log).real();
  };
  const PathFall fall = point.path.Fall(s);
  for (Eigen::Index i = 0; i < structure.Delays(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    out.loop[structure.Delay() + i] += by_path(tail.loop.slopes.by[k], fall.by[k]);
  }
  return out;
}

}  // namespace howl

#include "estimation/record_fit/loop/beside_band.h"

#include <cmath>
#include <complex>

#include "model/numerics/complex_products.h"
#include "model/numerics/log_of_one_and.h"

namespace howl {
namespace {

using C = std::complex<double>;

constexpr int kBelow = 16;   // intervals from zero to the band
constexpr int kAbove = 160;  // of the octave above it

double BinsEach(const RecordSpectra& record) {
  return 2.0 * record.share[0] * record.scale.cycle_hz / record.bin_hz;
}

// The mean of ln |z| from one point to another on the straight line between them, and its slopes.
// The values of ln |D| at single frequencies alone would be a sum without bound: a loop might come
// to rest where D vanishes at one of them.
struct MeanOfLog {
  MeanOfLog(C from, C to) {
    const C over = Reciprocal(from);
    const C w = Times(to - from, over);
    if (std::norm(w) < kSmallTurn * kSmallTurn) {
      value = 0.5 * std::log(std::norm(from)) + (w * (0.5 - w * (1.0 / 6.0 - w / 12.0))).real();
      by_from = Times(over, 0.5 - w * (1.0 / 6.0 - w * (1.0 / 12.0 - w / 20.0)));
      by_to = Times(over, 0.5 - w * (1.0 / 3.0 - w * (1.0 / 4.0 - w / 5.0)));
      return;
    }
    const C turn = LogOfOneAnd(w);
    const C of_line = Times(Times(1.0 + w, turn), Reciprocal(w)) - 1.0;
    const C over_line = Reciprocal(to - from);
    value = 0.5 * std::log(std::norm(from)) + of_line.real();
    by_from = Times(of_line, over_line);
    by_to = Times(turn - of_line, over_line);
  }

  double value;
  C by_from, by_to;

 private:
  static constexpr double kSmallTurn = 1e-3;
};

// Calls `take` with both ends of each interval of frequencies beside the band and what it counts
// for: twice the weight of the bins that it stands for. The first one is its middle alone, since D
// may have a pole at zero.
template <typename Take>
void ForEachBeside(const RecordSpectra& record, const LoopPoint& point, const Take& take) {
  const double weight = BinsEach(record);
  const auto intervals = [&](double from, double step, int count) {
    LoopAt before(record, point, C(0.0, from));
    for (int i = 1; i <= count; ++i) {
      const LoopAt after(record, point, C(0.0, from + i * step));
      take(before, after, weight * step);
      before = after;
    }
  };
  const double lowest = std::abs(record.s[0]);
  const double below = lowest / kBelow;
  const LoopAt first(record, point, C(0.0, 0.5 * below));
  take(first, first, weight * below);
  intervals(below, below, kBelow - 1);
  const double highest = std::abs(record.s[record.bins() - 1]);
  intervals(highest, highest / kAbove, kAbove);
}

}  // namespace

double BesideBand(const RecordSpectra& record, const LoopPoint& point, const LoopTail& tail) {
  const double slope = record.slopes.dot(point.flame);
  double sum = 0.0;
  ForEachBeside(record, point, [&](const LoopAt& from, const LoopAt& to, double weight) {
    sum += weight * MeanOfLog(1.0 - slope * from.u, 1.0 - slope * to.u).value;
  });
  return BinsEach(record) * tail.Value().real() - sum;
}

LoopGradient BesideBandGradient(const RecordSpectra& record, const PointStructure& structure,
                                const LoopPoint& point, const LoopTail& tail) {
  const double slope = record.slopes.dot(point.flame);
  LoopGradient out{Eigen::VectorXd::Zero(structure.Flame())};
  double sum = 0.0;
  ForEachBeside(record, point, [&](const LoopAt& from, const LoopAt& to, double weight) {
    const MeanOfLog mean(1.0 - slope * from.u, 1.0 - slope * to.u);
    sum += weight * mean.value;
    out.Add(structure, point, slope, from, weight * mean.by_from);
    out.Add(structure, point, slope, to, weight * mean.by_to);
  });
  out.value = BinsEach(record) * tail.Value().real() - sum;
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

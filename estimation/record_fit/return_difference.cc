#include "estimation/record_fit/return_difference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <numbers>

#include "model/numerics/complex_products.h"

namespace howl {
namespace {

using C = std::complex<double>;

// At s, D(s) V(s) and U: that times R.
struct LoopAt {
  LoopAt(const RecordSpectra& record, const LoopPoint& point, C at)
      : s(at),
        path(point.path.At(s) * FlameInputResponse(record.flame_input, s)),
        u(AcousticTransfer(point, s) * path) {}

  // Adds the real part of `by` times dU, by the acoustics' parameters, ln tau and ln rho.
  void AddSlopes(const PointStructure& structure, const LoopPoint& point, C by,
                 Eigen::VectorXd* out) const {
    AddAcousticSlopes(structure, point, s, by * path, out);
    (*out)[structure.Delay()] += (by * u * point.path.ByLogTau(s)).real();
    if (structure.Delays() < 2) return;
    (*out)[structure.Delay() + 1] += (by * u * point.path.ByLogRho(s)).real();
  }

  C s;
  C path;
  C u;
};

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

// By Bernoulli's numbers in -ln(1 - z), |z| < 1 (Lewin 1981, 1.1).
C Dilogarithm(C z) {
  constexpr std::array<double, 9> kBernoulli = {1.0 / 6.0,   -1.0 / 30.0,     1.0 / 42.0,
                                                -1.0 / 30.0, 5.0 / 66.0,      -691.0 / 2730.0,
                                                7.0 / 6.0,   -3617.0 / 510.0, 43867.0 / 798.0};
  const C u = -std::log(1.0 - z);
  C power = u;  // u^(2k + 1) / (2k + 1)!
  C out = u - 0.25 * u * u;
  for (std::size_t k = 0; k < kBernoulli.size(); ++k) {
    const double n = 2.0 * static_cast<double>(k) + 2.0;
    power *= u * u / (n * (n + 1.0));
    out += kBernoulli[k] * power;
  }
  return out;
}

double SumOfResidues(const LoopPoint& point) {
  double sum = 0.0;
  for (const LoopMode& mode : point.modes) sum += mode.a;
  return sum;
}

// All that is above, to infinity.
struct Tail {
  Tail(const RecordSpectra& record, const LoopPoint& point)
      : loop(record, point, 2.0 * record.s[record.bins() - 1]),
        u(record.slopes.dot(point.flame) * loop.u) {
    if (record.flame_input == FlameInput::kPressureRate) {
      constant = record.slopes.dot(point.flame) * SumOfResidues(point) * point.path.At(loop.s);
    }
    const double falls = record.flame_input == FlameInput::kVelocity ? 2.0 : 1.0;
    const C turns = C(0.0, -1.0) * point.path.BySlope(loop.s);
    of_constant = 1.0 / turns;
    of_rest = 1.0 / (falls / loop.s.imag() + turns);
  }

  bool Possible(const FlamePath& path) const {
    if (path.spread == DelaySpread::kGamma && !(path.rho < 1.0)) return false;
    return std::abs(u) < 1.0 && std::abs(constant) < 1.0;
  }
  C Value() const {
    return Dilogarithm(constant) * (of_constant - of_rest) + Dilogarithm(u) * of_rest;
  }
  // Of Value by ln K, by ln U, and by d ln D_tau / ds.
  C ByConstant() const { return -std::log(1.0 - constant) * (of_constant - of_rest); }
  C ByLoop() const { return -std::log(1.0 - u) * of_rest; }
  C BySlope() const {
    const C of = Dilogarithm(constant);
    return C(0.0, 1.0) *
           (of * of_constant * of_constant + (Dilogarithm(u) - of) * of_rest * of_rest);
  }

  LoopAt loop;
  C u;
  C constant;  // K
  C of_constant;
  C of_rest;
};

// -sum of 2 w ln |D| beside the band.
double Beside(const RecordSpectra& record, const LoopPoint& point, const Tail& tail) {
  const double slope = record.slopes.dot(point.flame);
  double sum = BinsEach(record) * tail.Value().real();
  ForEachBeside(record, [&](C s, double weight) {
    sum -= weight * std::log(std::abs(1.0 - slope * LoopAt(record, point, s).u));
  });
  return sum;
}

// The sum of 2 w ln |D| over the band.
double Within(const RecordSpectra& record, const LoopPoint& point) {
  const double slope = record.slopes.dot(point.flame);
  double sum = 0.0;
  for (Eigen::Index i = 0; i < record.bins(); ++i) {
    const C u = LoopAt(record, point, record.s[i]).u;
    sum += 2.0 * record.share[i] * std::log(std::abs(1.0 - slope * u));
  }
  return sum;
}

// By the loop's parameters, and by the flame's slope.
struct LoopGradient {
  Eigen::VectorXd loop;
  double slope = 0.0;

  // `over`: of d (slope U).
  void Add(const PointStructure& structure, const LoopPoint& point, double slope_now,
           const LoopAt& at, C over) {
    at.AddSlopes(structure, point, slope_now * over, &loop);
    slope += (over * at.u).real();
  }
};

LoopGradient BesideGradient(const RecordSpectra& record, const PointStructure& structure,
                            const LoopPoint& point, const Tail& tail) {
  const double slope = record.slopes.dot(point.flame);
  LoopGradient out{Eigen::VectorXd::Zero(structure.Flame())};
  ForEachBeside(record, [&](C s, double weight) {
    const LoopAt loop(record, point, s);
    out.Add(structure, point, slope, loop, weight * Reciprocal(1.0 - slope * loop.u));
  });
  const double bins = BinsEach(record);
  if (tail.u != 0.0) out.Add(structure, point, slope, tail.loop, bins * tail.ByLoop() / tail.u);
  if (tail.constant != 0.0) {
    const double by_constant = bins * tail.ByConstant().real();
    out.slope += by_constant / slope;
    const Eigen::Index residues = structure.Frequencies() + structure.Dampings();
    out.loop.segment(residues, structure.modes).array() += by_constant / SumOfResidues(point);
  }
  const C s = tail.loop.s;
  const auto by_path = [&](C by_log, C by_slope_and_log) {
    return bins * (tail.ByConstant() * by_log + tail.BySlope() * by_slope_and_log).real();
  };
  out.loop[structure.Delay()] += by_path(point.path.ByLogTau(s), point.path.BySlopeAndLogTau(s));
  if (structure.Delays() > 1) {
    out.loop[structure.Delay() + 1] +=
        by_path(point.path.ByLogRho(s), point.path.BySlopeAndLogRho(s));
  }
  return out;
}

LoopGradient WithinGradient(const RecordSpectra& record, const PointStructure& structure,
                            const LoopPoint& point) {
  const double slope = record.slopes.dot(point.flame);
  LoopGradient out{Eigen::VectorXd::Zero(structure.Flame())};
  for (Eigen::Index i = 0; i < record.bins(); ++i) {
    const LoopAt loop(record, point, record.s[i]);
    const C over = -2.0 * record.share[i] * Reciprocal(1.0 - slope * loop.u);
    out.Add(structure, point, slope, loop, over);
  }
  return out;
}

// The weight of the first in the slope of -ln(e^-a + e^-b).
double WeightOfFirst(double a, double b) { return 1.0 / (1.0 + std::exp(a - b)); }

}  // namespace

C OpenLoop(const RecordSpectra& record, const LoopPoint& point, C s) {
  return LoopAt(record, point, s).u;
}

double LogDeterminant(const RecordSpectra& record, const LoopPoint& point) {
  const Tail tail(record, point);
  if (!tail.Possible(point.path)) return -std::numeric_limits<double>::infinity();
  const double beside = Beside(record, point, tail);
  const double within = Within(record, point);
  return std::min(beside, within) - std::log1p(std::exp(-std::abs(beside - within))) +
         std::numbers::ln2;
}

Eigen::VectorXd LogDeterminantGradient(const RecordSpectra& record, const PointStructure& structure,
                                       const LoopPoint& point) {
  const Tail tail(record, point);
  const double weight = WeightOfFirst(Beside(record, point, tail), Within(record, point));
  const LoopGradient beside = BesideGradient(record, structure, point, tail);
  const LoopGradient within = WithinGradient(record, structure, point);
  const Eigen::Index flame = point.flame.size();
  Eigen::VectorXd out = Eigen::VectorXd::Zero(structure.Parameters(flame));
  out.head(structure.Flame()) = weight * beside.loop + (1.0 - weight) * within.loop;
  out.segment(structure.Flame(), flame) =
      (weight * beside.slope + (1.0 - weight) * within.slope) * record.slopes;
  return out;
}

}  // namespace howl

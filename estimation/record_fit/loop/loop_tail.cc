#include "estimation/record_fit/loop/loop_tail.h"

#include <cmath>
#include <numbers>

#include "model/numerics/complex_products.h"
#include "model/numerics/dilogarithm.h"

namespace howl {

using C = std::complex<double>;

LoopAt::LoopAt(const RecordSpectra& record, const LoopPoint& point, C at)
    : s(at),
      slopes(point.path.WithSlopes(s)),
      path(Times(slopes.at, record.InputAt(s))),
      u(Times(AcousticTransfer(point, s), path)) {}

void LoopAt::AddSlopes(const PointStructure& structure, const LoopPoint& point, C by,
                       Eigen::VectorXd* out) const {
  AddAcousticSlopes(structure, point, s, Times(by, path), out);
  const C by_log = Times(by, u);
  for (Eigen::Index i = 0; i < structure.Delays(); ++i) {
    (*out)[structure.Delay() + i] += Times(by_log, slopes.by[static_cast<std::size_t>(i)]).real();
  }
}

double LeastDelay(const RecordSpectra& record) {
  return std::numbers::pi / record.s[record.bins() - 1].imag();
}

double SumOfResidues(const LoopPoint& point) {
  double sum = 0.0;
  for (const LoopMode& mode : point.modes) sum += mode.a;
  return sum;
}

LoopTail::LoopTail(const RecordSpectra& record, const LoopPoint& point)
    : loop(record, point, 2.0 * record.s[record.bins() - 1]),
      u(record.slopes.dot(point.flame) * loop.u) {
  if (record.flame_input == FlameInput::kPressureRate) {
    constant = record.slopes.dot(point.flame) * SumOfResidues(point) * point.path.At(loop.s) *
               record.filters.At(loop.s);
  }
  const double falls = record.flame_input == FlameInput::kVelocity ? 2.0 : 1.0;
  const C turns = C(0.0, 1.0) * point.path.Fall(loop.s).at;
  of_constant = 1.0 / turns;
  of_rest = 1.0 / (falls / loop.s.imag() + turns);
}

C LoopTail::Value() const {
  return Dilogarithm(constant) * (of_constant - of_rest) + Dilogarithm(u) * of_rest;
}

C LoopTail::ByConstant() const { return -std::log(1.0 - constant) * (of_constant - of_rest); }

C LoopTail::ByLoop() const { return -std::log(1.0 - u) * of_rest; }

C LoopTail::ByFall() const {
  const C of = Dilogarithm(constant);
  return C(0.0, -1.0) *
         (of * of_constant * of_constant + (Dilogarithm(u) - of) * of_rest * of_rest);
}

}  // namespace howl

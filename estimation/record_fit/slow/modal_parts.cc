#include "estimation/record_fit/slow/modal_parts.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

namespace howl {
namespace {

using C = std::complex<double>;

// Of the sum of all modes' squares: less than this of it R is near a zero.
constexpr double kNearZero = 0.01;

C Resonator(const LoopMode& mode, C s) {
  return s * s + 2.0 * mode.xi * mode.omega * s + mode.omega * mode.omega;
}

C AnswerOf(const LoopMode& mode, C s) {
  return (mode.a * s + mode.b * mode.omega) / Resonator(mode, s);
}

// 1 / R.
C OverSum(const std::vector<LoopMode>& modes, C s) {
  C sum = 0.0;
  double squares = 0.0;
  for (const LoopMode& mode : modes) {
    const C answer = AnswerOf(mode, s);
    sum += answer;
    squares += std::norm(answer);
  }
  return std::conj(sum) / std::max(std::norm(sum), kNearZero * squares);
}

// One that holds all of p.
ModalPart WholePart(const RecordSpectra& record) {
  return {1.0, 0.0, Eigen::VectorXcd::Ones(record.edge_s.size()),
          record.pressure.cwiseQuotient(record.edge_s)};
}

}  // namespace

const LoopMode& ModeOfCycle(const std::vector<LoopMode>& modes) {
  return *std::ranges::min_element(
      modes, {}, [](const LoopMode& mode) { return std::abs(std::log(mode.omega)); });
}

std::vector<ModalPart> PartsOf(const RecordSpectra& record, const std::vector<LoopMode>& modes) {
  if (modes.empty()) return {WholePart(record)};
  const LoopMode& first = ModeOfCycle(modes);
  const double size = std::hypot(first.a, first.b);
  const Eigen::VectorXcd over_sum = record.edge_s.unaryExpr([&](C s) { return OverSum(modes, s); });
  std::vector<ModalPart> out;
  for (const LoopMode& mode : modes) {
    ModalPart part{mode.omega / first.omega, mode.xi / mode.omega,
                   Eigen::VectorXcd(record.edge_s.size()), Eigen::VectorXcd(record.edge_s.size())};
    for (Eigen::Index i = 0; i < record.edge_s.size(); ++i) {
      const C s = record.edge_s[i];
      part.share[i] = AnswerOf(mode, s) * over_sum[i];
      // R_i over a s + b omega has no zero, as a mode may have that leads to another.
      part.x[i] = size * (over_sum[i] / Resonator(mode, s)) * record.pressure[i];
    }
    out.push_back(std::move(part));
  }
  return out;
}

}  // namespace howl

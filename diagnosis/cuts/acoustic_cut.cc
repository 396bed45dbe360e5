#include "diagnosis/cuts/acoustic_cut.h"

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>

#include "diagnosis/cuts/acoustic_modulation.h"

namespace howl {
namespace {

constexpr double kLogStep = 1e-5;
constexpr double kSameMode = 0.75;          // of one cycle's frequency over another's
constexpr double kNeighbourLogOmega = 0.1;  // on the grid of starts
constexpr double kNeighbourLogXi = 0.8;

Eigen::VectorXcd Bare(const CutRecord& record, const Eigen::VectorXcd& transfer) {
  const Eigen::Index start = record.first - kTapReach;
  const Eigen::Index n = record.extended();
  return ApplyWindow(record.pressure_spectrum.segment(start, n) -
                         transfer.cwiseProduct(record.driving_heat_release),
                     record.acoustic_count);
}

AcousticLocals Moved(AcousticLocals locals, int which, double by) {
  locals[which] += by;
  return locals;
}

}  // namespace

Eigen::VectorXcd AcousticResidual(const CutRecord& record, const Effect& effect, EffectValues x,
                                  const AcousticLocals& locals) {
  Eigen::VectorXcd residual = Bare(record, RecordedTransfer(record, effect, x, locals));
  const Eigen::VectorXcd moved = PressureOfMovement(record, effect, x, locals);
  if (moved.size() > 0) residual -= ApplyWindow(moved, record.acoustic_count);
  return residual;
}

Eigen::MatrixXcd AcousticJacobian(const CutRecord& record, const Effect& effect, EffectValues x,
                                  const AcousticLocals& locals, const Eigen::VectorXcd& residual,
                                  const Eigen::VectorXd& steps) {
  Eigen::MatrixXcd jacobian(record.acoustic_count, 4 + steps.size());
  const Eigen::VectorXcd& q = record.driving_heat_release;
  // The movement about the means hardly changes the derivatives of the residual by the locals.
  const Eigen::VectorXcd r = RecordedTransfer(record, effect, x, locals);
  for (int i = 0; i < 4; ++i) {
    if (!IsFree(record.model, i)) {
      jacobian.col(i).setZero();
      continue;
    }
    const double step = i < 2 ? kLogStep : kLogStep * std::max(std::abs(locals[2]), 1e-12);
    const Eigen::VectorXcd moved = RecordedTransfer(record, effect, x, Moved(locals, i, step));
    jacobian.col(i) = ApplyWindow(((r - moved) / step).cwiseProduct(q), record.acoustic_count);
  }
  std::vector<double> at(x.begin(), x.end());
  for (Eigen::Index j = 0; j < steps.size(); ++j) {
    at[static_cast<std::size_t>(j)] = x[static_cast<std::size_t>(j)] + steps[j];
    if (effect.ModulatesAcoustics()) {
      jacobian.col(4 + j) = (AcousticResidual(record, effect, at, locals) - residual) / steps[j];
    } else {
      const Eigen::VectorXcd moved = RecordedTransfer(record, effect, at, locals);
      jacobian.col(4 + j) =
          ApplyWindow(((r - moved) / steps[j]).cwiseProduct(q), record.acoustic_count);
    }
    at[static_cast<std::size_t>(j)] = x[static_cast<std::size_t>(j)];
  }
  return jacobian;
}

namespace {

using Places = std::vector<Eigen::Vector2d>;  // log omega, log xi

void AddPlaces(double cycle_hz, Places* places) {
  constexpr std::array kOmega = {0.78, 0.85, 0.92, 0.96, 1.0, 1.05};
  constexpr std::array kXi = {0.02, 0.05, 0.1, 0.17, 0.28};
  for (const double omega : kOmega) {
    for (const double xi : kXi) places->emplace_back(std::log(omega * cycle_hz), std::log(xi));
  }
}

std::vector<AcousticLocals> BestStarts(const CutRecord& record, const Effect& effect,
                                       EffectValues x, const Places& places, std::size_t count) {
  const CutReference& reference = record.reference;
  const Eigen::Index n = record.acoustic_count;
  const auto whitened = [&](const Eigen::VectorXcd& residual) {
    if (reference.acoustic_shape.size() == 0) return residual;
    return residual.cwiseQuotient(reference.acoustic_shape.cwiseSqrt().cast<Response>()).eval();
  };
  struct Start {
    AcousticLocals locals;
    double cost;
  };
  std::vector<Start> starts;
  const auto residual = [&](const AcousticLocals& at) {
    return whitened(Bare(record, RecordedTransfer(record, effect, x, at)));
  };
  for (const Eigen::Vector2d& place : places) {
    AcousticLocals locals(place[0], place[1], 0.0, 0.0);
    const int coefficients = IsFree(record.model, 3) ? 2 : 1;
    Eigen::MatrixXd columns(2 * n, coefficients);
    Eigen::VectorXd y(2 * n);
    const Eigen::VectorXcd target = residual(locals);
    y << target.real(), target.imag();
    for (int i = 0; i < coefficients; ++i) {
      const Eigen::VectorXcd column = target - residual(Moved(locals, 2 + i, 1.0));
      columns.col(i) << column.real(), column.imag();
    }
    const Eigen::MatrixXd gram = columns.transpose() * columns;
    const Eigen::VectorXd solution = gram.ldlt().solve(columns.transpose() * y);
    locals.segment(2, coefficients) = solution;
    starts.push_back({locals, (y - columns * solution).squaredNorm()});
  }
  std::stable_sort(starts.begin(), starts.end(),
                   [](const Start& a, const Start& b) { return a.cost < b.cost; });
  std::vector<AcousticLocals> out;
  for (const Start& start : starts) {
    if (out.size() == count) break;
    const bool apart = std::none_of(out.begin(), out.end(), [&](const AcousticLocals& other) {
      return std::abs(start.locals[0] - other[0]) < kNeighbourLogOmega &&
             std::abs(start.locals[1] - other[1]) < kNeighbourLogXi;
    });
    if (apart) out.push_back(start.locals);
  }
  return out;
}

}  // namespace

std::vector<AcousticLocals> SecondModeStarts(const CutRecord& record, const Effect& effect,
                                             EffectValues x, std::size_t count) {
  if (!IsFree(record.model, 3) || record.reference.acoustic.size() > 0) return {};
  Places places;
  AddPlaces(record.at.cycle_frequency_hz / record.model.harmonic_ratio, &places);
  return BestStarts(record, effect, x, places, count);
}

std::vector<AcousticLocals> AcousticStarts(const CutRecord& record, const Effect& effect,
                                           EffectValues x, std::size_t count) {
  // Where another mode carries the cycle, omega follows from the modes' ratio.
  constexpr std::array kOmegaIfCarried = {0.98, 1.0, 1.02};
  constexpr std::array kXiIfCarried = {0.1, 0.17};
  const CutReference& reference = record.reference;
  std::vector<double> cycles_hz = {record.at.cycle_frequency_hz};
  // The cycle of another experiment may be another mode's.
  if (record.lowest_cycle_hz < kSameMode * cycles_hz[0]) {
    cycles_hz.push_back(record.lowest_cycle_hz);
  }
  Places places;
  for (const double cycle_hz : cycles_hz) AddPlaces(cycle_hz, &places);
  for (const double ratio : effect.ModeRatios(x)) {
    for (const double omega : kOmegaIfCarried) {
      for (const double xi : kXiIfCarried) {
        places.emplace_back(std::log(omega * record.at.cycle_frequency_hz / ratio), std::log(xi));
      }
    }
  }
  // A reference's factors hold relative to its own base, and mislead far from that base.
  if (reference.acoustic.size() > 0) places = {reference.acoustics.head<2>()};
  return BestStarts(record, effect, x, places, count);
}

}  // namespace howl

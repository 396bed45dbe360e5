#include "estimation/record_fit/starts/pole_starts.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <iterator>
#include <limits>
#include <utility>

#include "estimation/record_fit/starts/start_least_squares.h"
#include "estimation/record_fit/whittle/noise_shape.h"
#include "model/numerics/dense_algebra.h"

namespace howl {
namespace {

using C = std::complex<double>;

constexpr int kFrequencies = 40;
constexpr int kRelocations = 12;
constexpr double kSpreadXi = 0.05;
constexpr double kLeastXi = 1e-3;
constexpr double kMostXi = 1.0;
constexpr double kOfLine = 1e-4;  // of a line's power, five bins beside it (noise_shape.h)

// Modes with these poles, each pair of complex ones a mode; real ones pair in their order. Unstable
// poles are mirrored.
std::vector<StartPole> PolesOf(const Eigen::VectorXcd& roots) {
  std::vector<StartPole> out;
  std::vector<double> real;
  for (const C& root : roots) {
    if (root.imag() > 0.0) {
      out.push_back({std::abs(root), std::abs(root.real()) / std::abs(root)});
    } else if (root.imag() == 0.0) {
      real.push_back(std::abs(root.real()));
    }
  }
  std::ranges::sort(real);
  for (std::size_t i = 0; i + 1 < real.size(); i += 2) {
    const double omega = std::sqrt(real[i] * real[i + 1]);
    out.push_back({omega, 0.5 * (real[i] + real[i + 1]) / omega});
  }
  return out;
}

// Hum and tones hold thousands of times the power of the bins beside them, and tell nothing of R.
Eigen::VectorXd WeightsBesideLines(const RecordSpectra& record, const PointStructure& structure) {
  Eigen::VectorXd out =
      SmoothPower(Tapered(record.pressure), kStartReach).cwiseSqrt().cwiseInverse();
  for (const NoiseTerm& term : structure.noise) {
    if (!HasLines(term.source)) continue;
    out = (NoiseShape(term, record).array() > kOfLine).select(0.0, out);
  }
  return out;
}

}  // namespace

PoleStarts::PoleStarts(const RecordSpectra& record, const PointStructure& structure)
    : record_(record),
      structure_(structure),
      heat_release_(Tapered(record.heat_release)),
      weight_(WeightsBesideLines(record, structure)),
      target_(weight_.cwiseProduct(Tapered(record.pressure))),
      low_(std::abs(record.s[0])),
      high_(std::abs(record.s[record.bins() - 1])) {}

void PoleStarts::AddColumns(const StartPole& pole, Eigen::MatrixXcd* columns) const {
  const Eigen::Index had = columns->cols();
  columns->conservativeResize(record_.bins(), had + (structure_.complex_residues ? 2 : 1));
  for (Eigen::Index i = 0; i < record_.bins(); ++i) {
    const C s = record_.s[i];
    const C driven = heat_release_[i] * weight_[i] /
                     (s * s + 2.0 * pole.xi * pole.omega * s + pole.omega * pole.omega);
    (*columns)(i, had) = s * driven;
    if (structure_.complex_residues) (*columns)(i, had + 1) = pole.omega * driven;
  }
}

Eigen::MatrixXcd PoleStarts::Columns(const std::vector<StartPole>& poles) const {
  Eigen::MatrixXcd out(record_.bins(), 0);
  for (const StartPole& pole : poles) AddColumns(pole, &out);
  return out;
}

std::vector<LoopMode> PoleStarts::WithResidues(const std::vector<StartPole>& poles) const {
  const Eigen::VectorXd residues = SolveStart(Columns(poles), target_).coefficients;
  const Eigen::Index each = structure_.complex_residues ? 2 : 1;
  std::vector<LoopMode> out;
  for (std::size_t k = 0; k < poles.size(); ++k) {
    const Eigen::Index first = each * static_cast<Eigen::Index>(k);
    out.push_back({poles[k].omega, poles[k].xi, residues[first],
                   structure_.complex_residues ? residues[first + 1] : 0.0});
  }
  return out;
}

std::vector<StartPole> PoleStarts::Tied(double omega, double xi) const {
  std::vector<StartPole> out;
  for (Eigen::Index k = 0; k < structure_.FirstModes(); ++k) {
    out.push_back({omega * structure_.RatioOf(k), xi});
  }
  return out;
}

// The grid's pole that leaves least with `columns`, which gives the columns of a pole.
template <typename ColumnsOf>
StartPole PoleStarts::BestOfGrid(const ColumnsOf& columns) const {
  StartPole best{1.0, 0.1};
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kFrequencies; ++i) {
    const double omega = low_ * std::pow(high_ / low_, (i + 0.5) / kFrequencies);
    for (const double xi : {0.02, 0.06, 0.18}) {
      const double left = SolveStart(columns(StartPole{omega, xi}), target_).left;
      if (left >= least) continue;
      least = left;
      best = {omega, xi};
    }
  }
  return best;
}

StartPole PoleStarts::Next(const std::vector<StartPole>& poles) const {
  const Eigen::MatrixXcd had = Columns(poles);
  return BestOfGrid([&](const StartPole& pole) {
    Eigen::MatrixXcd with = had;
    AddColumns(pole, &with);
    return with;
  });
}

std::vector<StartPole> PoleStarts::Greedy() const {
  std::vector<StartPole> poles;
  if (structure_.ratio) {
    const StartPole first =
        BestOfGrid([&](const StartPole& pole) { return Columns(Tied(pole.omega, pole.xi)); });
    poles = Tied(first.omega, first.xi);
  }
  while (std::ssize(poles) < structure_.modes) poles.push_back(Next(poles));
  return poles;
}

std::vector<StartPole> PoleStarts::Spread() const {
  std::vector<StartPole> out;
  for (int k = 0; k < structure_.modes; ++k) {
    out.push_back({low_ * std::pow(high_ / low_, (k + 0.5) / structure_.modes), kSpreadXi});
  }
  return out;
}

// Vector fitting: with the poles in common, P sigma = Q (sigma R) is
// linear in the residues of sigma and of sigma R, and the zeros of sigma are better poles.
std::vector<StartPole> PoleStarts::Relocated(std::vector<StartPole> poles) const {
  const auto modes = static_cast<Eigen::Index>(poles.size());
  for (int round = 0; round < kRelocations; ++round) {
    Eigen::MatrixXcd columns = Columns(poles);
    const Eigen::Index residues = columns.cols();
    columns.conservativeResize(Eigen::NoChange, residues + 2 * modes);
    // [s; omega] / (s^2 + 2 xi omega s + omega^2) answers to an input as this system's state does.
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(2 * modes, 2 * modes);
    for (Eigen::Index k = 0; k < modes; ++k) {
      const StartPole& pole = poles[static_cast<std::size_t>(k)];
      system.block(2 * k, 2 * k, 2, 2) << -2.0 * pole.xi * pole.omega, -pole.omega, pole.omega, 0.0;
      for (Eigen::Index i = 0; i < record_.bins(); ++i) {
        const C s = record_.s[i];
        const C over =
            -target_[i] / (s * s + 2.0 * pole.xi * pole.omega * s + pole.omega * pole.omega);
        columns(i, residues + 2 * k) = s * over;
        columns(i, residues + 2 * k + 1) = pole.omega * over;
      }
    }
    const Eigen::VectorXd sigma = SolveStart(columns, target_).coefficients.tail(2 * modes);
    for (Eigen::Index k = 0; k < modes; ++k) system.row(2 * k) -= sigma.transpose();
    poles = PolesOf(Eigenvalues(system));
    for (StartPole& pole : poles) {
      pole.omega = std::clamp(pole.omega, 0.5 * low_, 2.0 * high_);
      pole.xi = std::clamp(pole.xi, kLeastXi, kMostXi);
    }
  }
  return poles;
}

std::vector<StartPole> PoleStarts::Drawn(RandomStream* random) const {
  const auto omega = [&] { return low_ * std::pow(high_ / low_, random->Uniform()); };
  const auto xi = [&] { return 0.02 * std::pow(10.0, random->Uniform()); };
  std::vector<StartPole> out;
  if (structure_.ratio) out = Tied(omega(), xi());
  while (std::ssize(out) < structure_.modes) out.push_back({omega(), xi()});
  return out;
}

}  // namespace howl

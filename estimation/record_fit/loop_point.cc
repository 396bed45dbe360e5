#include "estimation/record_fit/loop_point.h"

#include <cmath>
#include <complex>

#include "model/numerics/complex_products.h"

namespace howl {
namespace {

using C = std::complex<double>;

double FrequencyRatio(const PointStructure& structure, Eigen::Index mode) {
  return 1.0 + (*structure.ratio - 1.0) * static_cast<double>(mode);
}

// e^(-tau s) for s = j f, without the exponential of its real part.
Eigen::VectorXcd Delayed(const Eigen::VectorXcd& s, double tau) {
  return s.unaryExpr([tau](C each) { return std::polar(1.0, -tau * each.imag()); });
}

C SumOverModes(const LoopPoint& point, C s, double LoopMode::*rate, double LoopMode::*level) {
  C out = 0.0;
  for (const LoopMode& mode : point.modes) {
    out +=
        Times(mode.*rate * s + mode.*level * mode.omega,
              Reciprocal(Times(s, s) + 2.0 * mode.xi * mode.omega * s + mode.omega * mode.omega));
  }
  return out;
}

Eigen::VectorXcd Transfer(const LoopPoint& point, const Eigen::VectorXcd& s) {
  return s.unaryExpr([&](C each) { return AcousticTransfer(point, each); });
}

Eigen::MatrixXcd TaperedColumns(const Eigen::MatrixXcd& x) {
  return x.topRows(x.rows() - 1) - x.bottomRows(x.rows() - 1);
}

// Calls `take` with the index of each parameter that moves mode k, dR and dT by it at s, T being
// what the record's ends leave.
template <typename Take>
void ForEachSlope(const PointStructure& structure, const LoopPoint& point, Eigen::Index k, C s,
                  const Take& take) {
  const LoopMode& mode = point.modes[static_cast<std::size_t>(k)];
  const Eigen::Index dampings = structure.Frequencies();
  const Eigen::Index residues = dampings + structure.Dampings();
  const Eigen::Index transients = structure.Transfer();
  const double omega = mode.omega;
  const C damped = 2.0 * mode.xi * omega * s;
  const C over = Reciprocal(Times(s, s) + damped + omega * omega);
  const C r_over = Times(Times(mode.a * s + mode.b * omega, over), over);
  const C t_over = Times(Times(mode.g * s + mode.h * omega, over), over);
  const C by_omega = damped + 2.0 * omega * omega;
  take(structure.ratio ? 0 : k, mode.b * omega * over - Times(r_over, by_omega),
       mode.h * omega * over - Times(t_over, by_omega));
  take(dampings + (structure.own_damping ? k : 0), -Times(r_over, damped), -Times(t_over, damped));
  const C by_rate = Times(s, over);
  const C by_level = omega * over;
  take(residues + k, by_rate, C(0.0));
  if (structure.complex_residues) take(residues + structure.modes + k, by_level, C(0.0));
  take(transients + k, C(0.0), by_rate);
  take(transients + structure.modes + k, C(0.0), by_level);
}

Eigen::MatrixXcd TransferColumns(const PointStructure& structure, const LoopPoint& point,
                                 const Eigen::VectorXcd& s) {
  Eigen::MatrixXcd out = Eigen::MatrixXcd::Zero(s.size(), structure.Acoustics());
  for (Eigen::Index k = 0; k < structure.modes; ++k) {
    for (Eigen::Index i = 0; i < s.size(); ++i) {
      ForEachSlope(structure, point, k, s[i],
                   [&](Eigen::Index j, C of_r, C) { out(i, j) += of_r; });
    }
  }
  return out;
}

// Of R Q + T.
Eigen::MatrixXcd PressureColumns(const PointStructure& structure, const LoopPoint& point,
                                 const Eigen::VectorXcd& s, const Eigen::VectorXcd& heat_release) {
  Eigen::MatrixXcd out = Eigen::MatrixXcd::Zero(s.size(), structure.Acoustics());
  for (Eigen::Index k = 0; k < structure.modes; ++k) {
    for (Eigen::Index i = 0; i < s.size(); ++i) {
      ForEachSlope(structure, point, k, s[i], [&](Eigen::Index j, C of_r, C of_t) {
        out(i, j) += Times(of_r, heat_release[i]) + of_t;
      });
    }
  }
  return out;
}

}  // namespace

Eigen::Index PointStructure::NoiseParameters() const {
  Eigen::Index sum = HasBackground(noise) ? 1 : 0;
  for (const NoiseTerm& term : noise) sum += term.coefficients;
  return sum;
}

LoopPoint ToPoint(const PointStructure& structure, Eigen::Index flame,
                  const Eigen::VectorXd& parameters) {
  LoopPoint out;
  const Eigen::Index dampings = structure.Frequencies();
  const Eigen::Index residues = dampings + structure.Dampings();
  for (Eigen::Index k = 0; k < structure.modes; ++k) {
    LoopMode mode;
    mode.omega = std::exp(parameters[structure.ratio ? 0 : k]);
    if (structure.ratio) mode.omega *= FrequencyRatio(structure, k);
    mode.xi = std::exp(parameters[dampings + (structure.own_damping ? k : 0)]);
    mode.a = parameters[residues + k];
    if (structure.complex_residues) mode.b = parameters[residues + structure.modes + k];
    mode.g = parameters[structure.Transfer() + k];
    mode.h = parameters[structure.Transfer() + structure.modes + k];
    out.modes.push_back(mode);
  }
  Eigen::Index next = structure.Delay();
  out.tau = std::exp(parameters[next++]);
  out.flame = parameters.segment(next, flame);
  next += flame;
  for (const NoiseTerm& term : structure.noise) {
    out.noise.emplace_back(parameters.segment(next, term.coefficients));
    next += term.coefficients;
  }
  if (HasBackground(structure.noise)) out.background_ratio = parameters[next];
  return out;
}

Eigen::VectorXd ToParameters(const PointStructure& structure, const LoopPoint& point) {
  Eigen::VectorXd out(structure.Delay() + 1 + point.flame.size() + structure.NoiseParameters());
  Eigen::Index next = 0;
  const auto mode = [&](Eigen::Index k) { return point.modes[static_cast<std::size_t>(k)]; };
  for (Eigen::Index k = 0; k < structure.Frequencies(); ++k) out[next++] = std::log(mode(k).omega);
  for (Eigen::Index k = 0; k < structure.Dampings(); ++k) out[next++] = std::log(mode(k).xi);
  for (Eigen::Index k = 0; k < structure.modes; ++k) out[next++] = mode(k).a;
  if (structure.complex_residues) {
    for (Eigen::Index k = 0; k < structure.modes; ++k) out[next++] = mode(k).b;
  }
  for (Eigen::Index k = 0; k < structure.modes; ++k) out[next++] = mode(k).g;
  for (Eigen::Index k = 0; k < structure.modes; ++k) out[next++] = mode(k).h;
  out[next++] = std::log(point.tau);
  out.segment(next, point.flame.size()) = point.flame;
  next += point.flame.size();
  for (const Eigen::VectorXd& source : point.noise) {
    out.segment(next, source.size()) = source;
    next += source.size();
  }
  if (HasBackground(structure.noise)) out[next] = point.background_ratio;
  return out;
}

LoopResiduals ResidualsOf(const RecordSpectra& record, const PointStructure& structure,
                          const LoopPoint& point) {
  LoopResiduals out;
  out.r = Transfer(point, record.s);
  const double slope = record.slopes.dot(point.flame);
  out.f = slope * Delayed(record.s, point.tau).cwiseProduct(record.input);
  out.acoustic =
      Tapered(record.pressure - Transfer(point, record.edge_s).cwiseProduct(record.heat_release) -
              record.edge_s.unaryExpr(
                  [&](C s) { return SumOverModes(point, s, &LoopMode::g, &LoopMode::h); }));
  out.flame = Tapered(record.heat_release -
                      Delayed(record.edge_s, point.tau).cwiseProduct(record.flame * point.flame));
  SetNoise(record, structure, point, &out);
  return out;
}

void SetNoise(const RecordSpectra& record, const PointStructure& structure, const LoopPoint& point,
              LoopResiduals* residuals) {
  residuals->spectra.resize(record.bins(), static_cast<Eigen::Index>(structure.noise.size()));
  for (std::size_t j = 0; j < structure.noise.size(); ++j) {
    residuals->spectra.col(static_cast<Eigen::Index>(j)) =
        LoopNoiseSpectrum(record.position, point.noise[j]);
  }
  residuals->background_ratio = point.background_ratio;
}

C AcousticTransfer(const LoopPoint& point, C s) {
  return SumOverModes(point, s, &LoopMode::a, &LoopMode::b);
}

void AddAcousticSlopes(const PointStructure& structure, const LoopPoint& point, C s, C by,
                       Eigen::VectorXd* out) {
  for (Eigen::Index k = 0; k < structure.modes; ++k) {
    ForEachSlope(structure, point, k, s,
                 [&](Eigen::Index i, C of_r, C) { (*out)[i] += Times(by, of_r).real(); });
  }
}

LoopDerivatives DerivativesOf(const RecordSpectra& record, const PointStructure& structure,
                              const LoopPoint& point) {
  LoopDerivatives out;
  out.r = TransferColumns(structure, point, record.s);
  out.acoustic =
      -TaperedColumns(PressureColumns(structure, point, record.edge_s, record.heat_release));
  const Eigen::Index flame = point.flame.size();
  const Eigen::VectorXcd path = Delayed(record.s, point.tau).cwiseProduct(record.input);
  out.f.resize(record.bins(), 1 + flame);
  out.f.col(0) = -point.tau * record.slopes.dot(point.flame) * record.s.cwiseProduct(path);
  out.f.rightCols(flame) = path * record.slopes.transpose();
  const Eigen::MatrixXcd delayed = Delayed(record.edge_s, point.tau).asDiagonal() * record.flame;
  out.flame.resize(record.bins(), 1 + flame);
  out.flame.col(0) = point.tau * Tapered(record.edge_s.cwiseProduct(delayed * point.flame));
  out.flame.rightCols(flame) = -TaperedColumns(delayed);
  for (const NoiseTerm& term : structure.noise) {
    out.log_spectra.push_back(ChebyshevColumns(record.position, term.coefficients));
  }
  return out;
}

}  // namespace howl

#include "estimation/record_fit/loop/loop_point.h"

#include <cmath>
#include <complex>

#include "model/numerics/complex_products.h"

namespace howl {
namespace {

using C = std::complex<double>;

double FrequencyRatio(const PointStructure& structure, Eigen::Index mode) {
  return 1.0 + (*structure.ratio - 1.0) * static_cast<double>(mode);
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

Eigen::VectorXcd ByLogTau(const FlamePath& path, const Eigen::VectorXcd& s) {
  return s.unaryExpr([&](C each) { return path.ByLogTau(each); });
}

Eigen::VectorXcd ByLogRho(const FlamePath& path, const Eigen::VectorXcd& s) {
  return s.unaryExpr([&](C each) { return path.ByLogRho(each); });
}

// What the real and the imaginary part of the h-th line's error are multiplied by.
struct LineShape {
  LineShape(C s, double h) {
    const C resonance = 2.0 * kLineReach * Reciprocal(Times(s, s) + 2.0 * kLineReach * s + h * h);
    real = Times(s, resonance);
    imag = -h * resonance;
  }
  C real;
  C imag;
};

// 1 + the errors of all lines.
Eigen::VectorXcd LineFactors(const Eigen::VectorXcd& s, const Eigen::VectorXcd& errors) {
  Eigen::VectorXcd out = Eigen::VectorXcd::Ones(s.size());
  for (Eigen::Index h = 0; h < errors.size(); ++h) {
    for (Eigen::Index i = 0; i < s.size(); ++i) {
      const LineShape shape(s[i], static_cast<double>(h + 1));
      out[i] += errors[h].real() * shape.real + errors[h].imag() * shape.imag;
    }
  }
  return out;
}

// What the real and then the imaginary parts of the errors add to an answer.
Eigen::MatrixXcd LineColumns(const Eigen::VectorXcd& s, const Eigen::VectorXcd& answer,
                             Eigen::Index lines) {
  Eigen::MatrixXcd out(s.size(), 2 * lines);
  for (Eigen::Index h = 0; h < lines; ++h) {
    for (Eigen::Index i = 0; i < s.size(); ++i) {
      const LineShape shape(s[i], static_cast<double>(h + 1));
      out(i, h) = Times(shape.real, answer[i]);
      out(i, lines + h) = Times(shape.imag, answer[i]);
    }
  }
  return out;
}

Eigen::VectorXcd ComplexOf(const Eigen::VectorXd& parts) {
  const Eigen::Index count = parts.size() / 2;
  Eigen::VectorXcd out(count);
  out.real() = parts.head(count);
  out.imag() = parts.tail(count);
  return out;
}

// R Q and what the record's ends leave, before the taper.
Eigen::VectorXcd AnswerOfAcoustics(const RecordSpectra& record, const LoopPoint& point) {
  return Transfer(point, record.edge_s).cwiseProduct(record.heat_release) +
         record.edge_s.unaryExpr(
             [&](C s) { return SumOverModes(point, s, &LoopMode::g, &LoopMode::h); });
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
  out.acoustic_lines =
      ComplexOf(parameters.segment(structure.AcousticLine(), structure.AcousticLines()));
  Eigen::Index next = structure.Delay();
  out.path = {structure.delay_spread, std::exp(parameters[next++])};
  if (structure.Delays() > 1) out.path.rho = std::exp(parameters[next++]);
  out.flame = parameters.segment(next, flame);
  next += flame;
  out.flame_lines = ComplexOf(parameters.segment(next, structure.FlameLines()));
  next += structure.FlameLines();
  for (const NoiseTerm& term : structure.noise) {
    out.noise.emplace_back(parameters.segment(next, term.coefficients));
    next += term.coefficients;
  }
  if (HasBackground(structure.noise)) out.background_ratio = parameters[next];
  return out;
}

Eigen::VectorXd ToParameters(const PointStructure& structure, const LoopPoint& point) {
  Eigen::VectorXd out(structure.Parameters(point.flame.size()));
  Eigen::Index next = 0;
  const auto add = [&](const Eigen::VectorXd& values) {
    out.segment(next, values.size()) = values;
    next += values.size();
  };
  const auto add_lines = [&](const Eigen::VectorXcd& errors, Eigen::Index count) {
    Eigen::VectorXcd all = Eigen::VectorXcd::Zero(count / 2);
    all.head(errors.size()) = errors;
    add(all.real());
    add(all.imag());
  };
  const auto mode = [&](Eigen::Index k) { return point.modes[static_cast<std::size_t>(k)]; };
  for (Eigen::Index k = 0; k < structure.Frequencies(); ++k) out[next++] = std::log(mode(k).omega);
  for (Eigen::Index k = 0; k < structure.Dampings(); ++k) out[next++] = std::log(mode(k).xi);
  for (Eigen::Index k = 0; k < structure.modes; ++k) out[next++] = mode(k).a;
  if (structure.complex_residues) {
    for (Eigen::Index k = 0; k < structure.modes; ++k) out[next++] = mode(k).b;
  }
  for (Eigen::Index k = 0; k < structure.modes; ++k) out[next++] = mode(k).g;
  for (Eigen::Index k = 0; k < structure.modes; ++k) out[next++] = mode(k).h;
  add_lines(point.acoustic_lines, structure.AcousticLines());
  out[next++] = std::log(point.path.tau);
  if (structure.Delays() > 1) out[next++] = std::log(point.path.rho);
  add(point.flame);
  add_lines(point.flame_lines, structure.FlameLines());
  for (const Eigen::VectorXd& source : point.noise) add(source);
  if (HasBackground(structure.noise)) out[next] = point.background_ratio;
  return out;
}

LoopResiduals TransfersOf(const RecordSpectra& record, const LoopPoint& point) {
  LoopResiduals out;
  out.r = Transfer(point, record.s);
  const double slope = record.slopes.dot(point.flame);
  out.f = slope * point.path.At(record.s).cwiseProduct(record.input);
  if (point.acoustic_lines.size() + point.flame_lines.size() > 0) {
    out.line_factors = LineFactors(record.s, point.acoustic_lines)
                           .cwiseProduct(LineFactors(record.s, point.flame_lines));
  }
  return out;
}

LoopResiduals ResidualsOf(const RecordSpectra& record, const PointStructure& structure,
                          const LoopPoint& point) {
  LoopResiduals out = TransfersOf(record, point);
  out.acoustic = Tapered(record.pressure -
                         AnswerOfAcoustics(record, point)
                             .cwiseProduct(LineFactors(record.edge_s, point.acoustic_lines)));
  out.flame = Tapered(record.heat_release -
                      point.path.At(record.edge_s)
                          .cwiseProduct(record.flame * point.flame)
                          .cwiseProduct(LineFactors(record.edge_s, point.flame_lines)));
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
  Eigen::MatrixXcd of_pressure =
      PressureColumns(structure, point, record.edge_s, record.heat_release);
  if (structure.acoustic_lines > 0) {
    of_pressure = LineFactors(record.edge_s, point.acoustic_lines).asDiagonal() * of_pressure;
    of_pressure.rightCols(structure.AcousticLines()) =
        LineColumns(record.edge_s, AnswerOfAcoustics(record, point), structure.acoustic_lines);
  }
  out.acoustic = -TaperedColumns(of_pressure);
  const Eigen::Index flame = point.flame.size();
  const Eigen::Index delays = structure.Delays();
  const Eigen::Index of_flame = delays + flame + structure.FlameLines();
  const Eigen::VectorXcd path = point.path.At(record.s).cwiseProduct(record.input);
  out.f.setZero(record.bins(), of_flame);
  const Eigen::VectorXcd sloped = record.slopes.dot(point.flame) * path;
  out.f.col(0) = sloped.cwiseProduct(ByLogTau(point.path, record.s));
  if (delays > 1) out.f.col(1) = sloped.cwiseProduct(ByLogRho(point.path, record.s));
  out.f.middleCols(delays, flame) = path * record.slopes.transpose();
  const Eigen::VectorXcd factors = LineFactors(record.edge_s, point.flame_lines);
  const Eigen::MatrixXcd delayed =
      point.path.At(record.edge_s).cwiseProduct(factors).asDiagonal() * record.flame;
  const Eigen::VectorXcd answer = delayed * point.flame;
  out.flame.resize(record.bins(), of_flame);
  out.flame.col(0) = -Tapered(answer.cwiseProduct(ByLogTau(point.path, record.edge_s)));
  if (delays > 1) {
    out.flame.col(1) = -Tapered(answer.cwiseProduct(ByLogRho(point.path, record.edge_s)));
  }
  out.flame.middleCols(delays, flame) = -TaperedColumns(delayed);
  out.flame.rightCols(structure.FlameLines()) = -TaperedColumns(
      LineColumns(record.edge_s, answer.cwiseQuotient(factors), structure.flame_lines));
  for (const NoiseTerm& term : structure.noise) {
    out.log_spectra.push_back(ChebyshevColumns(record.position, term.coefficients));
  }
  return out;
}

}  // namespace howl

#include "estimation/record_fit/loop/loop_point.h"

#include <cmath>
#include <complex>

#include "estimation/record_fit/loop/mode_slopes.h"
#include "model/numerics/complex_products.h"

namespace howl {
namespace {

using C = std::complex<double>;

Eigen::VectorXcd ComplexOf(const Eigen::VectorXd& parts) {
  const Eigen::Index count = parts.size() / 2;
  Eigen::VectorXcd out(count);
  out.real() = parts.head(count);
  out.imag() = parts.tail(count);
  return out;
}

template <typename Changes>
Eigen::Index Count(const PointStructure& structure, const Changes& changes) {
  Eigen::Index sum = 0;
  ForEachColumn(structure, changes, [&](Eigen::Index) { ++sum; });
  return sum;
}

}  // namespace

Eigen::Index PointStructure::AcousticChanges() const { return Count(*this, kAcousticChanges); }

Eigen::Index PointStructure::FlameChanges() const { return Count(*this, kFlameChanges); }

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
    mode.omega = std::exp(parameters[structure.Frequency(k)]);
    if (structure.ratio && k < structure.FirstModes()) mode.omega *= structure.RatioOf(k);
    mode.xi = std::exp(parameters[dampings + structure.Damping(k)]);
    mode.a = parameters[residues + k];
    if (structure.complex_residues) mode.b = parameters[residues + structure.modes + k];
    mode.g = parameters[structure.Transfer() + k];
    mode.h = parameters[structure.Transfer() + structure.modes + k];
    out.modes.push_back(mode);
  }
  out.acoustic_lines =
      ComplexOf(parameters.segment(structure.AcousticLine(), structure.AcousticLines()));
  Eigen::Index next = structure.AcousticChange();
  const auto take_changes = [&](const auto& changes) {
    for (const SlowChangeOfStructure& each : changes) {
      if (!(structure.*each.has)) continue;
      out.Change(each.change) = parameters.segment(next, ColumnsOf(each.change).count);
      next += ColumnsOf(each.change).count;
    }
  };
  take_changes(kAcousticChanges);
  out.path = {structure.delay_spread, std::exp(parameters[next++])};
  if (structure.HasSpread()) out.path.rho = std::exp(parameters[next++]);
  if (structure.second_path) {
    out.path.second = SecondPath{parameters[next], std::exp(parameters[next + 1])};
    next += 2;
  }
  out.flame = parameters.segment(next, flame);
  next += flame;
  out.flame_lines = ComplexOf(parameters.segment(next, structure.FlameLines()));
  next += structure.FlameLines();
  take_changes(kFlameChanges);
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
  const auto add_changes = [&](const auto& changes) {
    for (const SlowChangeOfStructure& each : changes) {
      if (structure.*each.has) add(point.Change(each.change));
    }
  };
  const auto mode = [&](Eigen::Index k) { return point.modes[static_cast<std::size_t>(k)]; };
  // Of modes that are tied, those of the first.
  for (Eigen::Index k = structure.modes - 1; k >= 0; --k) {
    out[structure.Frequency(k)] = std::log(mode(k).omega);
    out[structure.Frequencies() + structure.Damping(k)] = std::log(mode(k).xi);
  }
  next += structure.Frequencies() + structure.Dampings();
  for (Eigen::Index k = 0; k < structure.modes; ++k) out[next++] = mode(k).a;
  if (structure.complex_residues) {
    for (Eigen::Index k = 0; k < structure.modes; ++k) out[next++] = mode(k).b;
  }
  for (Eigen::Index k = 0; k < structure.modes; ++k) out[next++] = mode(k).g;
  for (Eigen::Index k = 0; k < structure.modes; ++k) out[next++] = mode(k).h;
  add_lines(point.acoustic_lines, structure.AcousticLines());
  add_changes(kAcousticChanges);
  out[next++] = std::log(point.path.tau);
  if (structure.HasSpread()) out[next++] = std::log(point.path.rho);
  if (structure.second_path) {
    out[next++] = point.path.second->share;
    out[next++] = std::log(point.path.second->lambda);
  }
  add(point.flame);
  add_lines(point.flame_lines, structure.FlameLines());
  add_changes(kFlameChanges);
  for (const Eigen::VectorXd& source : point.noise) add(source);
  if (HasBackground(structure.noise)) out[next] = point.background_ratio;
  return out;
}

Eigen::VectorXd BesideMiddle(const RecordSpectra& record, const PointStructure& structure,
                             Eigen::VectorXd parameters) {
  if (record.middle) parameters.segment(structure.Transfer(), structure.Transients()).setZero();
  return parameters;
}

C AcousticTransfer(const LoopPoint& point, C s) {
  C out = 0.0;
  for (const LoopMode& mode : point.modes) {
    out +=
        Times(mode.a * s + mode.b * mode.omega,
              Reciprocal(Times(s, s) + 2.0 * mode.xi * mode.omega * s + mode.omega * mode.omega));
  }
  return out;
}

void AddAcousticSlopes(const PointStructure& structure, const LoopPoint& point, C s, C by,
                       Eigen::VectorXd* out) {
  for (Eigen::Index k = 0; k < structure.modes; ++k) {
    ForEachSlope(structure, point, k, s,
                 [&](Eigen::Index i, C of_r, C) { (*out)[i] += Times(by, of_r).real(); });
  }
}

}  // namespace howl

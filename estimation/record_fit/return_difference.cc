#include "estimation/record_fit/return_difference.h"

#include <cmath>
#include <complex>

namespace howl {
namespace {

using C = std::complex<double>;

C WithoutSlope(const RecordSpectra& record, const LoopPoint& point, C s) {
  C r = 0.0;
  for (const LoopMode& mode : point.modes) {
    r += (mode.a * s + mode.b * mode.omega) /
         (s * s + 2.0 * mode.xi * mode.omega * s + mode.omega * mode.omega);
  }
  return r * std::exp(-point.tau * s) * FlameInputResponse(record.flame_input, s);
}

// Its derivatives by the acoustics' parameters and ln tau, times `by`, are added.
void AddSlopes(const RecordSpectra& record, const PointStructure& structure, const LoopPoint& point,
               C s, C value, C by, Eigen::VectorXd* out) {
  const C path = std::exp(-point.tau * s) * FlameInputResponse(record.flame_input, s);
  AddAcousticSlopes(structure, point, s, by * path, out);
  (*out)[structure.Delay()] -= (by * point.tau * s * value).real();
}

// The partner of a frequency that is 1 at the cycle; no partner above twice the cycle's.
C Partner(C s) { return C(0.0, 2.0) - s; }
bool HasPartner(C s) { return s.imag() < 2.0; }

}  // namespace

double LogDeterminant(const RecordSpectra& record, const LoopPoint& point) {
  const double phi_0 = record.slopes.dot(point.flame);
  const double square = std::norm((record.coupling.transpose() * point.flame).value());
  double sum = 0.0;
  for (Eigen::Index i = 0; i < record.bins(); ++i) {
    const C s = record.s[i];
    const C u = WithoutSlope(record, point, s);
    C d = (1.0 - phi_0 * u) * (1.0 - phi_0 * u);
    if (HasPartner(s)) {
      const C w = std::conj(WithoutSlope(record, point, Partner(s)));
      d = (1.0 - phi_0 * u) * (1.0 - phi_0 * w) - square * u * w;
    }
    sum += record.share[i] * std::log(std::abs(d));
  }
  return sum;
}

Eigen::VectorXd LogDeterminantGradient(const RecordSpectra& record, const PointStructure& structure,
                                       const LoopPoint& point) {
  const Eigen::Index flame = point.flame.size();
  const Eigen::Index loop = structure.Delay() + 1;
  const double phi_0 = record.slopes.dot(point.flame);
  const C phi_2 = (record.coupling.transpose() * point.flame).value();
  const double square = std::norm(phi_2);
  Eigen::VectorXd of_loop = Eigen::VectorXd::Zero(loop);
  double by_phi_0 = 0.0;
  double by_square = 0.0;
  for (Eigen::Index i = 0; i < record.bins(); ++i) {
    const C s = record.s[i];
    const C u = WithoutSlope(record, point, s);
    if (!HasPartner(s)) {
      const C over = -2.0 * record.share[i] / (1.0 - phi_0 * u);
      AddSlopes(record, structure, point, s, u, phi_0 * over, &of_loop);
      by_phi_0 += (over * u).real();
      continue;
    }
    const C partner = WithoutSlope(record, point, Partner(s));
    const C w = std::conj(partner);
    const C over = record.share[i] / ((1.0 - phi_0 * u) * (1.0 - phi_0 * w) - square * u * w);
    const C by_u = over * (-phi_0 * (1.0 - phi_0 * w) - square * w);
    const C by_w = over * (-phi_0 * (1.0 - phi_0 * u) - square * u);
    AddSlopes(record, structure, point, s, u, by_u, &of_loop);
    AddSlopes(record, structure, point, Partner(s), partner, std::conj(by_w), &of_loop);
    by_phi_0 -= (over * (u * (1.0 - phi_0 * w) + w * (1.0 - phi_0 * u))).real();
    by_square -= (over * u * w).real();
  }
  Eigen::VectorXd out = Eigen::VectorXd::Zero(loop + flame + structure.NoiseCoefficients());
  out.head(loop) = of_loop;
  out.segment(loop, flame) =
      by_phi_0 * record.slopes + 2.0 * by_square * (std::conj(phi_2) * record.coupling).real();
  return out;
}

}  // namespace howl

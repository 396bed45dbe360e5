#include "estimation/record_fit/return_difference.h"

#include <cmath>
#include <complex>

#include "model/numerics/complex_products.h"

namespace howl {
namespace {

using C = std::complex<double>;

// At s, e^(-tau s) V(s) and U: that times R.
struct LoopAt {
  LoopAt(const RecordSpectra& record, const LoopPoint& point, C at)
      : s(at),
        path(std::polar(std::exp(-point.tau * s.real()), -point.tau * s.imag()) *
             FlameInputResponse(record.flame_input, s)),
        u(AcousticTransfer(point, s) * path) {}

  // Adds the real part of `by` times dU, by the acoustics' parameters and ln tau.
  void AddSlopes(const PointStructure& structure, const LoopPoint& point, C by,
                 Eigen::VectorXd* out) const {
    AddAcousticSlopes(structure, point, s, by * path, out);
    (*out)[structure.Delay()] -= (by * point.tau * s * u).real();
  }

  C s;
  C path;
  C u;
};

// The partner of a frequency that is 1 at the cycle; no partner above twice the cycle's.
C Partner(C s) { return C(0.0, 2.0) - s; }
bool HasPartner(C s) { return s.imag() < 2.0; }

}  // namespace

C OpenLoop(const RecordSpectra& record, const LoopPoint& point, C s) {
  return LoopAt(record, point, s).u;
}

double LogDeterminant(const RecordSpectra& record, const LoopPoint& point) {
  const double phi_0 = record.slopes.dot(point.flame);
  const double square = std::norm((record.coupling.transpose() * point.flame).value());
  double sum = 0.0;
  for (Eigen::Index i = 0; i < record.bins(); ++i) {
    const C s = record.s[i];
    const C u = LoopAt(record, point, s).u;
    C d = (1.0 - phi_0 * u) * (1.0 - phi_0 * u);
    if (HasPartner(s)) {
      const C w = std::conj(LoopAt(record, point, Partner(s)).u);
      d = (1.0 - phi_0 * u) * (1.0 - phi_0 * w) - square * u * w;
    }
    sum += record.share[i] * std::log(std::abs(d));
  }
  return sum;
}

Eigen::VectorXd LogDeterminantGradient(const RecordSpectra& record, const PointStructure& structure,
                                       const LoopPoint& point) {
  const Eigen::Index flame = point.flame.size();
  const Eigen::Index parameters = structure.Delay() + 1;
  const double phi_0 = record.slopes.dot(point.flame);
  const C phi_2 = (record.coupling.transpose() * point.flame).value();
  const double square = std::norm(phi_2);
  Eigen::VectorXd of_loop = Eigen::VectorXd::Zero(parameters);
  double by_phi_0 = 0.0;
  double by_square = 0.0;
  for (Eigen::Index i = 0; i < record.bins(); ++i) {
    const C s = record.s[i];
    const LoopAt loop(record, point, s);
    const C u = loop.u;
    if (!HasPartner(s)) {
      const C over = -2.0 * record.share[i] * Reciprocal(1.0 - phi_0 * u);
      loop.AddSlopes(structure, point, phi_0 * over, &of_loop);
      by_phi_0 += (over * u).real();
      continue;
    }
    const LoopAt partner(record, point, Partner(s));
    const C w = std::conj(partner.u);
    const C over = record.share[i] *
                   Reciprocal(Times(1.0 - phi_0 * u, 1.0 - phi_0 * w) - square * Times(u, w));
    const C by_u = over * (-phi_0 * (1.0 - phi_0 * w) - square * w);
    const C by_w = over * (-phi_0 * (1.0 - phi_0 * u) - square * u);
    loop.AddSlopes(structure, point, by_u, &of_loop);
    partner.AddSlopes(structure, point, std::conj(by_w), &of_loop);
    by_phi_0 -= (over * (u * (1.0 - phi_0 * w) + w * (1.0 - phi_0 * u))).real();
    by_square -= (over * u * w).real();
  }
  Eigen::VectorXd out = Eigen::VectorXd::Zero(parameters + flame + structure.NoiseParameters());
  out.head(parameters) = of_loop;
  out.segment(parameters, flame) =
      by_phi_0 * record.slopes + 2.0 * by_square * (std::conj(phi_2) * record.coupling).real();
  return out;
}

}  // namespace howl

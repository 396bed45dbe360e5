#include "estimation/record_fit/spectra/curve_exponents.h"

#include <cmath>
#include <complex>

#include "estimation/record_fit/spectra/driven_flame.h"

namespace howl {
namespace {

// The splines reach two hundredths beyond the largest input.
constexpr double kLouder = 0.01;

RecordSpectra Louder(RecordSpectra record) {
  record.middle = nullptr;
  record.pressure *= 1.0 + kLouder;
  SetFlame((1.0 + kLouder) * record.driving, {}, &record);
  return record;
}

}  // namespace

Eigen::VectorXd CurveExponents(const RecordSpectra& record, const Eigen::VectorXd& flame) {
  const Eigen::VectorXcd answer = record.flame * flame;
  const Eigen::VectorXcd change = Louder(record).flame * flame - answer;
  const Eigen::VectorXd x = record.edge_s.imag();
  Eigen::VectorXd out = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(x[x.size() - 1]));
  for (Eigen::Index k = 0; k < out.size(); ++k) {
    std::complex<double> common = 0.0;
    double power = 0.0;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      if (std::abs(x[i] - static_cast<double>(k + 1)) > kBesideCycle) continue;
      common += std::conj(answer[i]) * change[i];
      power += std::norm(answer[i]);
    }
    if (power > 0.0) out[k] = std::abs(common) / (kLouder * power);
  }
  return out;
}

}  // namespace howl

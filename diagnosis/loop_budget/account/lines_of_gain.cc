#include "diagnosis/loop_budget/account/lines_of_gain.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include "estimation/record_fit/spectra/unitary_transform.h"

namespace howl {
namespace {

using C = std::complex<double>;

bool HasGain(const LoopForm& form) {
  return std::ranges::any_of(form.structure.noise, [](const NoiseTerm& term) {
    return term.source == LoopNoise::kFlameGain;
  });
}

// |x|^2 over time, of what of x lies about the line.
Eigen::VectorXd PowerAbout(double line, const Eigen::VectorXcd& edges,
                           const RecordSpectra& record) {
  const Eigen::Index instants = record.Instants();
  Eigen::VectorXcd spectrum = Eigen::VectorXcd::Zero(instants / 2 + 1);
  for (Eigen::Index i = 0; i < edges.size(); ++i) {
    if (std::abs(record.edge_s[i].imag() - line) < kLineReach) {
      spectrum[record.below.size() + i] = edges[i];
    }
  }
  return UnitarySignal(spectrum, instants).cwiseAbs2() +
         UnitarySignal(C(0.0, -1.0) * spectrum, instants).cwiseAbs2();
}

}  // namespace

LinesOfGain LinesOfGainIn(const LoopRecords& records, const LoopFit& fit) {
  if (!HasGain(fit.model)) return {};
  const std::vector<LoopPoint> points = PointsOf(records, fit);
  double power = 0.0;
  double missed = 0.0;
  double bound = 0.0;
  for (std::size_t e = 0; e < points.size(); ++e) {
    const LoopPoint& point = points[e];
    const RecordSpectra record = records.WholeAlone(fit.model, e);
    const Eigen::VectorXcd foretold =
        point.path.At(record.edge_s).cwiseProduct(record.flame * point.flame);
    const Eigen::VectorXcd left = record.heat_release - foretold;
    for (Eigen::Index h = 0; h < point.flame_lines.size(); ++h) {
      const auto line = static_cast<double>(h + 1);
      if (line + kLineReach > record.s[record.bins() - 1].imag()) break;
      const Eigen::VectorXd about = PowerAbout(line, foretold, record);
      const double mean = about.mean();
      if (!(mean > 0.0)) continue;
      const double fluctuates = 1.0 - std::pow(about.cwiseSqrt().mean(), 2) / mean;
      power += mean;
      missed += mean * std::norm(point.flame_lines[h]);
      bound += PowerAbout(line, left, record).mean() * std::max(fluctuates, 0.0);
    }
  }
  if (!(power > 0.0)) return {};
  return {std::sqrt(missed / power), std::sqrt(bound / power)};
}

}  // namespace howl

#include "diagnosis/loop_budget/account/lines_of_gain.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include "estimation/record_fit/loop/loop_residuals.h"
#include "estimation/record_fit/spectra/amplitude_about.h"

namespace howl {
namespace {

bool HasGain(const LoopForm& form) {
  return std::ranges::any_of(form.structure.noise, [](const NoiseTerm& term) {
    return term.source == LoopNoise::kFlameGain;
  });
}

// The record's bins that lie about a multiple of the cycle's frequency.
struct BinsAbout {
  BinsAbout(double multiple, const RecordSpectra& record) {
    for (Eigen::Index i = 0; i < record.edge_s.size(); ++i) {
      if (std::abs(record.edge_s[i].imag() - multiple) >= kLineReach) continue;
      if (count++ == 0) first = i;
    }
  }
  double PowerOf(const Eigen::VectorXcd& edges) const {
    return edges.segment(first, count).squaredNorm();
  }

  Eigen::Index first = 0;
  Eigen::Index count = 0;
};

// Of an amplitude its variance, over its mean square.
double Fluctuation(const Eigen::VectorXd& squared_amplitude) {
  const double mean = squared_amplitude.cwiseSqrt().mean();
  return std::max(1.0 - mean * mean / squared_amplitude.mean(), 0.0);
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
    const Eigen::VectorXcd foretold = AnswerOfFlame(record, point);
    const Eigen::VectorXcd left = record.heat_release - foretold;
    for (Eigen::Index h = 0; h < point.flame_lines.size(); ++h) {
      const auto line = static_cast<double>(h + 1);
      if (line + kLineReach > record.s[record.bins() - 1].imag()) break;
      const BinsAbout bins(line, record);
      const double of_line = bins.PowerOf(foretold);
      if (!(of_line > 0.0)) continue;
      power += of_line;
      missed += of_line * std::norm(point.flame_lines[h]);
      bound += bins.PowerOf(left) *
               Fluctuation(SquaredAmplitudeAbout(line, kLineReach, foretold, record));
    }
  }
  if (!(power > 0.0)) return {};
  return {std::sqrt(missed / power), std::sqrt(bound / power)};
}

}  // namespace howl

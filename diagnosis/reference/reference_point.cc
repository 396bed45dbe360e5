#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "diagnosis/reference/reference.h"

namespace howl {
namespace {

constexpr double kKernelWidth = 0.04;      // standard deviation, of the cycle's frequency
constexpr double kKernelReach = 3.0;       // standard deviations
constexpr Eigen::Index kPooledReach = 10;  // grid points on each side

// Sums over the bins near each grid point: add(weight, bin).
void Smooth(const CutRecord& record, Eigen::Index count, Eigen::Index grid,
            const std::function<void(Eigen::Index, double, Eigen::Index)>& add) {
  const double to_u = 1.0 / record.at.cycle_frequency_hz;
  // At least three bins wide.
  const double width = std::max(kKernelWidth, 3.0 * record.bin_hz * to_u);
  for (Eigen::Index i = 0; i < grid; ++i) {
    const double u = static_cast<double>(i) * kReferenceStep;
    const auto bin_of = [&](double at) {
      return static_cast<Eigen::Index>(std::llround(at / (to_u * record.bin_hz))) - record.first;
    };
    const Eigen::Index low = std::max<Eigen::Index>(bin_of(u - kKernelReach * width), 0);
    const Eigen::Index high = std::min(bin_of(u + kKernelReach * width) + 1, count);
    for (Eigen::Index k = low; k < high; ++k) {
      if (record.masked[static_cast<std::size_t>(k)]) continue;
      const double x = (record.frequency(k) * to_u - u) / width;
      add(i, std::exp(-0.5 * x * x), k);
    }
  }
}

// Beyond the band the factor is that at the band's end.
template <typename Vector>
void FillEnds(const std::vector<double>& weight, Vector* values) {
  const auto n = static_cast<Eigen::Index>(weight.size());
  Eigen::Index first = 0;
  while (first < n && weight[static_cast<std::size_t>(first)] <= 0.0) ++first;
  if (first == n) {
    values->setOnes();
    return;
  }
  for (Eigen::Index i = 0; i < first; ++i) (*values)[i] = (*values)[first];
  for (Eigen::Index i = first + 1; i < n; ++i) {
    if (weight[static_cast<std::size_t>(i)] <= 0.0) (*values)[i] = (*values)[i - 1];
  }
}

Eigen::VectorXd MovingMean(const Eigen::VectorXd& x) {
  Eigen::VectorXd out(x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const Eigen::Index from = std::max<Eigen::Index>(i - kPooledReach, 0);
    out[i] = x.segment(from, std::min(i + kPooledReach + 1, x.size()) - from).mean();
  }
  return out;
}

struct Cut {
  Eigen::VectorXcd factor;
  Eigen::VectorXd variance;  // of the factor; infinite beyond the band
  Eigen::VectorXd shape;
};

// Fits target ~ C(u) predicted with the noise V.
Cut Describe(const CutRecord& record, const Eigen::VectorXcd& target,
             const Eigen::VectorXcd& predicted, const Eigen::VectorXd& variance,
             Eigen::Index grid) {
  const Eigen::Index count = predicted.size();
  Cut out;
  out.factor.setZero(grid);
  out.shape.setZero(grid);
  out.variance.setZero(grid);
  std::vector<double> norm(static_cast<std::size_t>(grid), 0.0);
  std::vector<double> weight(static_cast<std::size_t>(grid), 0.0);
  Smooth(record, count, grid, [&](Eigen::Index i, double w, Eigen::Index k) {
    out.factor[i] += w * std::conj(predicted[k]) * target[k] / variance[k];
    norm[static_cast<std::size_t>(i)] += w * std::norm(predicted[k]) / variance[k];
    out.variance[i] += w * w * std::norm(predicted[k]) / variance[k];
  });
  for (Eigen::Index i = 0; i < grid; ++i) {
    const double n = norm[static_cast<std::size_t>(i)];
    if (n > 0.0) out.factor[i] /= n;
  }
  FillEnds(norm, &out.factor);
  Eigen::VectorXcd residual(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const double u = record.frequency(k) / record.at.cycle_frequency_hz / kReferenceStep;
    const auto i = std::min(static_cast<Eigen::Index>(u), grid - 2);
    const double way = std::min(u - static_cast<double>(i), 1.0);
    residual[k] =
        target[k] - ((1.0 - way) * out.factor[i] + way * out.factor[i + 1]) * predicted[k];
  }
  Eigen::VectorXd white = Eigen::VectorXd::Zero(grid);  // |E|^2 over V
  Smooth(record, count, grid, [&](Eigen::Index i, double w, Eigen::Index k) {
    out.shape[i] += w * std::norm(residual[k]);
    white[i] += w * std::norm(residual[k]) / variance[k];
    weight[static_cast<std::size_t>(i)] += w;
  });
  for (Eigen::Index i = 0; i < grid; ++i) {
    const double w = weight[static_cast<std::size_t>(i)];
    const double n = norm[static_cast<std::size_t>(i)];
    if (w > 0.0) out.shape[i] = std::max(out.shape[i] / w, 1e-300);
    out.variance[i] = n > 0.0 ? kBinCorrelation * white[i] / w * out.variance[i] / (n * n)
                              : std::numeric_limits<double>::infinity();
  }
  FillEnds(weight, &out.shape);
  return out;
}

// Estimates of one factor at several operating points carry noise, and a prediction with a noisy
// factor is too large. Each estimate is therefore shrunk towards the points' mean, as far as the
// points do not differ by more than their noise, and the mean towards zero where it is no more than
// noise (empirical Bayes, over kPooledReach of u).
void Pool(std::vector<Cut>* cuts) {
  const Eigen::Index grid = (*cuts)[0].factor.size();
  const auto points = static_cast<double>(cuts->size());
  Eigen::VectorXcd mean = Eigen::VectorXcd::Zero(grid);
  Eigen::VectorXd mean_variance(grid);
  Eigen::VectorXd spread = Eigen::VectorXd::Zero(grid);
  for (Eigen::Index i = 0; i < grid; ++i) {
    double weight = 0.0;
    for (const Cut& cut : *cuts) {
      mean[i] += cut.factor[i] / cut.variance[i];
      weight += 1.0 / cut.variance[i];
    }
    mean_variance[i] = 1.0 / std::max(weight, 1e-300);
    mean[i] *= mean_variance[i];
    for (const Cut& cut : *cuts) {
      if (!std::isfinite(cut.variance[i])) continue;
      spread[i] += (std::norm(cut.factor[i] - mean[i]) - cut.variance[i]) / points;
    }
  }
  const Eigen::VectorXd difference = MovingMean(spread).cwiseMax(0.0);
  const Eigen::VectorXd power = MovingMean(mean.cwiseAbs2());
  const Eigen::VectorXd noise = MovingMean(mean_variance.cwiseMin(1e6));
  for (Eigen::Index i = 0; i < grid; ++i) {
    const double shared = std::max(0.0, 1.0 - noise[i] / std::max(power[i], 1e-300));
    for (Cut& cut : *cuts) {
      if (!std::isfinite(cut.variance[i])) continue;
      const double own = cuts->size() > 1
                             ? difference[i] / std::max(difference[i] + cut.variance[i], 1e-300)
                             : 0.0;
      cut.factor[i] = shared * mean[i] + own * (cut.factor[i] - mean[i]);
    }
  }
}

template <typename Vector>
auto OnGrid(const Vector& values, double frequency_hz, double cycle_hz) {
  const double u = frequency_hz / cycle_hz / kReferenceStep;
  const auto i = std::min(static_cast<Eigen::Index>(u), values.size() - 2);
  const double way = std::min(u - static_cast<double>(i), 1.0);
  return (1.0 - way) * values[i] + way * values[i + 1];
}

}  // namespace

std::vector<ReferencePoint> DescribeReference(const std::vector<DiagnosisExperiment>& experiments,
                                              const std::vector<CutRecord>& records,
                                              const EffectFit& base) {
  double highest = 0.0;
  for (const CutRecord& record : records) {
    highest = std::max(highest,
                       record.frequency(record.acoustic_count - 1) / record.at.cycle_frequency_hz);
  }
  const auto grid = static_cast<Eigen::Index>(std::ceil(highest / kReferenceStep)) + 2;
  std::vector<Cut> acoustic;
  std::vector<Cut> flame;
  for (std::size_t e = 0; e < records.size(); ++e) {
    const CutRecord& record = records[e];
    const ExperimentFit& at = base.experiments[e];
    const Eigen::Index n = record.flame_count;
    acoustic.push_back(Describe(record, record.windowed_pressure,
                                record.windowed_pressure - at.acoustic_residual, at.acoustic_noise,
                                grid));
    flame.push_back(Describe(record, record.windowed_heat_release.head(n),
                             record.windowed_heat_release.head(n) - at.flame_residual,
                             at.flame_noise, grid));
  }
  Pool(&acoustic);
  Pool(&flame);
  std::vector<ReferencePoint> points;
  for (std::size_t e = 0; e < records.size(); ++e) {
    points.push_back({experiments[e].name, experiments[e].phi, acoustic[e].factor, flame[e].factor,
                      acoustic[e].shape, flame[e].shape, base.experiments[e].acoustics,
                      base.tau_s});
  }
  return points;
}

ReferencePoint PointAt(const std::vector<ReferencePoint>& points, const std::string& name,
                       double phi) {
  const ReferencePoint* below = nullptr;
  const ReferencePoint* above = nullptr;
  for (const ReferencePoint& point : points) {
    if (point.name == name || IsSamePhi(point.phi, phi)) {
      return point;
    }
    if (point.phi < phi && (!below || point.phi > below->phi)) below = &point;
    if (point.phi > phi && (!above || point.phi < above->phi)) above = &point;
  }
  CHECK(below || above);  // there is a point
  if (!above) return *below;
  if (!below) return *above;
  const double way = (phi - below->phi) / (above->phi - below->phi);
  ReferencePoint out = *below;
  const Eigen::Index n = std::min(below->acoustic.size(), above->acoustic.size());
  const auto mix = [&](const auto& a, const auto& b) {
    return ((1.0 - way) * a.head(n) + way * b.head(n)).eval();
  };
  const auto mix_logs = [&](const Eigen::VectorXd& a, const Eigen::VectorXd& b) -> Eigen::VectorXd {
    return ((1.0 - way) * a.head(n).array().log() + way * b.head(n).array().log()).exp();
  };
  out.acoustic = mix(below->acoustic, above->acoustic);
  out.flame = mix(below->flame, above->flame);
  out.locals = (1.0 - way) * below->locals + way * above->locals;
  out.acoustic_shape = mix_logs(below->acoustic_shape, above->acoustic_shape);
  out.flame_shape = mix_logs(below->flame_shape, above->flame_shape);
  return out;
}

void PutReference(const ReferencePoint& point, CutRecord* record) {
  CutReference& out = record->reference;
  const double cycle = record->at.cycle_frequency_hz;
  const Eigen::Index extended = record->extended();
  const Eigen::Index flame = record->flame_count + 2 * kTapReach;
  out.acoustics = point.locals;
  out.tau_s = point.tau_s;
  out.acoustic.resize(extended);
  out.flame.resize(flame);
  for (Eigen::Index k = 0; k < extended; ++k) {
    out.acoustic[k] = OnGrid(point.acoustic, record->frequency_hz[k], cycle);
    if (k < flame) out.flame[k] = OnGrid(point.flame, record->frequency_hz[k], cycle);
  }
  out.acoustic_shape.resize(record->acoustic_count);
  out.flame_shape.resize(record->flame_count);
  for (Eigen::Index k = 0; k < record->acoustic_count; ++k) {
    out.acoustic_shape[k] = OnGrid(point.acoustic_shape, record->frequency(k), cycle);
    if (k < record->flame_count) {
      out.flame_shape[k] = OnGrid(point.flame_shape, record->frequency(k), cycle);
    }
  }
}

}  // namespace howl

#include "diagnosis/static_map.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "diagnosis/noise_fit.h"
#include "diagnosis/real_fft.h"

namespace howl {
namespace {

constexpr double kTopQuantile = 0.995;
constexpr double kDepth = 0.04;  // of the threshold below the top, over the amplitude
constexpr int kIterations = 5;
constexpr int kRounds = 3;
constexpr double kEdgeWidth = 0.02;
constexpr double kEdgeRatio = 5.0;
constexpr double kEdgeShare = 0.03;
constexpr std::size_t kMostLevels = 300;

double Quantile(const Eigen::VectorXd& x, double share) {
  std::vector<double> values(x.data(), x.data() + x.size());
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

// Many samples just below the extreme, few a little further down.
bool EdgeAt(const Eigen::VectorXd& x, double range) {
  const double top = Quantile(x, 0.9995);
  const double width = kEdgeWidth * 0.5 * range;
  const double near = static_cast<double>((x.array() > top - width).count());
  const double below = static_cast<double>(
      (x.array() > top - 3.0 * width && x.array() <= top - 2.0 * width).count());
  return near > kEdgeRatio * std::max(below, 1.0) &&
         near > kEdgeShare * static_cast<double>(x.size());
}

bool SharpEdge(const Eigen::VectorXd& x) {
  const double range = Quantile(x, 0.9995) - Quantile(x, 0.0005);
  return EdgeAt(x, range) && EdgeAt(-x, range);
}

Eigen::MatrixXcd ExcessColumns(const CutRecord& record, bool pressure) {
  const Eigen::VectorXd& x = pressure ? record.pressure : record.heat_release;
  const double amplitude = 0.5 * (Quantile(x, kTopQuantile) - Quantile(x, 1.0 - kTopQuantile));
  Eigen::MatrixXcd columns(record.extended(), 2);
  for (const int sign : {1, -1}) {
    const double threshold = Quantile(sign * x, kTopQuantile) - kDepth * amplitude;
    const Eigen::VectorXd excess = sign * (sign * x.array() - threshold).max(0.0).matrix();
    columns.col(sign > 0 ? 0 : 1) =
        ForwardFft(excess).segment(record.first - kTapReach, record.extended());
  }
  return columns;
}

}  // namespace

ClippingFit FitClipping(const std::vector<CutRecord>& records, bool pressure,
                        const EffectFit& base) {
  ClippingFit out;
  out.fit = base;
  double cost = 0.0;
  double expansion = 0.0;
  std::size_t edges = 0;
  const Effect& none = *base.effect;
  for (std::size_t e = 0; e < records.size(); ++e) {
    const CutRecord& record = records[e];
    ExperimentFit& at = out.fit.experiments[e];
    if (SharpEdge(pressure ? record.pressure : record.heat_release)) ++edges;
    const Eigen::MatrixXcd excess = ExcessColumns(record, pressure);
    Eigen::Vector2d c = Eigen::Vector2d::Zero();
    const auto columns = [&]() {
      Eigen::MatrixXcd windowed(record.acoustic_count, 2);
      const Eigen::VectorXcd r = RecordedTransfer(record, none, {}, at.acoustics);
      for (int j = 0; j < 2; ++j) {
        windowed.col(j) = pressure
                              ? ApplyWindow(excess.col(j), record.acoustic_count)
                              : ApplyWindow(-r.cwiseProduct(excess.col(j)), record.acoustic_count);
      }
      return windowed;
    };
    for (int round = 0; round < kRounds; ++round) {
      Eigen::VectorXd weight = at.acoustic_noise.cwiseInverse();
      for (Eigen::Index k = 0; k < weight.size(); ++k) {
        if (record.masked[static_cast<std::size_t>(k)]) weight[k] = 0.0;
      }
      for (int i = 0; i < kIterations; ++i) {
        const Eigen::VectorXcd bare = AcousticResidual(record, none, {}, at.acoustics);
        const Eigen::MatrixXcd extra = columns();
        const Eigen::VectorXcd residual = bare + extra * c;
        Eigen::MatrixXcd jacobian(record.acoustic_count, 6);
        jacobian.leftCols(4) =
            AcousticJacobian(record, none, {}, at.acoustics, bare, Eigen::VectorXd());
        jacobian.rightCols(2) = extra;
        const Eigen::MatrixXcd weighted = weight.asDiagonal() * jacobian;
        Eigen::MatrixXd gram = (weighted.adjoint() * jacobian).real();
        const Eigen::VectorXd right = (weighted.adjoint() * residual).real();
        const Eigen::VectorXd scale = gram.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
        gram = (scale.asDiagonal() * gram * scale.asDiagonal()).eval();
        gram.diagonal().array() += 1e-9;
        Eigen::VectorXd step = -scale.cwiseProduct(gram.ldlt().solve(scale.cwiseProduct(right)));
        step[0] = std::clamp(step[0], -0.1, 0.1);
        step[1] = std::clamp(step[1], -0.5, 0.5);
        at.acoustics += step.head<4>();
        c += step.tail<2>();
      }
      at.acoustic_residual = AcousticResidual(record, none, {}, at.acoustics) + columns() * c;
      const Eigen::VectorXcd r = RecordedTransfer(record, none, {}, at.acoustics);
      at.acoustic_noise =
          AcousticNoise(at.acoustic_residual,
                        r.segment(kTapReach, record.acoustic_count).cwiseAbs2(), record.masked);
    }
    cost += WhittleCost(at.acoustic_residual, at.acoustic_noise, record.masked);
    expansion += c.mean() / static_cast<double>(records.size());
  }
  out.fit.acoustic_cost = cost;
  out.gain = expansion > 0.0 ? std::max(0.0, base.acoustic_cost - cost) : 0.0;
  // The lost top is c times the threshold's depth.
  out.fraction = 1.0 / (1.0 + std::max(expansion, 0.0) * kDepth);
  out.sharp_edge = 2 * edges > records.size();
  return out;
}

FewLevels FindQuantisation(const std::vector<CutRecord>& records) {
  FewLevels out;
  std::size_t found = 0;
  for (const CutRecord& record : records) {
    std::vector<double> values(record.pressure.data(),
                               record.pressure.data() + record.pressure.size());
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    if (values.size() > kMostLevels || values.size() < 2) continue;
    ++found;
    std::vector<double> steps;
    for (std::size_t i = 1; i < values.size(); ++i) steps.push_back(values[i] - values[i - 1]);
    std::nth_element(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2),
                     steps.end());
    out.levels += (values.back() - values.front()) / steps[steps.size() / 2] + 1.0;
  }
  out.found = 2 * found > records.size();
  if (found > 0) out.levels /= static_cast<double>(found);
  return out;
}

}  // namespace howl

#include "diagnosis/budget/items/item_parameters.h"

#include <glog/logging.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "diagnosis/budget/items/item_removal.h"
#include "diagnosis/fit/fitter.h"

namespace howl {
namespace {

EstimatedParameter OverPoints(const std::string& name, const std::string& unit,
                              const std::vector<double>& values) {
  double mean = 0.0;
  for (const double value : values) mean += value / static_cast<double>(values.size());
  const auto [low, high] = std::ranges::minmax(values);
  return {name, mean, low, high, unit};
}

// The source's amplitude in the recorded signal where it enters, over the signal's.
double RelativeAmplitude(const JointBand& band, const StructureFit& fit, const PointLoop& point,
                         std::size_t term) {
  const NoiseTerm& noise = fit.structure.noise[term];
  const bool in_pressure = noise.source == LoopNoise::kPressureSensor;
  const double signal = in_pressure ? band.pressure.squaredNorm() : band.heat_release.squaredNorm();
  return std::sqrt(LoopNoiseSpectrum(band.log_frequency, point.noise[term]).sum() / signal);
}

std::vector<EstimatedParameter> OfEffect(const StructureFit& fit, const EffectPlace& place) {
  std::size_t first = place.first_value;
  const Eigen::MatrixXd& information = fit.shared_information;
  const Eigen::MatrixXd covariance =
      information.ldlt().solve(Eigen::MatrixXd::Identity(information.rows(), information.cols()));
  std::vector<EstimatedParameter> out;
  for (const EffectParameter& p : fit.structure.effects[place.number]->parameters()) {
    const double value = fit.shared.values[first];
    const auto k = static_cast<Eigen::Index>(first) + 1;
    const double in_search = std::sqrt(std::max(covariance(k, k), 0.0));
    out.push_back(WithError(p, value, in_search * ScaleOf(p, value)));
    ++first;
  }
  return out;
}

}  // namespace

std::vector<EstimatedParameter> ItemParameters(const std::vector<JointBand>& bands,
                                               const StructureFit& fit,
                                               const std::vector<BudgetItem>& items,
                                               std::size_t which) {
  const BudgetItem& item = items[which];
  std::size_t number = 0;  // among the items of its kind
  for (std::size_t i = 0; i < which; ++i) number += items[i].kind == item.kind ? 1 : 0;
  std::vector<double> first;
  std::vector<double> second;
  switch (item.kind) {
    case ItemKind::kNoise: {
      const auto term =
          std::ranges::find(fit.structure.noise, item.noise.source, &NoiseTerm::source);
      CHECK(term != fit.structure.noise.end());
      for (std::size_t e = 0; e < bands.size(); ++e) {
        first.push_back(
            RelativeAmplitude(bands[e], fit, fit.points[e],
                              static_cast<std::size_t>(term - fit.structure.noise.begin())));
      }
      return {OverPoints("rel_rms", "", first)};
    }
    case ItemKind::kComplexResidues:
      for (const PointLoop& point : fit.points) {
        first.push_back(std::atan2(point.base_b[0], point.acoustics[2] / point.residue_scale) *
                        180.0 / std::numbers::pi);
      }
      return {OverPoints("residue_deg", "deg", first)};
    case ItemKind::kMode:
      for (const PointLoop& point : fit.points) {
        first.push_back(std::exp(point.modes[number][0]));
        second.push_back(std::exp(point.modes[number][1]));
      }
      return {OverPoints("frequency_hz", "Hz", first), OverPoints("zeta", "", second)};
    case ItemKind::kEffect:
      break;
  }
  return OfEffect(fit, PlaceOf(fit, item));
}

}  // namespace howl

#include "diagnosis/loop_budget/account/loop_item_parameters.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "diagnosis/loop_budget/account/change_values.h"
#include "diagnosis/loop_budget/trials/shared_effect_trial.h"
#include "estimation/record_fit/loop/loop_residuals.h"
#include "estimation/record_fit/whittle/noise_shape.h"

namespace howl {
namespace {

constexpr double kBetweenMemories = 2.0;  // of a flame's gain (loop_item.cc): half way
constexpr double kDegrees = 180.0 / std::numbers::pi;

// Of hum or a tone, which are no noise but oscillations: what is expected of it, given the record
// (Wiener's filter). j: of the sources.
double LinesPower(const RecordSpectra& record, const PointStructure& structure,
                  const LoopPoint& point, std::size_t j) {
  const LoopNoise source = structure.noise[j].source;
  const LoopResiduals left = ResidualsOf(record, structure, point);
  double power = 0.0;
  for (Eigen::Index i = 0; i < record.bins(); ++i) {
    const NoiseDirection u = DirectionOf(source, left.r[i], left.f[i], left.background_ratio);
    const Eigen::Vector2cd weighed = NoiseCovariance(structure.noise, left, i).inverse() *
                                     Eigen::Vector2cd(left.acoustic[i], left.flame[i]);
    power += std::norm(left.spectra(i, static_cast<Eigen::Index>(j)) *
                       (std::conj(u.acoustic) * weighed[0] + std::conj(u.flame) * weighed[1]));
  }
  return power;
}

// The root mean square of what a source adds to its signal, over that of the signal: each bin of a
// tapered spectrum stands for both signs of its frequency, and the taper doubles the power.
double RelativeAmplitude(const RecordSpectra& record, const PointStructure& structure,
                         const LoopPoint& point, LoopNoise source) {
  const auto at = std::ranges::find(structure.noise, source, &NoiseTerm::source);
  const auto j = static_cast<std::size_t>(at - structure.noise.begin());
  const double power = HasLines(source) ? LinesPower(record, structure, point, j)
                                        : NoiseSpectrum(*at, record, point.noise[j]).sum();
  return std::sqrt(power * record.bin_hz / record.sampling_hz);
}

}  // namespace

std::vector<EstimatedParameter> LoopItemParameters(const LoopRecords& records, const LoopFit& fit,
                                                   const LoopItem& item, std::size_t mode,
                                                   const LoopBudgetOptions& options) {
  std::vector<EstimatedParameter> out;
  const auto add = [&](const std::string& name, const std::string& unit, const auto& value_of) {
    EstimatedParameter parameter{name, 0.0, 0.0, 0.0, unit};
    for (std::size_t e = 0; e < records.size(); ++e) {
      const RecordSpectra record = records.Whole(fit.model, e);
      const double value = value_of(
          record, ToPoint(fit.model.structure, record.flame.cols(), fit.fit.points[e].parameters));
      parameter.low = e == 0 ? value : std::min(parameter.low, value);
      parameter.high = e == 0 ? value : std::max(parameter.high, value);
      parameter.value += value / static_cast<double>(records.size());
    }
    out.push_back(std::move(parameter));
  };
  const auto mode_hz = [&](std::size_t k) {
    return [k](const RecordSpectra& record, const LoopPoint& point) {
      return point.modes[k].omega * record.scale.cycle_hz;
    };
  };
  const auto xi_of = [](std::size_t k) {
    return [k](const RecordSpectra&, const LoopPoint& point) { return point.modes[k].xi; };
  };
  switch (item.kind) {
    case LoopItemKind::kNoise:
      add("amplitude", "", [&](const RecordSpectra& record, const LoopPoint& point) {
        const double of_signal =
            RelativeAmplitude(record, fit.model.structure, point, item.noise.source);
        return item.noise.before_curve ? of_signal / AnswerToGain(item.noise, record) : of_signal;
      });
      if (HasLines(item.noise.source)) {
        const double hz = item.noise.line_hz;
        out.push_back({"hz", hz, hz, hz, "Hz"});
      }
      if (item.noise.source == LoopNoise::kFlameGain) {
        add("correlation_s", "s", [&](const RecordSpectra& record, const LoopPoint&) {
          return item.noise.memory_cycles / record.scale.cycle_hz;
        });
        // As far as the next one that is tried.
        out.back().low /= kBetweenMemories;
        out.back().high *= kBetweenMemories;
      }
      break;
    case LoopItemKind::kNoiseShape:
      break;
    case LoopItemKind::kDetuning:
      add("ratio", "", [](const RecordSpectra&, const LoopPoint& point) {
        return point.modes[1].omega / point.modes[0].omega;
      });
      break;
    case LoopItemKind::kOwnDamping:
      add("xi_1", "", xi_of(0));
      add("xi_2", "", xi_of(1));
      break;
    case LoopItemKind::kComplexResidues:
      add("angle_1", "deg", [](const RecordSpectra&, const LoopPoint& point) {
        return kDegrees * std::atan2(point.modes[0].b, point.modes[0].a);
      });
      break;
    case LoopItemKind::kMode:
      add("omega_hz", "Hz", mode_hz(mode));
      add("xi", "", xi_of(mode));
      break;
    case LoopItemKind::kDelaySpread:
      add("sigma_s", "s", [](const RecordSpectra& record, const LoopPoint& point) {
        return point.path.rho * point.path.tau / record.scale.AngularFrequency();
      });
      break;
    case LoopItemKind::kSecondPath:
      add("share", "",
          [](const RecordSpectra&, const LoopPoint& point) { return point.path.second->share; });
      add("extra_s", "s", [](const RecordSpectra& record, const LoopPoint& point) {
        return point.path.second->lambda / record.scale.AngularFrequency();
      });
      break;
    case LoopItemKind::kFlameInput:
      add("tau_s", "s", [](const RecordSpectra& record, const LoopPoint& point) {
        return point.path.tau / record.scale.AngularFrequency();
      });
      break;
    case LoopItemKind::kSlowChange: {
      const PointValue value = ValueOfChange(item);
      add(value.name, "", value.of);
      break;
    }
    case LoopItemKind::kLineErrors:
      add("rms", "", [&](const RecordSpectra&, const LoopPoint& point) {
        const Eigen::VectorXcd& errors = item.lines == &PointStructure::acoustic_lines
                                             ? point.acoustic_lines
                                             : point.flame_lines;
        return std::sqrt(errors.cwiseAbs2().mean());
      });
      break;
    case LoopItemKind::kSharedEffect:
      return EstimateSharedEffect(records, fit, item, "best/", options);
  }
  return out;
}

}  // namespace howl

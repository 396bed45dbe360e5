#include "estimation/joint_records/shared_units.h"

#include <cmath>
#include <limits>

namespace howl {

SharedUnits::SharedUnits(const PointStructure& structure, const RecordSpectra& record,
                         const ReferenceUnits& reference) {
  for (Eigen::Index i = 0; i < structure.Transfer(); ++i) index_.push_back(i);
  const auto delay = static_cast<Eigen::Index>(index_.size());
  for (Eigen::Index i = structure.Delay(); i < structure.Flame(); ++i) index_.push_back(i);
  const Eigen::Index noise = structure.Noise(record.flame.cols());
  for (Eigen::Index i = 0; i < structure.NoiseParameters(); ++i) index_.push_back(noise + i);
  const auto changes = static_cast<Eigen::Index>(index_.size());
  for (Eigen::Index i = 0; i < structure.AcousticChanges(); ++i) {
    index_.push_back(structure.AcousticChange() + i);
  }
  for (Eigen::Index i = 0; i < structure.FlameChanges(); ++i) {
    index_.push_back(structure.FlameChange(record.flame.cols()) + i);
  }
  const auto add_errors = [&](Eigen::Index first, Eigen::Index count) {
    if (count == 0) return;
    errors_.push_back({static_cast<Eigen::Index>(index_.size()), count});
    for (Eigen::Index i = 0; i < count; ++i) index_.push_back(first + i);
  };
  add_errors(structure.AcousticLine(), structure.AcousticLines());
  add_errors(structure.FlameLine(record.flame.cols()), structure.FlameLines());
  const auto size = static_cast<Eigen::Index>(index_.size());
  scale_ = Eigen::VectorXd::Ones(size);
  shift_ = Eigen::VectorXd::Zero(size);
  const double cycle = record.scale.cycle_hz / reference.cycle_hz;
  const double pressure = record.scale.pressure / reference.pressure;
  const double heat_release = record.scale.heat_release / reference.heat_release;
  shift_.head(structure.Frequencies()).setConstant(std::log(cycle));
  scale_.segment(structure.Frequencies() + structure.Dampings(), structure.Residues())
      .setConstant(cycle * pressure / heat_release);
  shift_[delay] = -std::log(cycle);
  Eigen::Index next = delay + structure.Delays();
  if (structure.second_path) shift_[next - 1] = -std::log(cycle);
  for (const NoiseTerm& term : structure.noise) {
    const double unit = IsOfPressure(term.source) ? pressure : heat_release;
    shift_[next] = 2.0 * std::log(unit) - std::log(record.sampling_hz / reference.sampling_hz);
    next += term.coefficients;
  }
  if (HasBackground(structure.noise)) scale_[next] = pressure / heat_release;
  next = changes;
  const auto set_unit = [&](bool has, SlowChange change, double unit) {
    if (!has) return;
    scale_.segment(next, ColumnsOf(change).count).setConstant(unit);
    next += ColumnsOf(change).count;
  };
  set_unit(structure.damping_follows_amplitude, SlowChange::kDamping, heat_release / pressure);
  set_unit(structure.frequency_drifts, SlowChange::kFrequency, cycle * heat_release / pressure);
  set_unit(structure.delay_follows_amplitude, SlowChange::kDelay, 1.0 / cycle);
  set_unit(structure.gain_follows_amplitude, SlowChange::kGain, 1.0);
}

Eigen::VectorXd SharedUnits::ToCommon(const Eigen::VectorXd& parameters) const {
  Eigen::VectorXd out(size());
  for (Eigen::Index i = 0; i < size(); ++i) {
    out[i] = scale_[i] * parameters[IndexOf(i)] + shift_[i];
  }
  return out;
}

Eigen::VectorXd SharedUnits::FromCommon(const Eigen::VectorXd& common,
                                        const Eigen::VectorXd& base) const {
  Eigen::VectorXd out = base;
  for (Eigen::Index i = 0; i < size(); ++i) out[IndexOf(i)] = (common[i] - shift_[i]) / scale_[i];
  return out;
}

PointPrior SharedUnits::FromCommon(const PointPrior& common, const PointPrior& base) const {
  PointPrior out{FromCommon(common.mean, base.mean), base.deviation, {}, {}};
  if (common.degrees.size() > 0) {
    out.degrees =
        Eigen::VectorXd::Constant(base.mean.size(), std::numeric_limits<double>::infinity());
    for (Eigen::Index i = 0; i < size(); ++i) out.degrees[IndexOf(i)] = common.degrees[i];
    out.widest = base.deviation;
    for (Eigen::Index i = 0; i < size(); ++i) {
      out.widest[IndexOf(i)] = common.widest[i] / scale_[i];
    }
  }
  for (Eigen::Index i = 0; i < size(); ++i)
    out.deviation[IndexOf(i)] = common.deviation[i] / scale_[i];
  return out;
}

PointPrior SharedUnits::ToCommon(const PointPrior& prior) const {
  PointPrior out{ToCommon(prior.mean), Eigen::VectorXd(size()), {}, {}};
  for (Eigen::Index i = 0; i < size(); ++i)
    out.deviation[i] = prior.deviation[IndexOf(i)] * scale_[i];
  return out;
}

}  // namespace howl

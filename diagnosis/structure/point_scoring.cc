#include "diagnosis/structure/point_scoring.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "diagnosis/fit/fitter.h"
#include "diagnosis/structure/structure_priors.h"

namespace howl {
namespace {

constexpr double kStep = 1e-5;  // of differences, in parameters without unit

double Normal(double x, double deviation) {
  return -0.5 * x * x / (deviation * deviation) -
         std::log(deviation * std::sqrt(2.0 * std::numbers::pi));
}

// The residuals at the fit's parameters, and the derivatives of residuals and likelihood by each
// parameter.
class Moved {
 public:
  Moved(const JointBand& band, const Effect& effect, const std::vector<NoiseTerm>& noise,
        const SharedLoop& shared, const PointLoop& point, const JointResiduals& now,
        Eigen::Index parameters)
      : band_(band),
        effect_(effect),
        now_(now),
        here_(Evaluate(band, noise, shared, point, now_)),
        adjoint_(AdjointOf(band, noise, point, now_, here_)),
        slope_(now_.flame->slopes.dot(here_.flame)),
        left_(now_.flame->target - now_.flame->columns * here_.flame),
        columns_(Eigen::MatrixXcd::Zero(2 * band.count, parameters)),
        gradient_(Eigen::VectorXd::Zero(parameters)) {}

  void Add(const SharedLoop& shared, const PointLoop& point, const Moves& moves, double step) {
    const JointResiduals there = MoveJointResiduals(band_, effect_, shared, point, moves, now_);
    double sum = 0.0;
    if (moves.acoustic) {
      auto column = columns_.col(count_).head(band_.count);
      column = (there.acoustic->residual - now_.acoustic->residual) / step;
      sum += adjoint_.r.cwiseProduct(there.acoustic->r - now_.acoustic->r).sum().real() / step;
      sum += adjoint_.acoustic.cwiseProduct(column).sum().real();
    }
    if (moves.flame) {
      auto column = columns_.col(count_).tail(band_.count);
      column = (there.flame->target - there.flame->columns * here_.flame - left_) / step;
      const double slope = there.flame->slopes.dot(here_.flame);
      const Eigen::VectorXcd f = (slope * there.flame->path - slope_ * now_.flame->path).array() +
                                 (there.flame->leak - now_.flame->leak);
      sum += adjoint_.f.cwiseProduct(f).sum().real() / step;
      sum += adjoint_.flame.cwiseProduct(column).sum().real();
    }
    gradient_[count_++] = sum;
  }

  Eigen::MatrixXd Information() const { return MeanInformation(band_, now_, here_, columns_); }
  const Eigen::VectorXd& gradient() const { return gradient_; }
  const JointEvaluation& here() const { return here_; }

 private:
  const JointBand& band_;
  const Effect& effect_;
  const JointResiduals& now_;
  JointEvaluation here_;
  JointAdjoint adjoint_;
  double slope_;
  Eigen::VectorXcd left_;
  Eigen::MatrixXcd columns_;
  Eigen::VectorXd gradient_;
  Eigen::Index count_ = 0;
};

void AddOwn(const PointLayout& layout, const Effect& effect, const SharedLoop& shared,
            const PointLoop& point, Moved* moved) {
  for (Eigen::Index i = 0; i < layout.Loop(); ++i) {
    PointLoop there = point;
    MoveOwn(layout, i, kStep, &there);
    const bool delay = i >= layout.Acoustics();
    moved->Add(shared, there, {!delay, delay, delay && effect.ModulatesDelay()}, kStep);
  }
}

void AddShared(const PointLayout& layout, const Effect& effect, const SharedLoop& shared,
               const PointLoop& point, Moved* moved) {
  SharedLoop there = shared;
  there.tau_s *= std::exp(kStep);
  moved->Add(there, point, {false, true, effect.ModulatesDelay()}, kStep);
  for (std::size_t j = 0; j < shared.values.size(); ++j) {
    const EffectParameter& p = effect.parameters()[j];
    there = shared;
    double step = DifferenceStep(p, shared.values[j]);
    if (shared.values[j] + step > p.high) step = -step;  // into the bounds
    there.values[j] += step;
    moved->Add(there, point, layout.effect_moves[j], step / ScaleOf(p, shared.values[j]));
  }
}

// A normal prior of one of the point's own parameters.
struct OwnPrior {
  Eigen::Index parameter;
  double from_mean;
  double deviation;
};

std::vector<OwnPrior> PriorsOf(const PointLayout& layout, const JointBand& band,
                               const PointLoop& point, const PointLoop& centre,
                               double delay_scatter) {
  std::vector<OwnPrior> out;
  Eigen::Index k = 0;
  const auto add = [&](double from_mean, double deviation) {
    out.push_back({k++, from_mean, deviation});
  };
  add(point.acoustics[0] - centre.acoustics[0], kPriorLogOmega);
  add(point.acoustics[1] - centre.acoustics[1], kPriorLogXi);
  for (Eigen::Index i = 2; i < layout.Base(); ++i) {
    add((point.acoustics[i] - centre.acoustics[i]) / point.residue_scale, kPriorCoefficient);
  }
  for (const double b : point.base_b) add(b, kPriorCoefficient);
  for (const Eigen::Vector4d& mode : point.modes) {
    add(mode[0] - std::log(band.record.at.cycle_frequency_hz), kPriorModeLogOmega);
    add(mode[1] - kPriorModeMeanLogXi, kPriorLogXi);
    add(mode[2], kPriorModeResidue);
    add(mode[3], kPriorModeResidue);
  }
  if (layout.own_delays) add(point.log_delay, std::max(delay_scatter, kLeastScatter));
  for (std::size_t j = 0; j < point.noise.size(); ++j) {
    for (Eigen::Index i = 0; i < point.noise[j].size(); ++i) {
      add(point.noise[j][i] - (i == 0 ? centre.noise[j][0] : 0.0),
          i == 0 ? kPriorLevel : kPriorShape);
    }
  }
  return out;
}

}  // namespace

PointLayout LayoutOf(const LoopStructure& structure, const BaseModel& model) {
  PointLayout out;
  out.modes = model.modes;
  out.complex_residues = structure.complex_residues;
  out.further_modes = structure.further_modes;
  out.own_delays = structure.own_delays;
  for (const NoiseTerm& term : structure.noise) out.noise += term.coefficients;
  out.effect_moves = structure.EffectMoves();
  out.effect_values = static_cast<Eigen::Index>(out.effect_moves.size());
  return out;
}

void MoveOwn(const PointLayout& layout, Eigen::Index parameter, double step, PointLoop* point) {
  Eigen::Index k = parameter;
  if (k < layout.Base()) {
    point->acoustics[k] += step * (k < 2 ? 1.0 : point->residue_scale);
    return;
  }
  k -= layout.Base();
  if (k < layout.BaseB()) {
    point->base_b[k] += step;
    return;
  }
  k -= layout.BaseB();
  if (k < layout.FurtherModes()) {
    point->modes[static_cast<std::size_t>(k / 4)][k % 4] += step;
    return;
  }
  k -= layout.FurtherModes();
  if (layout.own_delays && k-- == 0) {
    point->log_delay += step;
    return;
  }
  for (Eigen::VectorXd& source : point->noise) {
    if (k < source.size()) {
      source[k] += step;
      return;
    }
    k -= source.size();
  }
  LOG(FATAL) << "no own parameter " << parameter;
}

double PointPrior(const PointLayout& layout, const JointBand& band, const PointLoop& point,
                  const PointLoop& centre, double delay_scatter) {
  double out = 0.0;
  for (const OwnPrior& prior : PriorsOf(layout, band, point, centre, delay_scatter)) {
    out += Normal(prior.from_mean, prior.deviation);
  }
  return out;
}

PointScore ScorePoint(const PointLayout& layout, const JointBand& band, const Effect& effect,
                      const std::vector<NoiseTerm>& noise, const SharedLoop& shared,
                      const PointLoop& point, const PointLoop& centre, const JointResiduals& now) {
  const Eigen::Index loop = layout.Loop();
  const Eigen::Index own = layout.Own();
  const Eigen::Index common = layout.SharedLoopSize();
  Moved moved(band, effect, noise, shared, point, now, loop + common);
  AddOwn(layout, effect, shared, point, &moved);
  if (common > 0) AddShared(layout, effect, shared, point, &moved);
  const Eigen::MatrixXd mean = moved.Information();
  const NoiseScore of_noise = ScoreNoise(band, noise, shared, point, now, moved.here());
  PointScore out;
  const Eigen::Index size = own + layout.Shared();
  out.gradient = Eigen::VectorXd::Zero(size);
  out.information = Eigen::MatrixXd::Zero(size, size);
  // The index of a parameter of the mean, or of the noise, among all.
  const auto place_mean = [&](Eigen::Index k) { return k < loop ? k : own + k - loop; };
  const auto place_noise = [&](Eigen::Index k) {
    return k < layout.noise ? loop + k : own + common + k - layout.noise;
  };
  for (Eigen::Index i = 0; i < mean.rows(); ++i) {
    out.gradient[place_mean(i)] = moved.gradient()[i];
    for (Eigen::Index k = 0; k < mean.rows(); ++k) {
      out.information(place_mean(i), place_mean(k)) = mean(i, k);
    }
  }
  const Eigen::Index coefficients = layout.noise + (common > 0 ? 2 : 0);
  for (Eigen::Index i = 0; i < coefficients; ++i) {
    out.gradient[place_noise(i)] = of_noise.gradient[i];
    for (Eigen::Index k = 0; k < coefficients; ++k) {
      out.information(place_noise(i), place_noise(k)) = of_noise.information(i, k);
    }
  }
  for (const OwnPrior& prior : PriorsOf(layout, band, point, centre, shared.delay_scatter)) {
    const double precision = 1.0 / (prior.deviation * prior.deviation);
    out.gradient[prior.parameter] -= precision * prior.from_mean;
    out.information(prior.parameter, prior.parameter) += precision;
  }
  return out;
}

}  // namespace howl

#include "diagnosis/structure/point_scoring.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "diagnosis/fitter.h"
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
        const SharedLoop& shared, const PointLoop& point, Eigen::Index parameters)
      : band_(band),
        effect_(effect),
        now_(MakeJointResiduals(band, effect, shared, point)),
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
  const JointResiduals& now() const { return now_; }
  const JointEvaluation& here() const { return here_; }

 private:
  const JointBand& band_;
  const Effect& effect_;
  JointResiduals now_;
  JointEvaluation here_;
  JointAdjoint adjoint_;
  double slope_;
  Eigen::VectorXcd left_;
  Eigen::MatrixXcd columns_;
  Eigen::VectorXd gradient_;
  Eigen::Index count_ = 0;
};

void MoveOwn(const PointLayout& layout, const Effect& effect, const SharedLoop& shared,
             const PointLoop& point, const PointLoop& centre, Moved* moved) {
  for (Eigen::Index i = 0; i < layout.Acoustics(); ++i) {
    PointLoop there = point;
    there.acoustics[i] += kStep * (i < 2 ? 1.0 : std::abs(centre.acoustics[2]));
    moved->Add(shared, there, {true, false, false}, kStep);
  }
  if (!layout.own_delays) return;
  PointLoop there = point;
  there.log_delay += kStep;
  moved->Add(shared, there, {false, true, effect.ModulatesDelay()}, kStep);
}

void MoveShared(const Effect& effect, const SharedLoop& shared, const PointLoop& point,
                Moved* moved) {
  SharedLoop there = shared;
  there.tau_s *= std::exp(kStep);
  moved->Add(there, point, {false, true, effect.ModulatesDelay()}, kStep);
  for (std::size_t j = 0; j < shared.values.size(); ++j) {
    const EffectParameter& p = effect.parameters()[j];
    there = shared;
    double step = DifferenceStep(p, shared.values[j]);
    if (shared.values[j] + step > p.high) step = -step;  // into the bounds
    there.values[j] += step;
    moved->Add(there, point,
               {effect.ChangesAcousticCut(), effect.ChangesFlameCut(),
                effect.ChangesFlameInput() || effect.ModulatesDelay()},
               step / ScaleOf(p, shared.values[j]));
  }
}

void AddPrior(const PointLayout& layout, const PointLoop& point, const PointLoop& centre,
              double delay_scatter, PointScore* score) {
  const auto add = [&](Eigen::Index k, double from, double deviation) {
    const double precision = 1.0 / (deviation * deviation);
    score->gradient[k] -= precision * from;
    score->information(k, k) += precision;
  };
  add(0, point.acoustics[0] - centre.acoustics[0], kPriorLogOmega);
  add(1, point.acoustics[1] - centre.acoustics[1], kPriorLogXi);
  for (Eigen::Index i = 2; i < layout.Acoustics(); ++i) {
    add(i, (point.acoustics[i] - centre.acoustics[i]) / std::abs(centre.acoustics[2]),
        kPriorCoefficient);
  }
  if (layout.own_delays) {
    add(layout.Loop() - 1, point.log_delay, std::max(delay_scatter, kLeastScatter));
  }
  Eigen::Index k = layout.Loop();
  for (std::size_t j = 0; j < point.noise.size(); ++j) {
    for (Eigen::Index i = 0; i < point.noise[j].size(); ++i, ++k) {
      add(k, point.noise[j][i] - (i == 0 ? centre.noise[j][0] : 0.0),
          i == 0 ? kPriorLevel : kPriorShape);
    }
  }
}

}  // namespace

double PointPrior(const PointLayout& layout, const PointLoop& point, const PointLoop& centre,
                  double delay_scatter) {
  const double scale = std::abs(centre.acoustics[2]);
  double out = Normal(point.acoustics[0] - centre.acoustics[0], kPriorLogOmega) +
               Normal(point.acoustics[1] - centre.acoustics[1], kPriorLogXi);
  for (Eigen::Index i = 2; i < layout.Acoustics(); ++i) {
    out += Normal((point.acoustics[i] - centre.acoustics[i]) / scale, kPriorCoefficient);
  }
  if (layout.own_delays) out += Normal(point.log_delay, std::max(delay_scatter, kLeastScatter));
  for (std::size_t j = 0; j < point.noise.size(); ++j) {
    out += Normal(point.noise[j][0] - centre.noise[j][0], kPriorLevel);
    for (Eigen::Index k = 1; k < point.noise[j].size(); ++k) {
      out += Normal(point.noise[j][k], kPriorShape);
    }
  }
  return out;
}

PointScore ScorePoint(const PointLayout& layout, const JointBand& band, const Effect& effect,
                      const std::vector<NoiseTerm>& noise, const SharedLoop& shared,
                      const PointLoop& point, const PointLoop& centre) {
  const Eigen::Index loop = layout.Loop();
  const Eigen::Index own = layout.Own();
  const Eigen::Index common = layout.SharedLoopSize();
  Moved moved(band, effect, noise, shared, point, loop + common);
  MoveOwn(layout, effect, shared, point, centre, &moved);
  if (common > 0) MoveShared(effect, shared, point, &moved);
  const Eigen::MatrixXd mean = moved.Information();
  const NoiseScore of_noise = ScoreNoise(band, noise, shared, point, moved.now(), moved.here());
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
  AddPrior(layout, point, centre, shared.delay_scatter, &out);
  return out;
}

}  // namespace howl

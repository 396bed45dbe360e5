#include "diagnosis/structure/structure_fit.h"

#include <glog/logging.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "diagnosis/fit/fitter.h"
#include "diagnosis/structure/point_scoring.h"
#include "diagnosis/structure/structure_priors.h"
#include "model/numerics/parallel_for.h"

namespace howl {
namespace {

constexpr double kFirstDamping = 1e-2;
constexpr double kLeastDamping = 1e-6;
constexpr double kMostDamping = 1e6;
constexpr double kLower = 0.2;
constexpr double kRaise = 8.0;
constexpr int kMostAttempts = 8;

// The largest steps of an iteration.
constexpr double kMostLogOmega = 0.05;
constexpr double kMostLogXi = 0.5;
constexpr double kMostCoefficient = 0.5;
constexpr double kMostLogDelay = 0.1;
constexpr double kMostLogNoise = 1.0;
constexpr double kMostLogError = 0.5;

Eigen::MatrixXd Damped(Eigen::MatrixXd information, double damping) {
  information.diagonal().array() *= 1.0 + damping;
  information.diagonal().array() += 1e-12 * information.diagonal().maxCoeff() + 1e-30;
  return information;
}

double Limited(double step, double most) { return std::clamp(step, -most, most); }

// ln det(H / (2 pi)).
double LogDeterminant(const Eigen::MatrixXd& information) {
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(information, Eigen::EigenvaluesOnly)
          .eigenvalues();
  return values.array().max(1e-12 * values.maxCoeff()).log().sum() -
         static_cast<double>(values.size()) * std::log(2.0 * std::numbers::pi);
}

class Scoring {
 public:
  Scoring(const std::vector<JointBand>& bands, StructureFit start, const StructureOptions& options)
      : bands_(bands), options_(options), at_(std::move(start)), joined_(at_.structure.Joined()) {
    layout_ = LayoutOf(at_.structure, bands[0].record.model);
    layout_.shared_fixed = options.shared_fixed;
    moves_.flame_input =
        joined_->ModulatesDelay() || (joined_->ChangesFlameInput() && !options.shared_fixed);
    residuals_.resize(bands.size());
  }

  StructureFit Run();

 private:
  double SharedPrior() const;
  double Value(const SharedLoop& shared, std::vector<PointLoop>* points,
               std::vector<JointResiduals>* residuals, std::vector<double>* each) const;
  void Score();
  Eigen::MatrixXd SharedInformation(const std::vector<double>& damping,
                                    Eigen::VectorXd* gradient) const;
  Eigen::VectorXd TakeShared(SharedLoop* shared) const;
  void TakeOwn(const Eigen::VectorXd& shared_step, std::vector<PointLoop>* points) const;
  double MostOwnStep(Eigen::Index k) const;
  double ScatterOfDelays() const;
  double Iterate(double value);
  double Evidence(double value);

  const std::vector<JointBand>& bands_;
  StructureOptions options_;
  StructureFit at_;
  EffectPointer joined_;
  PointLayout layout_;
  Moves moves_;
  std::vector<JointResiduals> residuals_;
  std::vector<PointScore> scores_;
  std::vector<double> damping_;
  double shared_damping_ = kFirstDamping;
};

double Scoring::SharedPrior() const {
  double out = 0.0;
  for (const EffectParameter& p : joined_->parameters()) out -= std::log(SearchSpan(p));
  return out;
}

// `residuals` has those of any other parameters, or nothing, and becomes those of these.
double Scoring::Value(const SharedLoop& shared, std::vector<PointLoop>* points,
                      std::vector<JointResiduals>* residuals, std::vector<double>* each) const {
  each->assign(bands_.size(), 0.0);
  ParallelFor(bands_.size(), [&](std::size_t e) {
    PointLoop& point = (*points)[e];
    JointResiduals& here = (*residuals)[e];
    here =
        MoveJointResiduals(bands_[e], *joined_, shared, point, here.input ? moves_ : Moves(), here);
    const JointEvaluation at =
        EvaluateWithItsFlame(bands_[e], at_.structure.noise, shared, here, &point);
    (*each)[e] = at.log_likelihood +
                 PointPrior(layout_, bands_[e], point, at_.centres[e], shared.delay_scatter);
  });
  double sum = SharedPrior();
  for (const double value : *each) sum += value;
  return std::isfinite(sum) ? sum : -std::numeric_limits<double>::infinity();
}

void Scoring::Score() {
  scores_.resize(bands_.size());
  ParallelFor(bands_.size(), [&](std::size_t e) {
    scores_[e] = ScorePoint(layout_, bands_[e], *joined_, at_.structure.noise, at_.shared,
                            at_.points[e], at_.centres[e], residuals_[e]);
  });
}

Eigen::MatrixXd Scoring::SharedInformation(const std::vector<double>& damping,
                                           Eigen::VectorXd* gradient) const {
  const Eigen::Index own = layout_.Own();
  const Eigen::Index shared = layout_.Shared();
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(shared, shared);
  *gradient = Eigen::VectorXd::Zero(shared);
  for (std::size_t e = 0; e < scores_.size(); ++e) {
    const PointScore& score = scores_[e];
    const auto solver = Damped(score.information.topLeftCorner(own, own), damping[e]).ldlt();
    const Eigen::MatrixXd mixed = score.information.topRightCorner(own, shared);
    out += score.information.bottomRightCorner(shared, shared);
    out.noalias() -= mixed.transpose() * solver.solve(mixed);
    *gradient += score.gradient.tail(shared);
    gradient->noalias() -= mixed.transpose() * solver.solve(score.gradient.head(own));
  }
  // The precision of a uniform prior.
  for (Eigen::Index j = 0; j < layout_.effect_values; ++j) {
    const double span = SearchSpan(joined_->parameters()[static_cast<std::size_t>(j)]);
    out(1 + j, 1 + j) += 12.0 / (span * span);
  }
  return out;
}

// Takes a step within bounds and returns the step that was taken.
Eigen::VectorXd Scoring::TakeShared(SharedLoop* shared) const {
  if (layout_.Shared() == 0) return Eigen::VectorXd();
  Eigen::VectorXd gradient;
  const Eigen::MatrixXd information = SharedInformation(damping_, &gradient);
  Eigen::VectorXd step = Damped(information, shared_damping_).ldlt().solve(gradient);
  step[0] = Limited(step[0], kMostLogDelay);
  shared->tau_s *= std::exp(step[0]);
  for (std::size_t j = 0; j < shared->values.size(); ++j) {
    const EffectParameter& p = joined_->parameters()[j];
    const auto k = static_cast<Eigen::Index>(j) + 1;
    const double was = shared->values[j];
    shared->values[j] = SteppedValue(p, was, step[k]);
    step[k] = ToSearch(p, shared->values[j]) - ToSearch(p, was);
  }
  const Eigen::Index errors = layout_.Shared() - 2;
  for (const auto& [eps, k] : {std::pair{&shared->eps_a, errors}, {&shared->eps_b, errors + 1}}) {
    const double was = *eps;
    *eps = std::clamp(was * std::exp(Limited(step[k], kMostLogError)), kLeastError, kLargestError);
    step[k] = std::log(*eps / was);
  }
  if (layout_.own_delays) shared->delay_scatter = ScatterOfDelays();
  return step;
}

void Scoring::TakeOwn(const Eigen::VectorXd& shared_step, std::vector<PointLoop>* points) const {
  const Eigen::Index own = layout_.Own();
  for (std::size_t e = 0; e < scores_.size(); ++e) {
    const PointScore& score = scores_[e];
    PointLoop& point = (*points)[e];
    Eigen::VectorXd gradient = score.gradient.head(own);
    gradient -= score.information.topRightCorner(own, shared_step.size()) * shared_step;
    const Eigen::VectorXd step =
        Damped(score.information.topLeftCorner(own, own), damping_[e]).ldlt().solve(gradient);
    for (Eigen::Index k = 0; k < own; ++k) {
      MoveOwn(layout_, k, Limited(step[k], MostOwnStep(k)), &point);
    }
  }
}

double Scoring::MostOwnStep(Eigen::Index k) const {
  if (k >= layout_.Loop()) return kMostLogNoise;
  if (k >= layout_.Acoustics()) return kMostLogDelay;
  const Eigen::Index beyond = k - layout_.Base() - layout_.BaseB();
  const Eigen::Index kind = beyond >= 0 ? beyond % 4 : std::min<Eigen::Index>(k, 2);
  return kind == 0 ? kMostLogOmega : kind == 1 ? kMostLogXi : kMostCoefficient;
}

// The scatter by its own likelihood, given each delay and its variance.
double Scoring::ScatterOfDelays() const {
  const Eigen::Index k = layout_.Loop() - 1;
  double sum = 0.0;
  for (std::size_t e = 0; e < scores_.size(); ++e) {
    const double d = at_.points[e].log_delay;
    sum += d * d + 1.0 / scores_[e].information(k, k);
  }
  return std::clamp(std::sqrt(sum / static_cast<double>(scores_.size())), kLeastScatter,
                    kMostScatter);
}

// Takes one step, shortened until it is better, if such a step is found. Returns its gain.
double Scoring::Iterate(double value) {
  for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
    SharedLoop shared = at_.shared;
    std::vector<PointLoop> points = at_.points;
    std::vector<JointResiduals> residuals = residuals_;
    std::vector<double> each;
    TakeOwn(TakeShared(&shared), &points);
    const double next = Value(shared, &points, &residuals, &each);
    for (std::size_t e = 0; e < bands_.size(); ++e) {
      const bool lost = !(each[e] >= at_.point_values[e]);
      damping_[e] = std::clamp(damping_[e] * (lost ? kRaise : kLower), kLeastDamping, kMostDamping);
    }
    const bool better = next > value;
    shared_damping_ =
        std::clamp(shared_damping_ * (better ? kLower : kRaise), kLeastDamping, kMostDamping);
    if (!better) continue;
    at_.shared = std::move(shared);
    at_.points = std::move(points);
    at_.point_values = std::move(each);
    residuals_ = std::move(residuals);
    return next - value;
  }
  return 0.0;
}

double Scoring::Evidence(double value) {
  double out = value;
  const Eigen::Index own = layout_.Own();
  for (const PointScore& score : scores_) {
    out -= 0.5 * LogDeterminant(score.information.topLeftCorner(own, own));
  }
  if (layout_.Shared() == 0) return out;
  Eigen::VectorXd gradient;
  at_.shared_information = SharedInformation(std::vector<double>(scores_.size(), 0.0), &gradient);
  // The model's errors are in every structure, and at their bound they have no meaningful
  // curvature. They are left out of the determinant.
  const Eigen::Index loop = layout_.SharedLoopSize();
  return out - 0.5 * LogDeterminant(at_.shared_information.topLeftCorner(loop, loop));
}

StructureFit Scoring::Run() {
  damping_.assign(bands_.size(), kFirstDamping);
  double value = Value(at_.shared, &at_.points, &residuals_, &at_.point_values);
  for (at_.iterations = 0; at_.iterations < options_.iterations; ++at_.iterations) {
    Score();
    const double gain = Iterate(value);
    value += gain;
    VLOG(3) << "iteration " << at_.iterations << ": " << value << ", eps " << at_.shared.eps_a
            << " " << at_.shared.eps_b << ", tau " << at_.shared.tau_s;
    if (gain < options_.converged) break;
  }
  Score();
  at_.log_posterior = value;
  at_.log_evidence = Evidence(value);
  return std::move(at_);
}

}  // namespace

StructureFit FitStructure(const std::vector<JointBand>& bands, StructureFit start,
                          const StructureOptions& options) {
  return Scoring(bands, std::move(start), options).Run();
}

}  // namespace howl

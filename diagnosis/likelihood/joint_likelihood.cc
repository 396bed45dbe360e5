#include "diagnosis/likelihood/joint_likelihood.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <complex>

#include "diagnosis/numerics/real_gram.h"
#include "model/numerics/complex_products.h"

namespace howl {
namespace {

using Complex2 = std::complex<double>;

constexpr double kNoBackground = 0.0;  // this likelihood has no such source
constexpr int kSlopeSteps = 12;
constexpr double kRidge = 1e-10;  // of the largest curvature, where v never comes to a spline

// 1 - R F at each bin, as a function of the flame's mean slope.
struct ReturnDifference {
  const Eigen::VectorXd& share;
  Eigen::VectorXcd without;    // 1 - R leak
  Eigen::VectorXcd per_slope;  // R F / slope

  double LogLikelihood(double slope) const {
    double sum = 0.0;
    for (Eigen::Index i = 0; i < per_slope.size(); ++i) {
      sum += share[i] * std::log(std::norm(without[i] - slope * per_slope[i]));
    }
    return sum;
  }

  // The determinant depends on the flame by this one number. From its value and variance by least
  // squares its most likely value is found, in steps that a bound on the curvature keeps short.
  double MostLikelySlope(double least_squares, double variance) const {
    double slope = least_squares;
    for (int i = 0; i < kSlopeSteps; ++i) {
      double gradient = 0.0;
      double curvature = 0.0;
      for (Eigen::Index k = 0; k < per_slope.size(); ++k) {
        const Complex2 z = without[k] - slope * per_slope[k];
        const double scale = 2.0 * share[k] / std::norm(z);
        gradient -= scale * ConjugateTimes(z, per_slope[k]).real();
        curvature += scale * std::norm(per_slope[k]);
      }
      gradient -= 2.0 * (slope - least_squares) / variance;
      curvature += 2.0 / variance;
      slope += gradient / curvature;
      if (std::abs(gradient) < 1e-6 * std::sqrt(curvature)) break;
    }
    return slope;
  }
};

// S_j at each bin, one column for each source.
Eigen::MatrixXd Spectra(const JointBand& band, const std::vector<NoiseTerm>& noise,
                        const PointLoop& point) {
  Eigen::MatrixXd out(band.count, static_cast<Eigen::Index>(noise.size()));
  for (std::size_t j = 0; j < noise.size(); ++j) {
    out.col(static_cast<Eigen::Index>(j)) = LoopNoiseSpectrum(band.log_frequency, point.noise[j]);
  }
  return out;
}

}  // namespace

JointEvaluation Evaluate(const JointBand& band, const std::vector<NoiseTerm>& noise,
                         const SharedLoop& shared, const PointLoop& point,
                         const JointResiduals& residuals) {
  JointEvaluation out;
  const Eigen::Index n = band.count;
  const double slope = residuals.flame->slopes.dot(point.flame);
  out.f = (slope * residuals.flame->path).array() + residuals.flame->leak;
  ReturnDifference closed{band.share, Eigen::VectorXcd(n), Eigen::VectorXcd(n)};
  const Eigen::MatrixXd spectra = Spectra(band, noise, point);
  out.inverse.resize(static_cast<std::size_t>(n));
  Eigen::VectorXd flame_weight(n);
  Eigen::VectorXcd weighted_target(n);
  double value = 0.0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Complex2 r = residuals.acoustic->r[i];
    const Complex2 f = out.f[i];
    double aa = shared.eps_a * shared.eps_a * band.acoustic_power[i];
    double bb = shared.eps_b * shared.eps_b * band.flame_power[i];
    Complex2 ab = 0.0;
    for (std::size_t j = 0; j < noise.size(); ++j) {
      const NoiseDirection u = DirectionOf(noise[j].source, r, f, kNoBackground);
      const double s = spectra(i, static_cast<Eigen::Index>(j));
      aa += s * std::norm(u.acoustic);
      bb += s * std::norm(u.flame);
      ab += s * ConjugateTimes(u.flame, u.acoustic);
    }
    const double determinant = aa * bb - std::norm(ab);
    const double waa = bb / determinant;
    const double wbb = aa / determinant;
    const Complex2 wab = -ab / determinant;
    Eigen::Matrix2cd& w = out.inverse[static_cast<std::size_t>(i)];
    w << waa, wab, std::conj(wab), wbb;
    closed.without[i] = 1.0 - residuals.flame->leak * r;
    closed.per_slope[i] = Times(r, residuals.flame->path[i]);
    const Complex2 ea = residuals.acoustic->residual[i];
    const Complex2 eb = residuals.flame->target[i];
    const Complex2 wea = waa * ea + Times(wab, eb);
    const Complex2 web = ConjugateTimes(wab, ea) + wbb * eb;
    value -= band.share[i] * (std::log(determinant) + ConjugateTimes(ea, wea).real() +
                              ConjugateTimes(eb, web).real());
    flame_weight[i] = band.share[i] * wbb;
    weighted_target[i] = band.share[i] * web;
  }
  out.flame_curvature = RealGram(flame_weight, residuals.flame->columns, residuals.flame->columns);
  out.flame_curvature.diagonal().array() += kRidge * out.flame_curvature.diagonal().maxCoeff();
  const Eigen::VectorXd gradient = (residuals.flame->columns.adjoint() * weighted_target).real();
  const auto solver = out.flame_curvature.ldlt();
  out.flame = solver.solve(gradient);
  value += gradient.dot(out.flame);
  // The determinant depends on the flame by its mean slope.
  const Eigen::VectorXd along = solver.solve(residuals.flame->slopes);
  const double variance = residuals.flame->slopes.dot(along);
  const double least_squares = residuals.flame->slopes.dot(out.flame);
  const double likely = closed.MostLikelySlope(least_squares, variance);
  const double moved = likely - least_squares;
  out.flame += moved / variance * along;
  out.log_likelihood = value + closed.LogLikelihood(likely) - moved * moved / variance;
  return out;
}

JointEvaluation EvaluateWithItsFlame(const JointBand& band, const std::vector<NoiseTerm>& noise,
                                     const SharedLoop& shared, const JointResiduals& residuals,
                                     PointLoop* point) {
  point->flame = Evaluate(band, noise, shared, *point, residuals).flame;
  return Evaluate(band, noise, shared, *point, residuals);
}

JointAdjoint AdjointOf(const JointBand& band, const std::vector<NoiseTerm>& noise,
                       const PointLoop& point, const JointResiduals& residuals,
                       const JointEvaluation& at) {
  const Eigen::Index n = band.count;
  JointAdjoint out{Eigen::VectorXcd(n), Eigen::VectorXcd(n), Eigen::VectorXcd(n),
                   Eigen::VectorXcd(n)};
  const Eigen::MatrixXd spectra = Spectra(band, noise, point);
  const double slope = residuals.flame->slopes.dot(at.flame);
  const Eigen::VectorXcd left = residuals.flame->target - residuals.flame->columns * at.flame;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Complex2 r = residuals.acoustic->r[i];
    const Complex2 f = at.f[i];
    const Eigen::Matrix2cd& w = at.inverse[static_cast<std::size_t>(i)];
    const Eigen::Vector2cd we = w * Eigen::Vector2cd(residuals.acoustic->residual[i], left[i]);
    // The determinant uses the present flame, the sources the one before.
    const Complex2 now = slope * residuals.flame->path[i] + residuals.flame->leak;
    const Complex2 closed = 1.0 - Times(r, now);
    Complex2 by_r = -now / closed;
    Complex2 by_f = -r / closed;
    for (std::size_t j = 0; j < noise.size(); ++j) {
      const NoiseDirection u = DirectionOf(noise[j].source, r, f, kNoBackground);
      const NoiseTurn turn = TurnOf(noise[j].source, kNoBackground);
      const Eigen::Vector2cd direction(u.acoustic, u.flame);
      const Eigen::Vector2cd wu = w * direction;
      const Complex2 along = direction.dot(we);
      const double s = spectra(i, static_cast<Eigen::Index>(j));
      by_r += s * turn.by_r * (std::conj(we[0]) * along - std::conj(wu[0]));
      by_f += s * turn.by_f * (std::conj(we[1]) * along - std::conj(wu[1]));
    }
    const double scale = 2.0 * band.share[i];
    out.r[i] = scale * by_r;
    out.f[i] = scale * by_f;
    out.acoustic[i] = -scale * std::conj(we[0]);
    out.flame[i] = -scale * std::conj(we[1]);
  }
  return out;
}

NoiseScore ScoreNoise(const JointBand& band, const std::vector<NoiseTerm>& noise,
                      const SharedLoop& shared, const PointLoop& point,
                      const JointResiduals& residuals, const JointEvaluation& at) {
  const Eigen::Index n = band.count;
  const auto sources = static_cast<Eigen::Index>(noise.size()) + 2;
  std::vector<Eigen::MatrixXd> basis;
  std::vector<Eigen::Index> offset;
  Eigen::Index count = 0;
  for (const NoiseTerm& term : noise) {
    basis.push_back(ChebyshevColumns(band.log_frequency, term.coefficients));
    offset.push_back(count);
    count += term.coefficients;
  }
  for (int cut = 0; cut < 2; ++cut) {
    basis.push_back(Eigen::MatrixXd::Constant(n, 1, 2.0));  // ln eps^2 = 2 ln eps
    offset.push_back(count++);
  }
  const Eigen::MatrixXd spectra = Spectra(band, noise, point);
  // d ln L / d ln S_j of each bin, and the information of two of them.
  Eigen::MatrixXd score(n, sources);
  const auto pair = [&](Eigen::Index j, Eigen::Index k) { return j * sources + k; };
  Eigen::MatrixXd pairs(n, sources * sources);
  std::vector<Eigen::Vector2cd> turned(static_cast<std::size_t>(sources));
  std::vector<Eigen::Vector2cd> direction(static_cast<std::size_t>(sources));
  Eigen::VectorXd power(sources);
  const Eigen::VectorXcd left = residuals.flame->target - residuals.flame->columns * at.flame;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Matrix2cd& w = at.inverse[static_cast<std::size_t>(i)];
    const Eigen::Vector2cd we = w * Eigen::Vector2cd(residuals.acoustic->residual[i], left[i]);
    for (std::size_t j = 0; j < noise.size(); ++j) {
      const NoiseDirection u =
          DirectionOf(noise[j].source, residuals.acoustic->r[i], at.f[i], kNoBackground);
      direction[j] = {u.acoustic, u.flame};
      power[static_cast<Eigen::Index>(j)] = spectra(i, static_cast<Eigen::Index>(j));
    }
    direction[noise.size()] = {std::sqrt(band.acoustic_power[i]), 0.0};
    direction[noise.size() + 1] = {0.0, std::sqrt(band.flame_power[i])};
    power[sources - 2] = shared.eps_a * shared.eps_a;
    power[sources - 1] = shared.eps_b * shared.eps_b;
    for (Eigen::Index j = 0; j < sources; ++j) {
      const auto at_j = static_cast<std::size_t>(j);
      turned[at_j] = w * direction[at_j];
      const double trace = direction[at_j].dot(turned[at_j]).real();
      score(i, j) = band.share[i] * power[j] * (std::norm(direction[at_j].dot(we)) - trace);
      for (Eigen::Index k = 0; k <= j; ++k) {
        pairs(i, pair(j, k)) = band.share[i] * power[j] * power[k] *
                               std::norm(direction[static_cast<std::size_t>(k)].dot(turned[at_j]));
      }
    }
  }
  NoiseScore out;
  out.gradient.resize(count);
  out.information.resize(count, count);
  for (Eigen::Index j = 0; j < sources; ++j) {
    const Eigen::MatrixXd& of_j = basis[static_cast<std::size_t>(j)];
    const Eigen::Index row = offset[static_cast<std::size_t>(j)];
    out.gradient.segment(row, of_j.cols()) = of_j.transpose() * score.col(j);
    for (Eigen::Index k = 0; k <= j; ++k) {
      const Eigen::MatrixXd& of_k = basis[static_cast<std::size_t>(k)];
      const Eigen::Index column = offset[static_cast<std::size_t>(k)];
      const Eigen::MatrixXd block = of_j.transpose() * pairs.col(pair(j, k)).asDiagonal() * of_k;
      out.information.block(row, column, block.rows(), block.cols()) = block;
      out.information.block(column, row, block.cols(), block.rows()) = block.transpose();
    }
  }
  return out;
}

Eigen::MatrixXd MeanInformation(const JointBand& band, const JointResiduals& residuals,
                                const JointEvaluation& at, const Eigen::MatrixXcd& columns) {
  const Eigen::Index n = band.count;
  Eigen::MatrixXcd weighted(2 * n, columns.cols());
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Matrix2cd& w = at.inverse[static_cast<std::size_t>(i)];
    for (Eigen::Index k = 0; k < columns.cols(); ++k) {
      const Complex2 ea = band.share[i] * columns(i, k);
      const Complex2 eb = band.share[i] * columns(n + i, k);
      weighted(i, k) = w(0, 0).real() * ea + Times(w(0, 1), eb);
      weighted(n + i, k) = Times(w(1, 0), ea) + w(1, 1).real() * eb;
    }
  }
  const Eigen::MatrixXd with_flame =
      (residuals.flame->columns.adjoint() * weighted.bottomRows(n)).real();
  return 2.0 * ((columns.adjoint() * weighted).real() -
                with_flame.transpose() * at.flame_curvature.ldlt().solve(with_flame));
}

}  // namespace howl

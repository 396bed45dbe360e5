// Score and information of the likelihood of a loop's record, against differences, and against the
// covariance of the score over drawn records.
#include "estimation/record_fit/whittle/whittle.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>

#include "estimation/record_fit/loop/loop_residuals.h"
#include "estimation/record_fit/loop/point_likelihood.h"
#include "estimation/record_fit/slow/slow_signals.h"
#include "model/noise/random_stream.h"
#include "tests/estimation/record_fit/identified.h"

namespace howl::whittle_test {
namespace {

using C = std::complex<double>;

PointStructure TiedStructure() {
  PointStructure structure = FreeStructure(2);
  structure.ratio = 2.2;
  structure.own_damping = false;
  structure.complex_residues = false;
  return structure;
}

PointStructure TiedBesideAnother() {
  PointStructure structure = TiedStructure();
  structure.modes = 3;
  structure.further_modes = 1;
  return structure;
}

PointStructure ErringStructure(DelaySpread spread, bool second_path = false) {
  PointStructure structure = FreeStructure(2);
  structure.delay_spread = spread;
  structure.second_path = second_path;
  structure.acoustic_lines = 3;
  structure.flame_lines = 4;
  return structure;
}

PointStructure ChangingStructure(PointStructure structure) {
  structure.damping_follows_amplitude = true;
  structure.frequency_drifts = true;
  structure.delay_follows_amplitude = true;
  structure.gain_follows_amplitude = true;
  return structure;
}

void ExpectGradientOfDifferences(const RecordSpectra& spectra, const PointStructure& structure) {
  const PointPrior prior = PriorOf(structure, spectra);
  const LoopPoint start =
      ToPoint(structure, spectra.flame.cols(), StartsOf(spectra, structure, prior, 4, 1).back());
  LoopPoint point = start;
  for (Eigen::Index h = 0; h < point.acoustic_lines.size(); ++h) {
    point.acoustic_lines[h] = C(0.1, -0.2);
  }
  for (Eigen::Index h = 0; h < point.flame_lines.size(); ++h) point.flame_lines[h] = C(-0.3, 0.1);
  if (structure.HasChanges()) {
    point.changes = Eigen::Vector<double, kSlowColumns>::LinSpaced(-0.2, 0.3);
  }
  const Eigen::VectorXd at = ToParameters(structure, point);
  const Eigen::VectorXd gradient = PointLikelihood(spectra, structure).Gradient(at);
  // Without the determinant, by the matrices of derivatives that an information needs.
  const Eigen::VectorXd of_whittle =
      WhittleGradient(structure.noise, spectra.share, ResidualsOf(spectra, structure, point),
                      DerivativesOf(spectra, structure, point));
  const auto whittle = [&](const Eigen::VectorXd& parameters) {
    return WhittleLogLikelihood(
        structure.noise, spectra.share,
        ResidualsOf(spectra, structure, ToPoint(structure, spectra.flame.cols(), parameters)));
  };
  const double scale = gradient.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < at.size(); ++i) {
    constexpr double kStep = 1e-5;
    Eigen::VectorXd above = at;
    Eigen::VectorXd below = at;
    above[i] += kStep;
    below[i] -= kStep;
    const double difference =
        (LogLikelihood(spectra, structure, above) - LogLikelihood(spectra, structure, below)) /
        (2.0 * kStep);
    EXPECT_NEAR(gradient[i], difference, 1e-6 * scale + 1e-4 * std::abs(difference))
        << "parameter " << i << " of " << at.size();
    const double of_whittle_alone = (whittle(above) - whittle(below)) / (2.0 * kStep);
    EXPECT_NEAR(of_whittle[i], of_whittle_alone, 1e-6 * scale + 1e-4 * std::abs(of_whittle_alone))
        << "parameter " << i << " of " << at.size();
  }
}

TEST(Whittle, GradientIsThatOfTheLikelihood) {
  const ModalLoop loop = DuctOfModes(2);
  const Record record = SimulateModalLoop(loop, 0.5, 1);
  RecordSpectra spectra = MakeRecordSpectra(record, 203.0, FlameInput::kPressureRate);
  SetSlowSignals(ChangingStructure({}), nullptr, {}, &spectra);
  for (PointStructure structure :
       {FreeStructure(2), TiedStructure(), TiedBesideAnother(), ErringStructure(DelaySpread::kNone),
        ErringStructure(DelaySpread::kNormal), ErringStructure(DelaySpread::kGamma),
        ErringStructure(DelaySpread::kNone, true), ErringStructure(DelaySpread::kNormal, true),
        ChangingStructure(FreeStructure(2)),
        ChangingStructure(ErringStructure(DelaySpread::kGamma))}) {
    structure.noise.push_back({LoopNoise::kDuct, 2});
    structure.noise.push_back({LoopNoise::kBackground, 2});
    structure.noise.push_back({LoopNoise::kPressureHum, 5, 50.0});
    structure.noise.push_back({LoopNoise::kHeatReleaseHum, 2, 60.0});
    structure.noise.push_back({LoopNoise::kFlameGain, 1, 0.0, 4.0});
    ExpectGradientOfDifferences(spectra, structure);
  }
}

// Of p's sensor's spectrum a part hangs on no coefficient, at each bin another one.
TEST(Whittle, SoItIsWhereSamplesOfPressureWereLost) {
  const Record record = SimulateModalLoop(DuctOfModes(2), 0.5, 1);
  RecordSpectra spectra = MakeRecordSpectra(record, 203.0, FlameInput::kPressureRate);
  const PointStructure structure = FreeStructure(2);
  const PointPrior prior = PriorOf(structure, spectra);
  const LoopPoint start =
      ToPoint(structure, spectra.flame.cols(), StartsOf(spectra, structure, prior, 4, 1).back());
  const auto sensor =
      std::ranges::find(structure.noise, LoopNoise::kPressureSensor, &NoiseTerm::source);
  const double level =
      std::exp(start.noise[static_cast<std::size_t>(sensor - structure.noise.begin())][0]);
  spectra.lost_pressure = level * (1.0 + spectra.position.array().square());
  ExpectGradientOfDifferences(spectra, structure);
}

// A linear loop with R = x0 g + x1 h and F = x2 k + x3 l, whose residuals are drawn from all five
// sources: bins are independent, and the information is exact.
class LinearLoop {
 public:
  LinearLoop() : x_(0.5, 0.2, 0.4, -0.3) {}

  LoopResiduals At(const Eigen::VectorXcd& p, const Eigen::VectorXcd& q) const {
    LoopResiduals out;
    out.r = x_[0] * Slope(0) + x_[1] * Slope(1);
    out.f = x_[2] * Slope(2) + x_[3] * Slope(3);
    out.acoustic = p - out.r.cwiseProduct(q);
    out.flame = q - out.f.cwiseProduct(p);
    out.spectra = Eigen::RowVectorXd{{0.3, 0.05, 0.02, 0.2, 0.1}}.replicate(kBins, 1);
    out.background_ratio = 0.7;
    return out;
  }

  LoopDerivatives Slopes(const Eigen::VectorXcd& p, const Eigen::VectorXcd& q) const {
    LoopDerivatives out;
    out.r.resize(kBins, 2);
    out.f.resize(kBins, 2);
    out.r << Slope(0), Slope(1);
    out.f << Slope(2), Slope(3);
    out.acoustic = -(q.asDiagonal() * out.r);
    out.flame = -(p.asDiagonal() * out.f);
    for (std::size_t j = 0; j < Noise().size(); ++j) {
      out.log_spectra.emplace_back(Eigen::MatrixXd::Ones(kBins, 1));
    }
    return out;
  }

  void Draw(RandomStream* random, Eigen::VectorXcd* p, Eigen::VectorXcd* q) const {
    p->resize(kBins);
    q->resize(kBins);
    const LoopResiduals loop = At(Eigen::VectorXcd::Zero(kBins), Eigen::VectorXcd::Zero(kBins));
    for (Eigen::Index i = 0; i < kBins; ++i) {
      Eigen::Vector2cd e(0.0, 0.0);
      for (std::size_t j = 0; j < Noise().size(); ++j) {
        const NoiseDirection u =
            DirectionOf(Noise()[j].source, loop.r[i], loop.f[i], loop.background_ratio);
        const double deviation = std::sqrt(0.5 * loop.spectra(i, static_cast<Eigen::Index>(j)));
        const C z(deviation * random->Normal(), deviation * random->Normal());
        e += z * Eigen::Vector2cd(u.acoustic, u.flame);
      }
      Eigen::Matrix2cd a;
      a << 1.0, -loop.r[i], -loop.f[i], 1.0;
      const Eigen::Vector2cd signals = a.inverse() * e;
      (*p)[i] = signals[0];
      (*q)[i] = signals[1];
    }
  }

  // Of 2 ln |1 - R F|.
  Eigen::VectorXd DeterminantGradient() const {
    const LoopResiduals loop = At(Eigen::VectorXcd::Zero(kBins), Eigen::VectorXcd::Zero(kBins));
    Eigen::VectorXd out = Eigen::VectorXd::Zero(kParameters);
    for (Eigen::Index i = 0; i < kBins; ++i) {
      const C over = -2.0 / (1.0 - loop.r[i] * loop.f[i]);
      for (int k = 0; k < 4; ++k) {
        out[k] += (over * (k < 2 ? loop.f[i] : loop.r[i]) * Slope(k)[i]).real();
      }
    }
    return out;
  }

  static std::vector<NoiseTerm> Noise() {
    return {{LoopNoise::kCombustion, 1},
            {LoopNoise::kPressureSensor, 1},
            {LoopNoise::kHeatReleaseSensor, 1},
            {LoopNoise::kDuct, 1},
            {LoopNoise::kBackground, 1}};
  }
  // Two of R, two of F, one a source, and the background's ratio.
  static constexpr Eigen::Index kParameters = 10;
  static constexpr Eigen::Index kBins = 40;

 private:
  static Eigen::VectorXcd Slope(int which) {
    Eigen::VectorXcd out(kBins);
    for (Eigen::Index i = 0; i < kBins; ++i) {
      const double x = static_cast<double>(i) / kBins;
      out[i] = std::polar(1.0 + 0.5 * std::cos(3.0 * x + which), 2.0 * x * (which + 1) + which);
    }
    return out;
  }

  Eigen::Vector4d x_;
};

TEST(Whittle, InformationIsTheCovarianceOfTheScore) {
  constexpr int kDraws = 6000;
  constexpr Eigen::Index kSize = LinearLoop::kParameters;
  const LinearLoop loop;
  const Eigen::VectorXd share = Eigen::VectorXd::Ones(LinearLoop::kBins);
  const Eigen::VectorXd determinant = loop.DeterminantGradient();
  RandomStream random(11);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(kSize, kSize);
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(kSize, kSize);
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(kSize);
  for (int i = 0; i < kDraws; ++i) {
    Eigen::VectorXcd p;
    Eigen::VectorXcd q;
    loop.Draw(&random, &p, &q);
    const LoopResiduals at = loop.At(p, q);
    const LoopDerivatives by = loop.Slopes(p, q);
    const Eigen::VectorXd score = WhittleGradient(LinearLoop::Noise(), share, at, by) + determinant;
    mean += score / kDraws;
    covariance += score * score.transpose() / kDraws;
    information += WhittleInformation(LinearLoop::Noise(), share, at, by) / kDraws;
  }
  for (Eigen::Index a = 0; a < kSize; ++a) {
    const double deviation = std::sqrt(information(a, a) / kDraws);
    EXPECT_LT(std::abs(mean[a]), 4.5 * deviation) << a;
    for (Eigen::Index b = 0; b <= a; ++b) {
      const double spread = std::sqrt(
          (information(a, a) * information(b, b) + information(a, b) * information(a, b)) / kDraws);
      EXPECT_LT(std::abs(covariance(a, b) - information(a, b)), 5.0 * spread)
          << a << " " << b << ": " << covariance(a, b) << " for " << information(a, b);
    }
  }
}

}  // namespace
}  // namespace howl::whittle_test

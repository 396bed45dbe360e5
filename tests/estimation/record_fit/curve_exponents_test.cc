// How the cycle's harmonics follow what drives the flame's curve.
#include "estimation/record_fit/spectra/curve_exponents.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <vector>

#include "estimation/record_fit/point_fit.h"
#include "estimation/record_fit/spectra/flame_basis.h"
#include "estimation/record_fit/spectra/record_spectra.h"
#include "estimation/record_fit/starts/point_starts.h"
#include "estimation/record_fit/whittle/noise_shape.h"
#include "tests/estimation/record_fit/identified.h"

namespace howl::curve_exponents_test {
namespace {

using C = std::complex<double>;
constexpr double kTwoPi = 2.0 * std::numbers::pi;

// What a record of this rate holds at these frequencies.
std::vector<C> SpectrumAt(const std::vector<double>& signal, const std::vector<double>& of_rate) {
  std::vector<C> out;
  for (const double frequency : of_rate) {
    const C turn = std::polar(1.0, -kTwoPi * frequency);
    C sum = 0.0;
    C at = 1.0;
    for (const double value : signal) {
      sum += value * at;
      at *= turn;
    }
    out.push_back(sum);
  }
  return out;
}

// d ln Q_h / d ln v, Q_h being what the curve makes of v beside h times the cycle's frequency.
double Exponent(const std::function<double(double v)>& curve, const std::vector<double>& v,
                double cycle_of_rate, int h) {
  std::vector<double> beside;
  const double bin = 1.0 / static_cast<double>(v.size());
  for (double f = (h - kBesideCycle) * cycle_of_rate; f < (h + kBesideCycle) * cycle_of_rate;
       f += bin) {
    beside.push_back(f);
  }
  const auto answer = [&](double louder) {
    std::vector<double> q;
    for (const double each : v) q.push_back(curve(louder * each));
    return SpectrumAt(q, beside);
  };
  constexpr double kStep = 1e-3;
  const std::vector<C> now = answer(1.0);
  const std::vector<C> louder = answer(1.0 + kStep);
  C common = 0.0;
  double power = 0.0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    common += std::conj(now[i]) * (louder[i] - now[i]);
    power += std::norm(now[i]);
  }
  return std::abs(common) / (kStep * power);
}

// Of the record's functions, such that together they are nearly a curve that saturates at this
// amplitude.
Eigen::VectorXd FlameOf(const RecordScale& scale, double amplitude) {
  constexpr Eigen::Index kPoints = 200;
  const Eigen::VectorXd v =
      Eigen::VectorXd::LinSpaced(kPoints, -scale.input_range, scale.input_range);
  const Eigen::VectorXd of_amplitude = v / amplitude;
  Eigen::MatrixXd columns(kPoints, scale.functions.cols() + 1);
  columns << FlameBasis(scale.input_range).Columns(v) * scale.functions,
      Eigen::VectorXd::Ones(kPoints);
  const Eigen::VectorXd values = of_amplitude - 0.3 * of_amplitude.array().cube().matrix();
  return columns.colPivHouseholderQr().solve(values).head(scale.functions.cols());
}

struct Answered {
  RecordSpectra record;
  Eigen::VectorXd flame;
  double first = 0.0;  // true exponents of the cycle and of its third multiple
  double third = 0.0;
};

Answered AnsweredByCurve() {
  const ModalLoop loop = DuctOfModes(2);
  const double cycle_hz = CycleFrequency(loop, 150.0, 300.0);
  const Record record = SimulateModalLoop(loop, 2.0, 5);
  Answered out;
  out.record = MakeRecordSpectra(record, cycle_hz, FlameInput::kPressureRate);
  const RecordScale& scale = out.record.scale;
  // The record's v is that of p over its root mean square, and of a time in radians of the cycle.
  const double unit = 2.0 * std::sin(kTwoPi * cycle_hz / record.sampling_hz) * scale.pressure;
  std::vector<double> v;
  for (std::size_t i = 1; i + 1 < record.pressure.size(); ++i) {
    v.push_back((record.pressure[i + 1] - record.pressure[i - 1]) / unit);
  }
  out.flame = FlameOf(scale, std::numbers::sqrt2 * RootMeanSquare(v));
  const FlameBasis basis(scale.input_range);
  const Eigen::VectorXd splines = scale.functions * out.flame;
  const auto curve = [&](double each) { return basis.At(each, splines); };
  out.first = Exponent(curve, v, cycle_hz / record.sampling_hz, 1);
  out.third = Exponent(curve, v, cycle_hz / record.sampling_hz, 3);
  return out;
}

TEST(CurveExponents, AreThoseOfTheCurve) {
  const Answered by_curve = AnsweredByCurve();
  const Eigen::VectorXd exponents = CurveExponents(by_curve.record, by_curve.flame);
  ASSERT_GE(exponents.size(), 5);
  EXPECT_LT(by_curve.first, 0.6);
  EXPECT_GT(by_curve.third, 2.0);
  EXPECT_NEAR(exponents[0], by_curve.first, 0.05 * by_curve.first);
  EXPECT_NEAR(exponents[2], by_curve.third, 0.05 * by_curve.third);
}

// The sides of the third line over those of the first.
TEST(CurveExponents, ShapeTheNoiseOfAGainBeforeTheCurve) {
  Answered by_curve = AnsweredByCurve();
  by_curve.record.curve_exponents = CurveExponents(by_curve.record, by_curve.flame);
  const auto third_over_first = [&](bool before_curve) {
    const Eigen::VectorXd shape =
        NoiseShape({LoopNoise::kFlameGain, 1, 0.0, 16.0, before_curve}, by_curve.record);
    const auto at = [&](double line) {
      Eigen::Index bin = 0;
      (by_curve.record.s.imag().array() - line).abs().minCoeff(&bin);
      return shape[bin];
    };
    return at(3.0) / at(1.0);
  };
  // The first line's sides reach as far as the third, too.
  EXPECT_NEAR(std::log(third_over_first(true) / third_over_first(false)),
              2.0 * std::log(by_curve.third / by_curve.first), 0.2);
}

// A duct whose flame's gain fluctuates, fitted as if it did behind the curve, or before it.
struct FittedGain {
  double log_evidence = 0.0;
  double rms = 0.0;
};

FittedGain FittedWith(bool before_curve, RecordSpectra record) {
  PointStructure structure = FreeStructure(2);
  structure.noise.push_back({LoopNoise::kFlameGain, 1, 0.0, 4.0, false});
  const PointPrior prior = PriorOf(structure, record);
  PointFit fit = FitPoint(record, structure, prior, StartsOf(record, structure, prior, 4, 1));
  NoiseTerm& gain = structure.noise.back();
  if (before_curve) {
    gain.before_curve = true;
    record.middle = nullptr;
    record.curve_exponents =
        CurveExponents(record, ToPoint(structure, record.flame.cols(), fit.parameters).flame);
    fit = FitPoint(record, structure, prior, fit.parameters);
  }
  const LoopPoint point = ToPoint(structure, record.flame.cols(), fit.parameters);
  // Each bin of a tapered spectrum stands for both signs of its frequency, and the taper doubles
  // the power.
  const double power = NoiseSpectrum(gain, record, point.noise.back()).sum();
  return {fit.log_evidence,
          std::sqrt(power * record.bin_hz / record.sampling_hz) / AnswerToGain(gain, record)};
}

TEST(GainNoise, TellsOnWhichSideOfTheCurveTheGainIs) {
  constexpr double kRms = 0.15;
  for (const bool before : {false, true}) {
    ModalLoop loop = DuctOfModes(2);
    loop.slope *= 1.3;
    loop.noise = 0.03;
    (before ? loop.input_gain_rms : loop.gain_rms) = kRms;
    const RecordSpectra record =
        MakeRecordSpectra(SimulateModalLoop(loop, 6.0, 7), CycleFrequency(loop, 150.0, 300.0),
                          FlameInput::kPressureRate);
    const FittedGain as_it_is = FittedWith(before, record);
    EXPECT_GT(as_it_is.log_evidence, FittedWith(!before, record).log_evidence + 3.0);
    // The cycle's amplitude follows the gain, and a part of what a gain before the curve does
    // passes for the curve: it comes out too small by up to a third.
    EXPECT_GT(as_it_is.rms, (before ? 0.65 : 0.9) * kRms);
    EXPECT_LT(as_it_is.rms, 1.1 * kRms);
  }
}

}  // namespace
}  // namespace howl::curve_exponents_test

// Records that known instruments made, of tones in closed form and of noisy cycles by a transform
// of a longer record, against the records of ideal instruments.
#include "estimation/analysis/instruments/remove_instruments.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <complex>
#include <functional>
#include <string>
#include <unsupported/Eigen/FFT>

#include "estimation/analysis/cycle/characteristics.h"
#include "model/numerics/constants.h"
#include "tests/estimation/analysis/synthetic_record.h"

namespace howl::remove_instruments_test {
namespace {

using Complex = std::complex<double>;
using ResponseFunction = std::function<Complex(double frequency_hz)>;

constexpr double kSamplingHz = 5000.0;

InstrumentResponse Formula(const std::string& text) {
  FormulaError error;
  auto response = InstrumentResponse::Parse(text, error);
  EXPECT_TRUE(response.has_value()) << error.message;
  return *response;
}

Complex S(double frequency_hz) { return {0.0, 2.0 * kPi * frequency_hz}; }

Complex LowPass(double frequency_hz) { return 1.0 / (1.0 + S(frequency_hz) / (2.0 * kPi * 120.0)); }
Complex Resonance(double frequency_hz) {
  const Complex u = S(frequency_hz) / (2.0 * kPi * 600.0);
  return 1.0 / (1.0 + 0.1 * u + u * u);
}
const char* const kLowPass = "1 / (1 + s / (2 pi 120))";
const char* const kResonance = "1 / (1 + 0.1 s / (2 pi 600) + (s / (2 pi 600))^2)";

// mean + Re(amplitude e^(j 2 pi f t))
std::vector<double> Tone(Complex amplitude, double frequency_hz, double mean, int samples) {
  std::vector<double> out;
  for (int i = 0; i < samples; ++i) {
    out.push_back(mean +
                  (amplitude * std::polar(1.0, 2.0 * kPi * frequency_hz * i / kSamplingHz)).real());
  }
  return out;
}

// Amplitude by least squares of cosine, sine and constant; `first` is the number of x[0].
Complex Amplitude(const std::vector<double>& x, double frequency_hz, std::size_t first) {
  Eigen::MatrixX3d basis(static_cast<Eigen::Index>(x.size()), 3);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double angle = 2.0 * kPi * frequency_hz * static_cast<double>(first + i) / kSamplingHz;
    basis.row(static_cast<Eigen::Index>(i)) << std::cos(angle), -std::sin(angle), 1.0;
  }
  const Eigen::Vector3d fit =
      (basis.transpose() * basis)
          .ldlt()
          .solve(basis.transpose() *
                 Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size())));
  return {fit[0], fit[1]};
}

struct ToneCase {
  std::string response;
  ResponseFunction truth;
};

TEST(RemoveInstruments, GivesAToneBackToOneInAMillion) {
  const std::vector<ToneCase> cases = {
      {kLowPass, LowPass},
      {kResonance, Resonance},
      {"exp(-0.00073 s)", [](double f) { return std::exp(-0.00073 * S(f)); }},
      {"s / (s + 2 pi 5)", [](double f) { return S(f) / (S(f) + 2.0 * kPi * 5.0); }},
      {"3 / (1 + s / (2 pi 800))^2",
       [](double f) { return 3.0 / std::pow(1.0 + S(f) / (2.0 * kPi * 800.0), 2.0); }}};
  for (const ToneCase& each : cases) {
    for (const double f : {97.3, 211.37}) {
      constexpr int kSamples = 40000;
      const Complex amplitude = std::polar(1.7, 0.4);
      Record record{kSamplingHz, Tone(amplitude * each.truth(f), f, 3.0, kSamples), {}};
      ASSERT_FALSE(RemoveInstruments({.pressure = Formula(each.response)}, record).has_value());
      const std::size_t dropped = (kSamples - record.pressure.size()) / 2;
      EXPECT_LE(dropped, static_cast<std::size_t>(kMostDroppedShare * kSamples));
      const Complex ratio = Amplitude(record.pressure, f, dropped) / amplitude;
      EXPECT_NEAR(std::abs(ratio), 1.0, 1e-6) << each.response << " " << f;
      EXPECT_NEAR(std::arg(ratio), 0.0, 1e-6) << each.response << " " << f;
    }
  }
}

TEST(RemoveInstruments, EverySampleThatStaysIsTheTone) {
  for (const int samples : {2000, 8000}) {
    Record record{kSamplingHz, Tone(1.0, 211.37, 0.0, samples),
                  Tone(LowPass(211.37), 211.37, 0.0, samples)};
    ASSERT_FALSE(RemoveInstruments({.heat_release = Formula(kLowPass)}, record).has_value());
    ASSERT_EQ(record.pressure.size(), record.heat_release.size());
    EXPECT_LT(record.pressure.size(), static_cast<std::size_t>(samples));
    for (std::size_t i = 0; i < record.pressure.size(); ++i) {
      EXPECT_NEAR(record.heat_release[i], record.pressure[i], 1e-5) << i;
    }
  }
}

TEST(RemoveInstruments, TakesADelayOut) {
  const double delay_s = 0.00123;  // not a whole number of samples
  const double f = 211.37;
  Record record{kSamplingHz, Tone(1.0, f, 0.0, 8000),
                Tone(std::exp(-S(f) * delay_s), f, 5.0, 8000)};
  ASSERT_FALSE(RemoveInstruments({.delay_s = delay_s}, record).has_value());
  const std::size_t dropped = (8000 - record.pressure.size()) / 2;
  EXPECT_GE(static_cast<double>(dropped), delay_s * kSamplingHz);
  const Complex ratio =
      Amplitude(record.heat_release, f, dropped) / Amplitude(record.pressure, f, dropped);
  EXPECT_NEAR(std::abs(ratio), 1.0, 1e-6);
  EXPECT_NEAR(std::arg(ratio), 0.0, 1e-6);
}

// Beyond a hundredth of the largest magnitude the gain is that at the hundredth; the phase is kept.
TEST(RemoveInstruments, LimitsTheGainAndKeepsThePhase) {
  const auto truth = [](double f) { return 1.0 / std::pow(1.0 + S(f) / (2.0 * kPi * 50.0), 3.0); };
  for (const double f : {100.0, 200.0, 400.0, 1000.0}) {
    Record record{kSamplingHz, Tone(truth(f), f, 0.0, 40000), {}};
    ASSERT_FALSE(
        RemoveInstruments({.pressure = Formula("(1 + s / (2 pi 50))^-3")}, record).has_value());
    const Complex given = Amplitude(record.pressure, f, (40000 - record.pressure.size()) / 2);
    // The largest is that next to zero, one.
    const double expected = std::min(1.0, std::abs(truth(f)) / kLeastResponseShare);
    EXPECT_NEAR(std::abs(given) / expected, 1.0, 1e-4) << f;
    EXPECT_NEAR(std::arg(given), 0.0, 1e-4) << f;
  }
}

TEST(RemoveInstruments, AProbeWithoutAMeanLeavesItAndGivesNumbers) {
  Record record{kSamplingHz, Tone(1.0, 200.0, 42.0, 5000), Tone(1.0, 200.0, -7.0, 5000)};
  ASSERT_FALSE(RemoveInstruments({.pressure = Formula("s / (s + 2 pi 20)"),
                                  .heat_release = Formula("s^2 / (s + 2 pi 5)^2")},
                                 record)
                   .has_value());
  double p_mean = 0.0, q_mean = 0.0;
  for (std::size_t i = 0; i < record.pressure.size(); ++i) {
    ASSERT_TRUE(std::isfinite(record.pressure[i]));
    ASSERT_TRUE(std::isfinite(record.heat_release[i]));
    p_mean += record.pressure[i] / static_cast<double>(record.pressure.size());
    q_mean += record.heat_release[i] / static_cast<double>(record.pressure.size());
  }
  EXPECT_NEAR(p_mean, 42.0, 0.05);
  EXPECT_NEAR(q_mean, -7.0, 0.05);
}

TEST(RemoveInstruments, WithoutAnyNoBitChanges) {
  const Record before = fixtures::Synthesise({.samples = 3000}, 8).record;
  Record after = before;
  ASSERT_FALSE(RemoveInstruments({}, after).has_value());
  EXPECT_EQ(after.pressure, before.pressure);
  EXPECT_EQ(after.heat_release, before.heat_release);
}

TEST(RemoveInstruments, NamesAResponseWithoutAValue) {
  const Record before = fixtures::Synthesise({.samples = 3000}, 8).record;
  Record after = before;
  const auto infinite = RemoveInstruments({.heat_release = Formula("1 / (s - s)")}, after);
  ASSERT_TRUE(infinite.has_value());
  EXPECT_EQ(infinite->channel, Channel::kHeatRelease);
  EXPECT_FALSE(infinite->zero);
  EXPECT_GT(infinite->frequency_hz, 0.0);
  const auto zero = RemoveInstruments({.pressure = Formula("0 s")}, after);
  ASSERT_TRUE(zero.has_value());
  EXPECT_EQ(zero->channel, Channel::kPressure);
  EXPECT_TRUE(zero->zero);
  EXPECT_EQ(after.pressure, before.pressure);
}

// What the instruments make of a signal, by the transform of the whole.
std::vector<double> Recorded(const std::vector<double>& x, const ResponseFunction& response) {
  Eigen::FFT<double> fft;
  std::vector<Complex> spectrum;
  fft.fwd(spectrum, x);
  const auto n = static_cast<double>(x.size());
  for (std::size_t k = 0; k < spectrum.size(); ++k) {
    const auto bin = static_cast<double>(k);
    const double f = (2.0 * bin < n ? bin : bin - n) / n * kSamplingHz;
    spectrum[k] *= response(f);
  }
  std::vector<double> out;
  fft.inv(out, spectrum);
  return out;
}

std::vector<double> Middle(const std::vector<double>& x, std::size_t margin) {
  return {x.begin() + static_cast<std::ptrdiff_t>(margin),
          x.end() - static_cast<std::ptrdiff_t>(margin)};
}

Characteristics Analysed(const Record& record) {
  return EstimateCharacteristics(
      record, WelchSpectrum(RemoveMean(record.pressure), RemoveMean(record.heat_release),
                            record.sampling_hz));
}

// Noisy cycles through a low-pass on q, a resonance on p and a skew of the channels. The recorders
// add noise of their own after the instruments.
TEST(RemoveInstruments, AnalysesAgreeWithThoseOfIdealInstruments) {
  constexpr int kRecords = 40;
  constexpr std::size_t kMargin = 4000;
  constexpr double kDelay = 0.0004;
  const Instruments known = {Formula(kResonance), Formula(kLowPass), kDelay};
  fixtures::SyntheticOptions options;
  options.samples = 24000;
  options.diffusion_rad2_per_s = 0.5;
  options.noise = 0.05;
  double phase_sum = 0.0, phase_squares = 0.0, gain_sum = 0.0, gain_squares = 0.0;
  int phase_inside = 0, gain_inside = 0, agree = 0, unlike = 0;
  for (int seed = 1; seed <= kRecords; ++seed) {
    const Record whole = fixtures::Synthesise(options, static_cast<std::uint64_t>(seed)).record;
    const Record ideal = {kSamplingHz, Middle(whole.pressure, kMargin),
                          Middle(whole.heat_release, kMargin)};
    Record made = {kSamplingHz, Middle(Recorded(whole.pressure, Resonance), kMargin),
                   Middle(Recorded(whole.heat_release,
                                   [&](double f) { return LowPass(f) * std::exp(-S(f) * kDelay); }),
                          kMargin)};
    std::mt19937_64 random(static_cast<std::uint64_t>(seed) + 1000);
    std::normal_distribution<double> normal;
    for (double& value : made.pressure) value += 0.002 * options.p_amplitude * normal(random);
    for (double& value : made.heat_release) {
      value += 0.002 * options.p_amplitude / options.gain * normal(random);
    }
    const Characteristics truth = Analysed(ideal);
    const Characteristics raw = Analysed(made);
    ASSERT_FALSE(RemoveInstruments(known, made).has_value());
    const Characteristics given = Analysed(made);
    ASSERT_EQ(given.state, CycleState::kLimitCycle) << seed;
    const double phase = given.phase_deg.value - truth.phase_deg.value;
    const double gain = given.gain.value / truth.gain.value - 1.0;
    phase_sum += phase;
    phase_squares += phase * phase;
    gain_sum += gain;
    gain_squares += gain * gain;
    agree += std::abs(phase) < 1.96 * truth.phase_deg.std &&
             std::abs(given.gain.value - truth.gain.value) < 1.96 * truth.gain.std;
    unlike += std::abs(raw.phase_deg.value - truth.phase_deg.value) > 1.96 * truth.phase_deg.std &&
              std::abs(raw.gain.value - truth.gain.value) > 1.96 * truth.gain.std;
    phase_inside +=
        std::abs(given.phase_deg.value - options.phase_deg) < 1.96 * given.phase_deg.std;
    gain_inside += std::abs(given.gain.value - options.gain) < 1.96 * given.gain.std;
  }
  const auto standard_error = [](double sum, double squares) {
    const double mean = sum / kRecords;
    return std::sqrt((squares / kRecords - mean * mean) / (kRecords - 1));
  };
  RecordProperty("phase_bias_deg", std::to_string(phase_sum / kRecords));
  RecordProperty("gain_bias", std::to_string(gain_sum / kRecords));
  EXPECT_EQ(unlike, kRecords);  // what the instruments do is seen
  EXPECT_EQ(agree, kRecords);
  // Bias: within three standard errors of the mean difference.
  EXPECT_LT(std::abs(phase_sum / kRecords), 3.0 * standard_error(phase_sum, phase_squares));
  EXPECT_LT(std::abs(gain_sum / kRecords), 3.0 * standard_error(gain_sum, gain_squares));
  // Coverage of 95 % intervals: 34 of 40 or fewer has a chance of 1.4 %.
  EXPECT_GE(phase_inside, 34);
  EXPECT_GE(gain_inside, 34);
}

}  // namespace
}  // namespace howl::remove_instruments_test

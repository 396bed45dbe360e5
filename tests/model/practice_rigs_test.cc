// The practice rigs without an effect, made by a simulator that shares no code with this one: their
// listed crossings and gains, and the cycles in their records, must be this library's predictions.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "model/cycles/harmonic_balance.h"
#include "model/loop/crossings.h"
#include "model/numerics/constants.h"

namespace howl::practice_rigs_test {
namespace {

constexpr double kSamplingHz = 5000.0;

struct Recording {
  std::vector<double> p;
  std::vector<double> q;
};

Recording Read(const std::string& path) {
  std::ifstream file(path);
  Recording recording;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    char* end = nullptr;
    recording.p.push_back(std::strtod(line.c_str(), &end));
    recording.q.push_back(std::strtod(end + 1, nullptr));
  }
  return recording;
}

std::complex<double> Line(const std::vector<double>& x, std::size_t begin, std::size_t n,
                          double f) {
  std::complex<double> sum = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double hann = 1.0 - std::cos(kTwoPi * static_cast<double>(i) / static_cast<double>(n));
    sum += hann * x[begin + i] *
           std::polar(2.0 / static_cast<double>(n),
                      -kTwoPi * f * static_cast<double>(i) / kSamplingHz);
  }
  return sum;
}

// Mean frequency: the phase's advance from window to window, which diffuses with the cycle.
double MeanFrequency(const std::vector<double>& x, double guess_hz) {
  constexpr std::size_t kWindow = 250;
  double phase = 0.0;
  int count = 0;
  for (std::size_t i = 0; i + 2 * kWindow <= x.size(); i += kWindow) {
    const std::complex<double> advance =
        Line(x, i + kWindow, kWindow, guess_hz) / Line(x, i, kWindow, guess_hz) *
        std::polar(1.0, -kTwoPi * guess_hz * kWindow / kSamplingHz);
    phase += std::arg(advance);
    ++count;
  }
  return guess_hz + phase / count / kTwoPi * kSamplingHz / kWindow;
}

TEST(PracticeRigs, CrossingsAndCyclesOfTheNulls) {
  const char* folder = std::getenv("HOWL_PRACTICE");
  if (folder == nullptr) GTEST_SKIP() << "HOWL_PRACTICE is not set";
  for (const char* name : {"case002", "case022", "case023"}) {
    const std::string base = std::string(folder) + "/" + name;
    std::ifstream file(base + ".truth.json");
    ASSERT_TRUE(file.good()) << base;
    const nlohmann::json truth = nlohmann::json::parse(file);
    ASSERT_EQ(truth["effect"], "none");
    int number = 0;
    for (const auto& e : truth["experiments"]) {
      ++number;
      SCOPED_TRACE(std::string(name) + " experiment " + std::to_string(number));
      ClosedLoop model;
      model.loop = {{e["omega_hz"], e["xi"], e["N"], e["M"], 3.0}, e["tau_s"]};
      model.flame.slope = e["phi_slope"];
      const auto crossings = PhaseCrossings(model.loop, model.flame.slope, 900.0);
      ASSERT_GE(crossings.size(), 3u);
      // Listed on a grid of 0.05 Hz, and gains to four digits.
      EXPECT_NEAR(crossings[0].frequency_hz, e["crossing_hz"].get<double>(), 0.051);
      EXPECT_NEAR(crossings[0].gain, e["loop_gain"].get<double>(), 2e-3);
      EXPECT_NEAR(crossings.back().frequency_hz, e["second_crossing_hz"].get<double>(), 0.051);
      EXPECT_NEAR(crossings.back().gain, e["second_gain"].get<double>(), 2e-3);

      const auto cycles = LimitCycles(model, 300.0);
      ASSERT_EQ(cycles.size(), 1u);
      const LimitCycle& cycle = cycles[0];
      const Recording record = Read(base + "/data/exp" + std::to_string(number) + ".csv");
      ASSERT_EQ(record.p.size(), 16000u);
      const double frequency_hz = MeanFrequency(record.p, cycle.frequency_hz);
      EXPECT_NEAR(frequency_hz / cycle.frequency_hz, 1.0, 2e-3);
      // q to p at the fundamental, which no scale of the flame changes.
      std::complex<double> cross = 0.0;
      double power = 0.0;
      for (std::size_t i = 0; i + 500 <= record.p.size(); i += 250) {
        const std::complex<double> q = Line(record.q, i, 500, frequency_hz);
        cross += Line(record.p, i, 500, frequency_hz) * std::conj(q);
        power += std::norm(q);
      }
      const std::complex<double> measured = cross / power;
      const std::complex<double> predicted = cycle.pressure[1] / cycle.heat_release[1];
      EXPECT_NEAR(std::abs(measured / predicted), 1.0, 0.02);
      EXPECT_NEAR(kDegPerRad * std::arg(measured / predicted), 0.0, 1.5);
    }
  }
}

}  // namespace
}  // namespace howl::practice_rigs_test

// What a user asks of a loop at any frequency and in any units: the program's answers for one
// problem from half a hertz to 100 kHz, in units of the cycle.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/app/program.h"

namespace howl::scaling_test {
namespace {

using Json = nlohmann::json;

std::string Text(double value) {
  std::ostringstream out;
  out.precision(17);
  out << value;
  return out.str();
}

// Two experiments; the slope times the frequency and the gain is the same for all, 1.19 and 1.28.
std::string Problem(double frequency_hz, double gain_unit) {
  std::string text = "experiments:\n";
  const auto add = [&](const char* name, double phi, double phase_deg, double gain) {
    text += std::string("- {name: ") + name + ", phi: " + Text(phi) +
            ", frequency_hz: " + Text(frequency_hz) + ", phase_deg: " + Text(phase_deg) +
            ", gain: " + Text(gain * gain_unit) +
            ", flame_slope: " + Text(-0.01545897 / (frequency_hz * gain_unit)) + "}\n";
  };
  add("e1", 0.5, -5.74, 12.14);
  add("e2", 0.6, -9.74, 13.14);
  return text + "family: {members: 20, width: 0.1}\n";
}

Json AnswerOf(const std::string& command, double frequency_hz, double gain_unit,
              const std::string& written) {
  const TemporaryFolder folder;
  const auto config = folder.Write("scaled.yaml", Problem(frequency_hz, gain_unit));
  const ProgramResult run =
      RunHowl(command + " " + config.string() + " --quiet --out " + folder.path().string());
  EXPECT_EQ(run.status, 0) << frequency_hz << " Hz: " << run.err;
  return Json::parse(ReadFile(folder.path() / written));
}

// Of every prediction: [lo, hi] without a unit.
std::vector<double> Predictions(const Json& family, double frequency_hz) {
  std::vector<double> values;
  for (const Json& one : family["predictions"]) {
    const double unit = one["name"] == "growth_rate" ? frequency_hz : 1.0;
    for (const Json& end : one["interval"]) values.push_back(end.get<double>() / unit);
  }
  return values;
}

// Growth rates were wrong above 2 kHz, the program aborted at 5 kHz, and ran for ever at 0.5 Hz.
TEST(Scaling, FamilyFromHalfAHertzToHundredKilohertz) {
  const Json expected = AnswerOf("family", 220.0, 1.0, "family.json");
  const std::vector<double> predicted = Predictions(expected, 220.0);
  ASSERT_GE(predicted.size(), 8u);
  EXPECT_GT(predicted[0], 0.0);  // loop gains above one: the rest state grows
  for (const double frequency_hz : {0.5, 20.0, 1990.0, 2010.0, 5000.0, 1e5}) {
    for (const double gain_unit : {1.0, 1e-12, 1e12}) {
      if (gain_unit != 1.0 && frequency_hz != 20.0) continue;
      const Json got = AnswerOf("family", frequency_hz, gain_unit, "family.json");
      const std::vector<double> same = Predictions(got, frequency_hz);
      ASSERT_EQ(same.size(), predicted.size());
      for (std::size_t k = 0; k < same.size(); ++k) {
        EXPECT_NEAR(same[k], predicted[k], 1e-6 * (1.0 + std::abs(predicted[k])))
            << frequency_hz << " Hz, " << k;
      }
      // The same work.
      EXPECT_EQ(got["counts"]["boxes"], expected["counts"]["boxes"]) << frequency_hz;
      EXPECT_EQ(got["counts"]["members"], expected["counts"]["members"]) << frequency_hz;
      for (const char* const end : {"outer", "inner"}) {
        for (const std::size_t side : {0u, 1u}) {
          const auto omega = [&](const Json& json) {
            return json["bounds"]["e1"]["omega_hz"][end][side].get<double>();
          };
          EXPECT_NEAR(omega(got) / frequency_hz, omega(expected) / 220.0, 1e-9) << frequency_hz;
        }
      }
    }
  }
}

TEST(Scaling, FitFromHalfAHertzToHundredKilohertz) {
  const Json expected = AnswerOf("fit", 220.0, 1.0, "solution.json");
  for (const double frequency_hz : {0.5, 2010.0, 1e5}) {
    const Json got = AnswerOf("fit", frequency_hz, 1e6, "solution.json");
    EXPECT_NEAR(got["cost"].get<double>(), expected["cost"].get<double>(), 1e-9);
    for (const std::size_t i : {0u, 1u}) {
      const Json& a = got["experiments"][i];
      const Json& b = expected["experiments"][i];
      const double scale = frequency_hz / 220.0;
      EXPECT_NEAR(a["omega_hz"].get<double>() / scale / b["omega_hz"].get<double>(), 1.0, 1e-7);
      EXPECT_NEAR(a["xi"].get<double>() / b["xi"].get<double>(), 1.0, 1e-7);
      EXPECT_NEAR(a["N"].get<double>() / (1e6 * scale) / b["N"].get<double>(), 1.0, 1e-7);
      EXPECT_NEAR(a["tau_s"].get<double>() * scale / b["tau_s"].get<double>(), 1.0, 1e-7);
    }
  }
}

// Without a word on times in the config, records have as many periods and samples a period.
TEST(Scaling, SimulatedRecordsAreAnalysedAtAnyFrequency) {
  const auto analysed = [](double frequency_hz) {
    const TemporaryFolder folder;
    const auto config = folder.Write("scaled.yaml", Problem(frequency_hz, 1.0));
    const std::string out = " --quiet --out " + folder.path().string();
    const ProgramResult simulated = RunHowl("simulate " + config.string() + out);
    EXPECT_EQ(simulated.status, 0) << frequency_hz << " Hz: " << simulated.err;
    const ProgramResult run = RunHowl("analyse " + (folder.path() / "records.yaml").string() + out);
    EXPECT_EQ(run.status, 0) << frequency_hz << " Hz: " << run.err;
    return Json::parse(ReadFile(folder.path() / "analysis.json"))["experiments"];
  };
  const Json expected = analysed(220.0);
  ASSERT_EQ(expected.size(), 2u);
  for (const double scale : {std::exp2(-8), std::exp2(8)}) {
    const Json got = analysed(220.0 * scale);
    ASSERT_EQ(got.size(), 2u);
    for (const std::size_t i : {0u, 1u}) {
      const auto ratio = [&](const char* pointer) {
        const Json::json_pointer at(pointer);
        return got[i][at]["value"].get<double>() / expected[i][at]["value"].get<double>();
      };
      EXPECT_EQ(got[i]["cycle"]["state"], "limit_cycle") << scale;
      EXPECT_EQ(expected[i]["cycle"]["state"], "limit_cycle");
      EXPECT_NEAR(ratio("/cycle/frequency") / scale, 1.0, 1e-6) << scale;
      EXPECT_NEAR(ratio("/cycle/gain"), 1.0, 1e-4) << scale;
      EXPECT_NEAR(ratio("/loop_gain"), 1.0, 1e-4) << scale;
      EXPECT_NEAR(ratio("/tau") * scale, 1.0, 1e-4) << scale;
    }
  }
}

}  // namespace
}  // namespace howl::scaling_test

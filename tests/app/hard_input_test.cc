// What users hand over half written or by mistake, through the program: one line on standard error,
// exit status 2 (or 1 where the answer is negative), and nothing that crashes, hangs or is silent.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "tests/app/program.h"

namespace howl::hard_input_test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const std::string kGood =
    "experiments:\n"
    "  - {name: e1, phi: 0.5, frequency_hz: 219.9, phase_deg: -5.74, gain: 12.14, flame_slope: "
    "-0.703e-4}\n";

std::string With(const std::string& old, const std::string& by) {
  std::string text = kGood;
  return text.replace(text.find(old), old.size(), by);
}

class HardInput : public testing::Test {
 protected:
  ProgramResult Run(const std::string& command, const std::string& text,
                    const std::string& more = "") {
    config_ = folder_.Write("c.yaml", text).string();
    out_ = folder_.path() / "out";
    return RunHowl(command + " " + config_ + " --threads 1 --out " + out_.string() + " " + more);
  }

  void ExpectRefused(const std::string& command, const std::string& text, const std::string& place,
                     const std::string& what) {
    const ProgramResult run = Run(command, text);
    EXPECT_EQ(run.status, 2) << text;
    EXPECT_EQ(run.out, "") << text;
    EXPECT_EQ(std::ranges::count(run.err, '\n'), 1) << run.err;
    EXPECT_THAT(run.err, StartsWith(config_ + ":" + place + ": "));
    EXPECT_THAT(run.err, HasSubstr(what));
    EXPECT_FALSE(std::filesystem::exists(out_)) << text;
  }

  // p, q in step at 220 Hz.
  void WriteRecord(double p_scale, const std::string& name = "r.csv", int samples = 600) {
    std::string text = "p,q\n";
    for (int i = 0; i < samples; ++i) {
      const double angle = 2.0 * std::numbers::pi * 220.0 * i / 5000.0;
      char line[100];
      std::snprintf(line, sizeof line, "%.17g,%.17g\n", p_scale * std::sin(angle),
                    std::cos(angle + 0.2));
      text += line;
    }
    folder_.Write(name, text);
  }

  TemporaryFolder folder_;
  std::string config_;
  std::filesystem::path out_;
};

const std::string kRecord =
    "experiments: [{name: e1, phi: 0.5, record: {file: r.csv, pressure: p, heat_release: q, "
    "sampling_hz: 5000}}]\n";

TEST_F(HardInput, AFitOfNoResidualIsAMistake) {
  const std::string none =
      "residuals: {gain_equality: off, phase_equality: off, limit_cycle_phase: off, "
      "limit_cycle_gain: off, damping_prior: off, omega_prior: off, tau_prior: off, "
      "xi_increasing: off, transfer: off, second_crossing: off}\n";
  ExpectRefused("fit", kGood + none, "3: residuals", "expected at least one that does");
  // Without a slope nothing is left of limit_cycle_gain.
  ExpectRefused("fit",
                With(", flame_slope: -0.703e-4", "") +
                    "residuals: {gain_equality: off, phase_equality: off, limit_cycle_phase: off, "
                    "damping_prior: off}\n",
                "3: residuals", "expected at least one that does");
}

TEST_F(HardInput, NumbersLieWithinTheRangeOfTheArithmetic) {
  const std::string expected = "expected 0 or a number of magnitude from 1e-30 to 1e30";
  for (const char* const gain : {"1e-200", "1e300", "5.0e-324", "1.1e30", "0.9e-30"}) {
    ExpectRefused("fit", With("12.14", gain), "2: experiments[0].gain", expected);
  }
  ExpectRefused("analyse", With("0.5", "-1e31"), "2: experiments[0].phi", expected);
  ExpectRefused("analyse", With("0.5", "1e-400"), "2: experiments[0].phi", expected);
  ExpectRefused("simulate", kGood + "simulate: {sampling_hz: 1e-300}\n", "3: simulate.sampling_hz",
                expected);
  for (const char* const gain : {"1e30", "1e-30"}) {
    EXPECT_EQ(Run("fit", With("12.14", gain)).status, 0) << gain;
  }
}

TEST_F(HardInput, SamplesLieWithinTheRangeOfTheArithmetic) {
  const std::string data = (folder_.path() / "r.csv").string();
  const auto message = [&](double scale) {
    WriteRecord(scale);
    const ProgramResult run = Run("analyse", kRecord);
    EXPECT_EQ(run.status, 2) << scale;
    EXPECT_EQ(std::ranges::count(run.err, '\n'), 1) << run.err;
    return run.err;
  };
  EXPECT_THAT(message(1e100), StartsWith(data + ":3: p: "));
  EXPECT_THAT(message(1e100),
              HasSubstr("is out of range, expected a number of magnitude up to 1e30"));
  EXPECT_THAT(message(1e-200), StartsWith(data + ":2: p: "));
  EXPECT_THAT(message(1e-200), HasSubstr("expected a signal that moves by 1e-30 or more"));
  for (const double scale : {1e-29, 1e29}) {
    WriteRecord(scale);
    EXPECT_EQ(Run("analyse", kRecord).status, 0) << scale;
  }
}

TEST_F(HardInput, ShortRecordsAreAnalysedOrRefused) {
  for (const int samples : {1, 15, 16, 20, 31}) {
    WriteRecord(1.0, "r.csv", samples);
    const ProgramResult run = Run("analyse", kRecord);
    EXPECT_EQ(run.status, 2) << samples;
    EXPECT_THAT(run.err, HasSubstr(std::to_string(samples) + " samples, expected at least 32"));
  }
  for (const int samples : {32, 33, 40, 63, 64, 100, 127}) {
    WriteRecord(1.0, "r.csv", samples);
    for (const char* const command : {"analyse", "fit", "diagnose"}) {
      const ProgramResult run = Run(command, kRecord);
      EXPECT_LE(run.status, 2) << command << " " << samples << run.err;
      if (run.status != 2) continue;
      EXPECT_EQ(std::ranges::count(run.err, '\n'), 1) << run.err;
    }
  }
}

TEST_F(HardInput, SimulationsAreRefusedBeforeTheyRun) {
  const auto simulate = [](const std::string& keys) {
    return kGood + "simulate: {" + keys + "}\n";
  };
  ExpectRefused("simulate", simulate("sampling_hz: 430"), "3: simulate.sampling_hz",
                "430 Hz does not show the cycle of e1 at 219.9 Hz");
  ExpectRefused("simulate", simulate("sampling_hz: 1e12, duration_s: 1e-9"), "3: simulate",
                "expected at most 1e+08 of each");
  ExpectRefused("simulate", simulate("sampling_hz: 1e12"), "3: simulate.duration_s",
                "GB of memory");
  ExpectRefused("simulate", simulate("duration_s: 1e-6"), "3: simulate.duration_s",
                "samples, expected at least 32");
  ExpectRefused("simulate", simulate("settle_s: 1e20"), "3: simulate", "steps of the scheme");
}

TEST_F(HardInput, AFamilyEndsWithoutASlope) {
  const std::string family = "family: {members: 5, width: 0.1, test: {loop_gain_min: null}}\n";
  for (const char* const slope : {"0", "-1e-30"}) {
    const ProgramResult run = Run("family", With("-0.703e-4", slope) + family);
    ASSERT_EQ(run.status, 0) << run.err;
    const auto json = nlohmann::json::parse(ReadFile(out_ / "family.json"));
    bool found = false;
    for (const auto& prediction : json["predictions"]) {
      if (prediction["name"] != "growth_rate") continue;
      found = true;
      EXPECT_LT(prediction["interval"][1].get<double>(), 0.0);  // no flame feeds the loop
    }
    EXPECT_TRUE(found);
  }
  const ProgramResult strong =
      Run("family", With("12.14", "1e30") + "family: {members: 5, width: 0.1}\n");
  EXPECT_EQ(strong.status, 0) << strong.err;
}

TEST_F(HardInput, NamesThatCannotBeUsed) {
  const auto named = [](const std::string& name) { return With("e1", name); };
  ExpectRefused("simulate", named("family"), "2: experiments[0].name",
                "\"family\" is the name of a file of results, family.csv, expected another name");
  ExpectRefused("simulate", named("\"a\\0b\""), "2: experiments[0].name", "byte 0x00");
  ExpectRefused("simulate", named("\"a\\eb\""), "2: experiments[0].name", "byte 0x1b");
  ExpectRefused("simulate", named("\"a${HOME}\""), "2: experiments[0].name", "has ${");
}

TEST_F(HardInput, AFullDiskBehindTheOutputIsNoSuccess) {
  const std::string config = folder_.Write("c.yaml", kGood).string();
  const std::string err = (folder_.path() / "err").string();
  const int raw = std::system((std::string(HOWL_PROGRAM) + " fit " + config + " --out " +
                               folder_.path().string() + "/out >/dev/full 2>" + err)
                                  .c_str());
  EXPECT_EQ(WEXITSTATUS(raw), 2);
  EXPECT_THAT(ReadFile(err), StartsWith("standard output: cannot be written: "));
}

TEST_F(HardInput, AConfigWithoutANameGivesNoFolder) {
  folder_.Write("...yaml", kGood);
  const ProgramResult run = RunHowl("fit " + (folder_.path() / "...yaml").string());
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("expected --out DIR"));
}

TEST_F(HardInput, FalsifysFileIsReadBeforeTheSearch) {
  const ProgramResult run =
      Run("family", kGood, "--save-every 1e-9 --falsify " + (folder_.path() / "no.yaml").string());
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, StartsWith((folder_.path() / "no.yaml").string() + ": "));
  EXPECT_FALSE(std::filesystem::exists(out_ / "bounds.state"));
}

TEST_F(HardInput, RecordsWithoutACycleGiveOneLine) {
  std::string text = "p,q\n";
  unsigned state = 1;
  const auto noise = [&] {
    state = state * 1664525u + 1013904223u;
    return std::to_string(state >> 16);
  };
  for (int i = 0; i < 4000; ++i) text += noise() + "," + noise() + "\n";
  folder_.Write("r.csv", text);
  const ProgramResult run = Run("fit", kRecord);
  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(std::ranges::count(run.err, '\n'), 1) << run.err;
  EXPECT_THAT(run.err, HasSubstr("no record shows a limit cycle"));
}

TEST_F(HardInput, OneBadFieldCostsOnePartOfTheReport) {
  ASSERT_EQ(Run("fit", kGood).status, 0);
  folder_.Write("out/analysis.json",
                "{\"schema\": \"howl.analysis/1\", \"health\": [{\"text\": 5}], "
                "\"experiments\": [{\"name\": 7, \"phi\": \"x\", \"cycle\": 3}]}");
  const ProgramResult run = RunHowl("report " + out_.string() + " --threads 1");
  EXPECT_EQ(run.status, 0) << run.err;
  const std::string page = ReadFile(out_ / "report.html");
  EXPECT_THAT(page, HasSubstr("of another type than howl writes"));
  EXPECT_THAT(page, HasSubstr("Loops that fit"));
}

TEST_F(HardInput, AHangingGnuplotIsEnded) {
  ASSERT_EQ(Run("fit", kGood).status, 0);
  const auto fake = folder_.Write("bin_gnuplot", "#!/bin/sh\nexec /bin/sleep 100\n");
  std::filesystem::create_directory(folder_.path() / "bin");
  std::filesystem::rename(fake, folder_.path() / "bin/gnuplot");
  chmod((folder_.path() / "bin/gnuplot").c_str(), 0755);
  std::filesystem::create_directory(folder_.path() / "tmp");
  const std::string environment = "env PATH=" + (folder_.path() / "bin").string() +
                                  " TMPDIR=" + (folder_.path() / "tmp").string() + " ";
  const auto howl = [&](const std::string& arguments) {
    const std::string command = environment + arguments + " >" + (folder_.path() / "o").string();
    return WEXITSTATUS(std::system(command.c_str()));
  };
  EXPECT_EQ(howl(std::string(HOWL_PROGRAM) + " report " + out_.string() + " --figure-seconds 0.2"),
            0);
  EXPECT_THAT(ReadFile(out_ / "report.html"), HasSubstr("it took too long, and was ended"));
  // Ended by the user, it leaves nothing behind.
  EXPECT_EQ(
      howl("/usr/bin/timeout -s TERM 2 " + std::string(HOWL_PROGRAM) + " report " + out_.string()),
      124);
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path() / "tmp"));
}

}  // namespace
}  // namespace howl::hard_input_test

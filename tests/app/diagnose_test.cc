// The program's diagnosis: resumed after an interruption, against a reference, with mistakes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "model/effects/catalogue.h"
#include "tests/app/program.h"

namespace howl::diagnose_test {
namespace {

constexpr const char* kRig =
    "experiments:\n"
    "  - {name: exp1, phi: 0.56, frequency_hz: 219.9, phase_deg: -5.74, gain: 12.14, flame_slope: "
    "-0.703e-4}\n"
    "  - {name: exp2, phi: 0.53, frequency_hz: 209.1, phase_deg: -9.44, gain: 13.15, flame_slope: "
    "-0.711e-4}\n"
    "simulate: {duration_s: 1.7}\n";

// Two short records, simulated; the config that names them.
std::string SimulatedRig(const TemporaryFolder& folder, const std::string& name,
                         const std::string& seed) {
  const std::string config = folder.Write(name + ".yaml", kRig).string();
  const std::string out = (folder.path() / name).string();
  EXPECT_EQ(RunHowl("simulate " + config + " --seed " + seed + " --quiet --out " + out).status, 0);
  return out + "/records.yaml";
}

TEST(Diagnose, AnInterruptedRunGoesOnToTheSameResult) {
  const TemporaryFolder folder;
  const std::string rig = SimulatedRig(folder, "rig", "1");
  const std::string whole = (folder.path() / "whole").string();
  const std::string parts = (folder.path() / "parts").string();
  ASSERT_EQ(RunHowl("diagnose " + rig + " --quiet --out " + whole).status, 0);
  // Stopped when some more fits are kept; killed, so that an entry may be cut off.
  const std::string script = folder
                                 .Write("stop.sh",
                                        "\"$1\" diagnose \"$2\" --quiet --out \"$3\" &\n"
                                        "for i in $(seq 3000); do\n"
                                        "  size=$(stat -c %s \"$3/diagnosis.state\" 2>/dev/null)\n"
                                        "  [ \"${size:-0}\" -gt $((100000 + $5)) ] && break\n"
                                        "  sleep 0.02\n"
                                        "done\n"
                                        "kill -\"$4\" $!\n"
                                        "wait $!\n")
                                 .string();
  const auto stop = [&](const std::string& signal) {
    std::error_code none_yet;
    const auto kept = std::filesystem::file_size(parts + "/diagnosis.state", none_yet);
    const std::uintmax_t size = none_yet ? 0 : kept;
    const std::string command = "bash " + script + " " + HOWL_PROGRAM + " " + rig + " " + parts +
                                " " + signal + " " + std::to_string(size) + " >/dev/null 2>&1";
    return std::system(command.c_str());
  };
  EXPECT_EQ(WEXITSTATUS(stop("KILL")), 137);
  ASSERT_TRUE(std::filesystem::exists(parts + "/diagnosis.state"));
  EXPECT_FALSE(std::filesystem::exists(parts + "/diagnosis.json"));
  std::filesystem::resize_file(parts + "/diagnosis.state",
                               std::filesystem::file_size(parts + "/diagnosis.state") - 7);
  EXPECT_EQ(WEXITSTATUS(stop("TERM")), 130);
  const ProgramResult rest = RunHowl("diagnose " + rig + " --threads 1 --out " + parts);
  EXPECT_EQ(rest.status, 0);
  EXPECT_THAT(rest.err, testing::HasSubstr("going on from"));
  EXPECT_EQ(ReadFile(parts + "/diagnosis.json"), ReadFile(whole + "/diagnosis.json"));
  EXPECT_FALSE(std::filesystem::exists(parts + "/diagnosis.state"));
}

// The catalogue but these, for --without.
std::string AllBut(const std::vector<std::string>& kept) {
  std::string all;
  for (const EffectPointer& effect : Catalogue()) {
    if (std::ranges::find(kept, effect->id()) == kept.end())
      all += (all.empty() ? "" : ",") + std::string(effect->id());
  }
  return all;
}

// Where each entry of a state file ends, its first line's end before them.
std::vector<std::size_t> EntryEnds(const std::string& state) {
  std::vector<std::size_t> ends = {state.find('\n') + 1};
  while (ends.back() < state.size()) {
    const std::size_t line_end = state.find('\n', ends.back());
    std::istringstream words(state.substr(ends.back(), line_end - ends.back()));
    std::string key;
    std::size_t size = 0;
    EXPECT_TRUE(words >> key >> size) << key;
    ends.push_back(line_end + 1 + size + 1);
  }
  return ends;
}

std::string StateWithEachKeyOnce(const std::string& state) {
  std::set<std::string> keys;
  const std::vector<std::size_t> ends = EntryEnds(state);
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const std::string key = state.substr(ends[i], state.find(' ', ends[i]) - ends[i]);
    EXPECT_TRUE(keys.insert(key).second) << key << " is there twice";
  }
  return state;
}

TEST(LongDiagnose, StoppedAtAnyUnitItGoesOnToTheSameBytes) {
  const TemporaryFolder folder;
  const std::string config =
      folder
          .Write("skewed.yaml", std::string(kRig).substr(0, std::string(kRig).find("simulate")) +
                                    "simulate: {duration_s: 1.7, effects: [{effect: channel_skew, "
                                    "skew_s: 2e-4}]}\n")
          .string();
  const std::string out = (folder.path() / "rig").string();
  ASSERT_EQ(RunHowl("simulate " + config + " --quiet --out " + out).status, 0);
  const std::string command = "diagnose " + out + "/records.yaml --one-cause --quiet --without " +
                              AllBut({"channel_skew"}) + " --out " + out;
  ASSERT_EQ(RunHowl(command).status, 0);
  const std::string whole = ReadFile(out + "/diagnosis.json");
  ASSERT_TRUE(nlohmann::json::parse(whole)["gap"]["shrinkage_by_no_meaning"].is_number());
  // Where the result cannot be written the state stays, with every unit in it.
  std::filesystem::remove(out + "/diagnosis.json");
  std::filesystem::create_directory(out + "/diagnosis.json");
  ASSERT_NE(RunHowl(command).status, 0);
  std::filesystem::remove(out + "/diagnosis.json");
  const std::string state = StateWithEachKeyOnce(ReadFile(out + "/diagnosis.state"));
  const std::vector<std::size_t> ends = EntryEnds(state);
  ASSERT_EQ(ends.size(), 1u + 1u + 11u);  // the line, the effect, eleven placebos
  for (const std::size_t end : ends) {
    folder.Write("rig/diagnosis.state", state.substr(0, end));
    ASSERT_EQ(RunHowl(command).status, 0);
    EXPECT_EQ(ReadFile(out + "/diagnosis.json"), whole) << "stopped after " << end << " bytes";
  }
}

TEST(Diagnose, AStateOfAnotherBuildOrWithAKeyTwiceIsNotBelieved) {
  const TemporaryFolder folder;
  const std::string rig = SimulatedRig(folder, "rig", "1");
  const std::string out = (folder.path() / "out").string();
  const std::string command =
      "diagnose " + rig + " --one-cause --without " + AllBut({"channel_skew"}) + " --out " + out;
  std::filesystem::create_directories(out + "/diagnosis.json");
  ASSERT_NE(RunHowl(command).status, 0);
  std::filesystem::remove(out + "/diagnosis.json");
  const std::string state = ReadFile(out + "/diagnosis.state");
  const std::vector<std::size_t> ends = EntryEnds(state);
  ASSERT_GE(ends.size(), 2u);
  const std::string entry = state.substr(ends[0], ends[1] - ends[0]);
  const std::string other_build = "howl.diagnosis.state 0.1.0 1 2\n" + state.substr(ends[0]);
  for (const std::string& doubtful : {other_build, state.substr(0, ends[1]) + entry}) {
    folder.Write("out/diagnosis.state", doubtful);
    const ProgramResult run = RunHowl(command);
    EXPECT_EQ(run.status, 0);
    EXPECT_THAT(run.err, testing::HasSubstr("begun anew"));
  }
  folder.Write("out/diagnosis.state", state);
  EXPECT_THAT(RunHowl(command).err, testing::HasSubstr("going on from"));
}

// records.yaml as it is, and with its model or its delays changed.
TEST(LongDiagnose, TheBaseIsTheConfigsModel) {
  const TemporaryFolder folder;
  const std::string rig = SimulatedRig(folder, "rig", "1");
  std::string whole = ReadFile(rig);
  const std::string stated = "model: {modes: 1, harmonic_ratio: 3}";
  const std::size_t at = whole.find(stated);
  ASSERT_NE(at, std::string::npos) << whole;
  const auto base = [&](const std::string& model) {
    std::string text = whole;
    text.replace(at, stated.size(), model);
    folder.Write("rig/other.yaml", text);
    const std::string out = (folder.path() / "other").string();
    const std::string config = (folder.path() / "rig" / "other.yaml").string();
    const ProgramResult run = RunHowl("diagnose " + config + " --one-cause --without " +
                                      AllBut({"mode_detuning", "channel_skew"}) + " --out " + out);
    EXPECT_EQ(run.status, 0) << run.err;
    return nlohmann::json::parse(ReadFile(out + "/diagnosis.json"));
  };
  const auto one = base(stated);
  EXPECT_EQ(one["base"]["modes"], 1);
  EXPECT_TRUE(one["base"]["second_mode_gain"].is_null());
  EXPECT_EQ(one["base"]["tau_scope"], "experiment");
  EXPECT_EQ(one["candidates"].size(), 1u);
  const auto two = base("model: {modes: 2, harmonic_ratio: 2.8}");
  EXPECT_EQ(two["base"]["modes"], 2);
  EXPECT_EQ(two["base"]["harmonic_ratio"], 2.8);
  EXPECT_EQ(two["candidates"].size(), 2u);
  // Where nothing is stated the records choose, and it is said.
  const auto chosen = base("");
  EXPECT_EQ(chosen["base"]["modes"], 1);
  EXPECT_TRUE(chosen["base"]["second_mode_gain"].is_number());
  EXPECT_TRUE(chosen["base"]["own_delays_gain"].is_null());
  const std::string scope = "parameters: {tau_s: {scope: experiment}}";
  const std::size_t scope_at = whole.find(scope);
  ASSERT_NE(scope_at, std::string::npos) << whole;
  whole.replace(scope_at, scope.size(), "parameters: {tau_s: {scope: shared}}");
  const auto shared = base(stated);
  EXPECT_EQ(shared["base"]["tau_scope"], "shared");
  EXPECT_EQ(shared["base"]["tau_scatter"], 0.0);
  whole.replace(scope_at, std::string("parameters: {tau_s: {scope: shared}}").size(), "");
  const auto own = base(stated);
  EXPECT_EQ(own["base"]["tau_scope"], "experiment");
  EXPECT_GT(own["base"]["own_delays_gain"], 16.0);
}

// What a user tries first, with a few of the candidates.
TEST(LongDiagnose, TheShippedConfigIsNotAccusedAndAnEffectAddedToItIsNamed) {
  const TemporaryFolder folder;
  const auto verdict = [&](const std::string& name, const std::string& added) {
    const std::string config =
        folder.Write(name + ".yaml", ReadFile(Config("r228")) + added).string();
    const std::string out = (folder.path() / name).string();
    EXPECT_EQ(RunHowl("simulate " + config + " --quiet --out " + out).status, 0);
    const ProgramResult run = RunHowl(
        "diagnose " + out + "/records.yaml --without " +
        AllBut({"q_sensor_lowpass", "channel_skew", "delay_varies_with_phi"}) + " --out " + out);
    EXPECT_EQ(run.status, 0) << run.err;
    return run.out;
  };
  EXPECT_THAT(verdict("null", ""), testing::StartsWith("verdict: none"));
  EXPECT_THAT(verdict("lag", "simulate: {effects: [{effect: q_sensor_lowpass, cutoff_hz: 245}]}\n"),
              testing::StartsWith("verdict: q_sensor_lowpass"));
}

TEST(Diagnose, AgainstAReferenceOfTheSameLoopThereIsNothingToName) {
  const TemporaryFolder folder;
  const std::string rig = SimulatedRig(folder, "rig", "1");
  const std::string reference = SimulatedRig(folder, "reference", "2");
  const std::string out = (folder.path() / "out").string();
  const ProgramResult result =
      RunHowl("diagnose " + rig + " --reference " + reference + " --out " + out);
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, testing::StartsWith("verdict: none"));
}

TEST(Diagnose, AReferenceWithoutTheOperatingPoints) {
  const TemporaryFolder folder;
  const std::string rig = SimulatedRig(folder, "rig", "1");
  const std::string reference =
      folder
          .Write("other.yaml",
                 "experiments:\n"
                 "  - {name: a, phi: 0.4, record: {file: rig/exp1.csv, pressure: p, "
                 "heat_release: q, sampling_hz: 5000}}\n")
          .string();
  const ProgramResult result = RunHowl("diagnose " + rig + " --reference " + reference + " --out " +
                                       (folder.path() / "out").string());
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.err, reference +
                            ":2: experiments: have none called exp1, and none on both sides of its "
                            "phi 0.56, expected one or the other\n");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out" / "diagnosis.state"));
}

TEST(Diagnose, ARateInKilohertzIsAMistake) {
  const TemporaryFolder folder;
  SimulatedRig(folder, "rig", "1");
  const std::string rig =
      folder
          .Write("kilohertz.yaml",
                 "experiments:\n"
                 "  - name: a\n"
                 "    phi: 0.4\n"
                 "    record: {file: rig/exp1.csv, pressure: p, heat_release: q, sampling_hz: 5}\n")
          .string();
  const std::string out = (folder.path() / "out").string();
  const ProgramResult result = RunHowl("diagnose " + rig + " --out " + out);
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.err,
            rig + ":2: experiments: a is sampled at 5.00 Hz, expected at least 100 Hz\n");
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST(Diagnose, TooFewReplicatesOrAReferenceWithThemAreMistakes) {
  const TemporaryFolder folder;
  const std::string rig = SimulatedRig(folder, "rig", "1");
  const std::string out = (folder.path() / "out").string();
  const ProgramResult few = RunHowl("diagnose " + rig + " --bootstrap 5 --out " + out);
  EXPECT_EQ(few.status, 2);
  EXPECT_THAT(few.err, testing::HasSubstr("--bootstrap"));
  const ProgramResult both =
      RunHowl("diagnose " + rig + " --bootstrap 19 --reference " + rig + " --out " + out);
  EXPECT_EQ(both.status, 2);
  EXPECT_THAT(both.err, testing::HasSubstr("expected one or the other"));
  EXPECT_FALSE(std::filesystem::exists(out + "/diagnosis.json"));
}

TEST(Diagnose, WhatNeedsRecordsIsAMistakeOnATable) {
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "out").string();
  for (const std::string option : {"--bootstrap 19", "--without channel_skew"}) {
    const ProgramResult result =
        RunHowl("diagnose " + Config("r228_two_modes") + " " + option + " --out " + out);
    EXPECT_EQ(result.status, 2) << option;
    EXPECT_THAT(result.err, testing::HasSubstr("needs records of p and q")) << option;
    EXPECT_FALSE(std::filesystem::exists(out + "/diagnosis.json"));
  }
}

// What was lost of q is not put back, and nothing is named beside it.
TEST(Diagnose, AClippedHeatReleaseIsTheWholeAnswer) {
  const TemporaryFolder folder;
  std::string rig = kRig;
  rig.replace(rig.find("duration_s: 1.7"), 15,
              "duration_s: 1.7, effects: [{effect: q_clipping, fraction: 0.8}]");
  const std::string config = folder.Write("rig.yaml", rig).string();
  const std::string records = (folder.path() / "rig").string();
  ASSERT_EQ(RunHowl("simulate " + config + " --quiet --out " + records).status, 0);
  const std::string out = (folder.path() / "out").string();
  const ProgramResult run = RunHowl("diagnose " + records + "/records.yaml --out " + out);
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, testing::HasSubstr("verdict: q_clipping ("));
  EXPECT_THAT(run.out, testing::HasSubstr("next: record again, within the converter's range"));
  const auto found = nlohmann::json::parse(ReadFile(out + "/diagnosis.json"));
  EXPECT_EQ(found.at("verdict").at("effect"), "q_clipping");
  EXPECT_TRUE(found.at("verdict").at("indistinguishable").empty());
  EXPECT_EQ(found.at("candidates").size(), 1u);
  ASSERT_EQ(found.at("seen_in_samples").size(), 1u);
  EXPECT_GT(found.at("seen_in_samples")[0].at("value").get<double>(), 0.2);
}

// Before any measurement the records are simulated from the table's fit.
TEST(Diagnose, APlanIsMadeForATableAndForRecords) {
  const TemporaryFolder folder;
  const std::string rig = SimulatedRig(folder, "rig", "1");
  std::string without;
  for (const EffectPointer& effect : Catalogue()) {
    const std::string id(effect->id());
    if (id != "channel_skew" && id != "q_clipping" && without.find(id) == std::string::npos) {
      without += (without.empty() ? "" : ",") + id;
    }
  }
  for (const std::string& config : {(folder.path() / "rig.yaml").string(), rig}) {
    const std::string out = (folder.path() / "plan").string();
    const ProgramResult run =
        RunHowl("diagnose " + config + " --plan --without " + without + " --out " + out);
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_THAT(run.out, testing::HasSubstr("plan for 2 records"));
    EXPECT_FALSE(std::filesystem::exists(out + "/diagnosis.json"));
    const auto plan = nlohmann::json::parse(ReadFile(out + "/plan.json"));
    EXPECT_EQ(plan.at("records"), config == rig ? "measured" : "simulated");
    ASSERT_EQ(plan.at("effects").size(), 2u);
    EXPECT_GT(plan.at("effects")[0].at("smallest").get<double>(), 0.0);
    EXPECT_LT(plan.at("effects")[1].at("smallest").get<double>(), 1.2);
  }
}

TEST(Diagnose, MistakesOfAPlanAreOneLine) {
  const TemporaryFolder folder;
  const std::string config = folder.Write("rig.yaml", kRig).string();
  for (const std::string words : {"--bootstrap 19", "--reference x.yaml", "--without flame_lag"}) {
    const ProgramResult run = RunHowl("diagnose " + config + " --plan " + words + " --out " +
                                      (folder.path() / "out").string());
    EXPECT_EQ(run.status, 2) << words;
    EXPECT_EQ(std::ranges::count(run.err, '\n'), 1) << run.err;
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "out" / "plan.json"));
  }
  const std::string pressure = folder
                                   .Write("p.yaml",
                                          "experiments:\n  - {name: a, phi: 0.5, record: {file: "
                                          "a.csv, pressure: p, sampling_hz: 5000}}\n")
                                   .string();
  std::string samples = "p\n";
  for (int i = 0; i < 5000; ++i) samples += std::to_string(std::sin(0.27 * i)) + "\n";
  folder.Write("a.csv", samples);
  const ProgramResult run = RunHowl("diagnose " + pressure + " --plan");
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, testing::HasSubstr("expected both signals"));
}

TEST(Diagnose, TheBootstrapsGainsAreWritten) {
  const TemporaryFolder folder;
  const std::string rig = SimulatedRig(folder, "rig", "1");
  const std::string out = (folder.path() / "out").string();
  const ProgramResult run = RunHowl("diagnose " + rig + " --bootstrap 19 --without " +
                                    AllBut({"delay_varies_with_phi"}) + " --out " + out);
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, testing::HasSubstr("19 rigs simulated from the refitted base"));
  const auto diagnosis = nlohmann::json::parse(ReadFile(out + "/diagnosis.json"));
  EXPECT_EQ(diagnosis["bootstrap"]["replicates"], 19);
  EXPECT_EQ(diagnosis["bootstrap"]["largest_gains"].size(), 19u);
  EXPECT_GE(diagnosis["candidates"][0]["p_value"].get<double>(), 0.05);
}

}  // namespace
}  // namespace howl::diagnose_test

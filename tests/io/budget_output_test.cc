// A budget as diagnosis.json and the report have it.
#include <gtest/gtest.h>

#include <limits>

#include "io/report/figures/catalogue.h"
#include "io/results/diagnosis_json.h"

namespace howl::budget_output_test {
namespace {

Diagnosis Example() {
  Diagnosis diagnosis;
  diagnosis.kind = VerdictKind::kUnknown;
  Budget budget;
  budget.experiments = 6;
  budget.gap_before = 0.8;
  budget.gap_left = 0.3;
  budget.floor = 0.1;
  budget.stated.model = "model: {modes: 2, delay_spread: normal}";
  budget.stated.heat_release_response = "1 / (1 + s / (2 pi 400))";
  budget.stated.not_stated = {"slow_drift"};
  BudgetEntry noise;
  noise.item = "q_sensor_noise";
  noise.gap_before = 0.8;
  noise.gap_after = 0.5;
  noise.lost_nats = 90.0;
  noise.lost_gap = 0.25;
  noise.lost_on_halves = {40.0, -3.0};
  noise.experiments_better = 5;
  BudgetEntry effect = noise;
  effect.item = "delay_dispersion";
  effect.gap_before = 0.5;
  effect.gap_after = 0.3;
  effect.equals = {"flame_lowpass"};
  effect.parameters = {{"sigma_s", 1e-4, 0.9e-4, 1.1e-4, "s"}};
  budget.entries = {noise, effect};
  budget.seen_in_samples = {{"quantisation", 24.0, 5}};
  budget.given = {{"mains_hum", "", {{"hz", 50.0, 50.0, 50.0, "Hz"}}}};
  budget.not_found = {{"q_sensor_lowpass", "order 1", "cutoff_hz", "Hz", 2000.0,
                       std::numeric_limits<double>::infinity()}};
  budget.left_by_octave = {{"exp2", LoopBlock::kFlame, -1, 70.0, 140.0, 0.4, 0.6}};
  budget.left = {{LoopBlock::kFlame, 100.0, 240.0, {"exp2"}, 0.7}};
  diagnosis.budget = budget;
  return diagnosis;
}

TEST(BudgetOutput, JsonHasTheContractsKeys) {
  const nlohmann::ordered_json json = DiagnosisJson(Example());
  ASSERT_EQ(json["budget"].size(), 2u);
  const auto& effect = json["budget"][1];
  EXPECT_EQ(effect["item"], "delay_dispersion");
  EXPECT_EQ(effect["gap_before"], 0.5);
  EXPECT_EQ(effect["gap_after"], 0.3);
  EXPECT_EQ(effect["lost_without"]["nats"], 90.0);
  EXPECT_EQ(effect["lost_without"]["gap"], 0.25);
  EXPECT_EQ(effect["lost_without"]["halves"], (nlohmann::ordered_json{40.0, -3.0}));
  EXPECT_EQ(effect["lost_without"]["experiments_better"], (nlohmann::ordered_json{5, 6}));
  EXPECT_EQ(effect["class"], (nlohmann::ordered_json{"flame_lowpass"}));
  EXPECT_EQ(effect["parameters"]["sigma_s"]["lo"], 0.9e-4);
  EXPECT_EQ(json["seen_in_samples"][0]["effect"], "quantisation");
  EXPECT_EQ(json["seen_in_samples"][0]["value"], 24.0);
  EXPECT_EQ(json["seen_in_samples"][0]["experiments"], (nlohmann::ordered_json{5, 6}));
  EXPECT_EQ(json["given"][0]["item"], "mains_hum");
  EXPECT_EQ(json["given"][0]["parameters"]["hz"]["value"], 50.0);
  EXPECT_EQ(json["not_found"][0]["item"], "q_sensor_lowpass");
  EXPECT_EQ(json["not_found"][0]["form"], "order 1");
  EXPECT_EQ(json["not_found"][0]["parameter"], "cutoff_hz");
  EXPECT_EQ(json["not_found"][0]["lo"], 2000.0);
  EXPECT_TRUE(json["not_found"][0]["hi"].is_null());
  EXPECT_EQ(json["left"]["gap"], 0.3);
  EXPECT_EQ(json["left"]["floor"], 0.1);
  EXPECT_EQ(json["stated"]["model"], "model: {modes: 2, delay_spread: normal}");
  EXPECT_EQ(json["stated"]["heat_release_response"], "1 / (1 + s / (2 pi 400))");
  EXPECT_TRUE(json["stated"]["pressure_response"].is_null());
  EXPECT_EQ(json["stated"]["not_stated"], nlohmann::ordered_json{"slow_drift"});
  EXPECT_EQ(json["left"]["where"][0]["block"], "flame");
  const auto& octave = json["left"]["octaves"][0];
  EXPECT_EQ(octave["experiment"], "exp2");
  EXPECT_EQ(octave["block"], "flame");
  EXPECT_EQ(octave["octave"], -1);
  EXPECT_EQ(octave["band_hz"], (nlohmann::ordered_json{70.0, 140.0}));
  EXPECT_EQ(octave["gap"], 0.4);
  EXPECT_EQ(octave["share"], 0.6);
}

TEST(BudgetOutput, NoBudgetNoKeys) {
  Diagnosis diagnosis = Example();
  diagnosis.budget.reset();
  const nlohmann::ordered_json json = DiagnosisJson(diagnosis);
  EXPECT_FALSE(json.contains("budget"));
  EXPECT_FALSE(json.contains("left"));
}

TEST(BudgetOutput, TheFigureHasARowForEachItemAndForWhatIsLeft) {
  ReportInput input;
  input.diagnosis = DiagnosisJson(Example());
  const std::optional<Figure> figure = BudgetFigure(input);
  ASSERT_TRUE(figure);
  EXPECT_NE(figure->csv.find("taken,0.5,0.8,1,q_sensor_noise"), std::string::npos) << figure->csv;
  EXPECT_NE(figure->csv.find("taken,0.3,0.5,2,delay_dispersion"), std::string::npos);
  EXPECT_NE(figure->csv.find("left,0,0.3,3,left"), std::string::npos);
  input.diagnosis.erase("budget");
  EXPECT_FALSE(BudgetFigure(input));
}

}  // namespace
}  // namespace howl::budget_output_test


#include "io/config/sections/config_sections.h"
#include "model/numerics/constants.h"

namespace howl {
namespace {

// null switches a condition off, which for each condition is the value `off`.
void ReadLimit(const ConfigCursor& test, const char* key, double off, double& limit) {
  const auto cursor = test.Find(key);
  if (!cursor) return;
  limit = cursor->Node().kind == LocatedNode::Kind::kNull ? off : cursor->Node().number;
}

void ReadTest(const ConfigCursor& cursor, MembershipTest& test) {
  ReadLimit(cursor, "gain_tolerance", kInfinity, test.gain_tolerance);
  ReadLimit(cursor, "phase_tolerance_deg", kInfinity, test.phase_tolerance_deg);
  ReadLimit(cursor, "loop_phase_tolerance_deg", kInfinity, test.loop_phase_tolerance_deg);
  ReadLimit(cursor, "loop_gain_min", 0.0, test.loop_gain_min);
  ReadLimit(cursor, "second_crossing_tolerance_deg", kInfinity, test.second_crossing_tolerance_deg);
  ReadLimit(cursor, "omega_spread_max", kInfinity, test.omega_spread_max);
  ReadLimit(cursor, "xi_max", kInfinity, test.xi_max);
  cursor.Read("xi_increasing", test.xi_increasing);
  ReadLimit(cursor, "transfer_distance_max", kInfinity, test.transfer_distance_max);
  ReadLimit(cursor, "second_mode_share_max", kInfinity, test.second_mode_share_max);
  ReadLimit(cursor, "second_crossing_gain_min", 0.0, test.second_crossing_gain_min);
}

}  // namespace

void ReadFamily(const ConfigCursor& root, Config& config) {
  const auto family = root.Find("family");
  if (!family) return;
  family->Read("members", config.family.members);
  if (const auto draw = family->Find("draw")) {
    config.family.draw =
        draw->Node().text == "uniform" ? MemberDraw::kUniform : MemberDraw::kSpread;
  }
  family->Read("width", config.family.width);
  if (const auto test = family->Find("test")) ReadTest(*test, config.family.test);
  if (const auto predictions = family->Find("predictions")) {
    for (const ConfigCursor& item : predictions->Items()) {
      PredictionSpec prediction;
      item.Read("name", prediction.name);
      item.Read("expression", prediction.expression);
      prediction.line = item.Find("expression")->Node().line;
      config.family.predictions.push_back(std::move(prediction));
    }
  }
}

void ReadSolver(const ConfigCursor& root, Config& config) {
  const auto solver = root.Find("solver");
  if (!solver) return;
  solver->Read("starts", config.solver.starts);
  solver->Read("max_iterations", config.solver.max_iterations);
}

void ReadAnalysis(const ConfigCursor& root, Config& config) {
  const auto analysis = root.Find("analysis");
  if (!analysis) return;
  if (const auto method = analysis->Find("method")) {
    for (const CharacteristicsMethod each : kAnalysisMethods) {
      if (method->Node().text == AnalysisMethodName(each)) config.analysis.method = each;
    }
    // The name of the paper's method in configs written before it was called `paper`.
    if (method->Node().text == "seed") config.analysis.method = CharacteristicsMethod::kPaper;
  }
  analysis->Read("min_frequency_hz", config.analysis.min_frequency_hz);
  analysis->Read("max_frequency_hz", config.analysis.max_frequency_hz);
  if (config.analysis.max_frequency_hz &&
      *config.analysis.max_frequency_hz <= config.analysis.min_frequency_hz.value_or(0.0)) {
    analysis->Find("max_frequency_hz")
        ->Fail("is not above min_frequency_hz, expected min_frequency_hz < max_frequency_hz");
  }
  analysis->Read("delay_branch", config.analysis.delay_branch);
}

}  // namespace howl

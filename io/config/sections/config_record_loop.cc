#include <algorithm>
#include <optional>
#include <string>

#include "io/config/sections/config_sections.h"

namespace howl {
namespace {

constexpr int kPapersMostModes = 2;

bool IsText(const ConfigCursor& at) { return at.Node().kind == LocatedNode::Kind::kText; }

void ReadModes(const ConfigCursor& model, RecordLoopSpec& spec) {
  const auto modes = model.Find("modes");
  if (!modes) return;
  if (!IsText(*modes)) return model.Read("modes", spec.modes);
  if (modes->Node().text != "auto") {
    modes->Fail("is \"" + modes->Node().text + "\", expected a number from 1 to 8, or auto");
  }
  spec.choose_modes = true;
}

void ReadRatio(const ConfigCursor& model, RecordLoopSpec& spec) {
  const auto ratio = model.Find("ratio");
  if (!ratio) return;
  if (model.Find("harmonic_ratio")) {
    ratio->Fail("is given with harmonic_ratio, expected only one of the two");
  }
  if (!IsText(*ratio)) {
    double value = 0.0;
    model.Read("ratio", value);
    spec.ratio = value;
    return;
  }
  if (ratio->Node().text != "free") {
    ratio->Fail("is \"" + ratio->Node().text + "\", expected a number above 1, or free");
  }
  spec.ratio.reset();
}

FlameInput FlameInputNamed(const std::string& name) {
  if (name == "pressure") return FlameInput::kPressure;
  return name == "velocity" ? FlameInput::kVelocity : FlameInput::kPressureRate;
}

DelaySpread DelaySpreadNamed(const std::string& name) {
  if (name == "normal") return DelaySpread::kNormal;
  return name == "gamma" ? DelaySpread::kGamma : DelaySpread::kNone;
}

}  // namespace

void ReadRecordLoop(const ConfigCursor& model, Config& config) {
  RecordLoopSpec spec{.modes = config.model.modes,
                      .ratio = config.model.harmonic_ratio,
                      .own_damping = false,
                      .complex_residues = false};
  ReadModes(model, spec);
  ReadRatio(model, spec);
  std::string word;
  model.Read("damping", word);
  spec.own_damping = word == "own";
  model.Read("residue", word);
  spec.complex_residues = word == "complex";
  word.clear();
  model.Read("flame_input", word);
  spec.flame_input = FlameInputNamed(word);
  spec.choose_flame_input = word == "auto";
  word.clear();
  model.Read("delay_spread", word);
  spec.delay_spread = DelaySpreadNamed(word);
  int paths = 1;
  model.Read("delay_paths", paths);
  spec.second_path = paths == 2;
  model.Read("line_errors", spec.line_errors);
  config.model.modes = std::min(spec.modes, kPapersMostModes);
  config.model.harmonic_ratio = spec.ratio.value_or(config.model.harmonic_ratio);
  const bool papers = spec.modes <= kPapersMostModes && !spec.choose_modes && spec.ratio &&
                      !spec.own_damping && !spec.complex_residues &&
                      spec.flame_input == FlameInput::kPressureRate && !spec.choose_flame_input &&
                      spec.delay_spread == DelaySpread::kNone && !spec.second_path &&
                      spec.line_errors;
  if (!papers) config.record_loop = spec;
}

}  // namespace howl

// howl_rig: makes the records of a rig that is not howl's model.
#include <cmath>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "rig/help.h"
#include "rig/output.h"
#include "rig/plan.h"
#include "rig/recording.h"

namespace rig {
namespace {

int Simulate(const std::string& spec_path, const std::string& out, const std::string& key_path) {
  const Spec spec = LoadSpec(spec_path);
  const Plan plan = MakePlan(spec);
  const Grid grid = MakeGrid(plan, spec.sampling_hz, spec.refine);
  const auto samples = static_cast<std::size_t>(std::lround(spec.duration_s * spec.sampling_hz));
  const std::size_t lead = LeadSteps(plan, grid);
  const auto settle = static_cast<std::size_t>(spec.settle_s / grid.step_s);
  for (std::size_t k = 0; k < plan.points.size(); ++k) {
    const TrueSignals signals =
        March(plan, k, grid, settle, samples * grid.per_sample + 2 * lead, spec.seed);
    const Record record = Digitise(plan, k, grid, signals, samples, spec.sampling_hz, spec.seed);
    WriteFile(out + "/data/" + plan.points[k].name + ".csv", RecordCsv(record));
  }
  WriteFile(out + "/config.yaml", ConfigYaml(spec));
  const std::string key = KeyJson(spec, plan, grid);
  if (key_path.empty()) {
    std::fputs(key.c_str(), stdout);
  } else {
    WriteFile(key_path, key);
  }
  return 0;
}

int Run(const std::vector<std::string>& words) {
  std::string spec;
  std::string out;
  std::string key;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (word == "--help" || word == "-h") {
      std::fputs(HelpText().c_str(), stdout);
      return 0;
    }
    if (word == "--man") {
      std::fputs(ManPage().c_str(), stdout);
      return 0;
    }
    if (word == "--list") {
      std::fputs(EffectsTable().c_str(), stdout);
      return 0;
    }
    if (word == "--out" || word == "--key") {
      if (i + 1 == words.size())
        throw SpecError("howl_rig: " + word + ": expected a path after it");
      (word == "--out" ? out : key) = words[++i];
    } else if (word.starts_with("-") || !spec.empty()) {
      throw SpecError("howl_rig: " + word + ": not expected; howl_rig --help explains");
    } else {
      spec = word;
    }
  }
  if (spec.empty() || out.empty()) {
    throw SpecError("howl_rig: expected RIG.yaml --out DIR; howl_rig --help explains");
  }
  return Simulate(spec, out, key);
}

}  // namespace
}  // namespace rig

int main(int argc, char** argv) {
  try {
    return rig::Run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
  }
  return 2;
}

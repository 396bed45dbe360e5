#include "io/results/loop_diagnosis_json.h"

#include <string_view>

#include "estimation/joint_records/loop_names.h"
#include "io/results/diagnosis_json.h"
#include "io/results/solution_json.h"

namespace howl {
namespace {

using Json = nlohmann::ordered_json;

// As in a config's `model`; and the sources of noise, with how many coefficients each has.
Json FormJson(const LoopForm& form) {
  const PointStructure structure = AsStated(form.structure);
  Json noise = Json::object();
  for (const NoiseTerm& term : structure.noise) {
    noise[std::string(LoopNoiseName(term.source))] = term.coefficients;
  }
  return {{"modes", structure.modes},
          {"ratio", structure.ratio ? Json(*structure.ratio) : Json("free")},
          {"damping", structure.own_damping ? "own" : "shared"},
          {"residue", structure.complex_residues ? "complex" : "real"},
          {"flame_input", FlameInputName(form.flame_input)},
          {"delay_spread", DelaySpreadName(structure.delay_spread)},
          {"delay_paths", structure.second_path ? 2 : 1},
          {"noise", noise}};
}

Json LinesJson(const LinesLeft& lines) {
  return {{"size", NumberOrNull(lines.size)},
          {"nats", NumberOrNull(lines.nats)},
          {"experiments_better", lines.experiments_better},
          {"of_gain",
           {{"missed", NumberOrNull(lines.of_gain.missed)},
            {"bound", NumberOrNull(lines.of_gain.bound)},
            {"are", lines.AreOfGain()}}}};
}

}  // namespace

Json LoopDiagnosisJson(const LoopDiagnosis& found) {
  Json json = DiagnosisJson(found.diagnosis);
  for (const char* key : {"free_slack", "bootstrap", "base_parameters"}) {
    json.erase(key);
  }
  json["unknown_because"] =
      found.unknown_because.empty() ? Json(nullptr) : Json(found.unknown_because);
  json["base"] = FormJson(found.base);
  json["best"] = FormJson(found.best);
  json["items"] = found.items;
  json["line_errors"] = {{"p_from_q", LinesJson(found.acoustics)},
                         {"q_from_p", LinesJson(found.flame)}};
  return json;
}

}  // namespace howl

#include "io/results/health_json.h"

#include "io/results/solution_json.h"

namespace howl {

nlohmann::ordered_json HealthJson(const Health& health) {
  using Json = nlohmann::ordered_json;
  Json json = Json::array();
  for (const Finding& finding : health) {
    json.push_back(
        {{"kind", FindingKindName(finding.kind)},
         {"experiment", finding.experiment.empty() ? Json(nullptr) : Json(finding.experiment)},
         {"subject", finding.subject},
         {"value", NumberOrNull(finding.value)},
         {"limit", NumberOrNull(finding.limit)},
         {"text", finding.text}});
  }
  return json;
}

}  // namespace howl

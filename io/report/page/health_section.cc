#include "io/report/page/health_section.h"

#include <set>

#include "io/report/html_text.h"

namespace howl {

std::string HealthHtml(const ReportInput& input) {
  std::set<std::string> seen;
  std::string list;
  for (const nlohmann::json* file : {&input.solution, &input.analysis}) {
    for (const nlohmann::json& finding : ListAt(*file, "health")) {
      const std::string text = finding.is_object() ? finding.value("text", "") : "";
      if (text.empty() || !seen.insert(text).second) continue;
      list += "<li>" + EscapeHtml(text) + "</li>";
    }
  }
  if (list.empty()) return {};
  return "<section id=\"health\"><h2>Before you read on</h2><ul>" + list + "</ul></section>\n";
}

}  // namespace howl

#include "io/report/summary/summary.h"

#include "io/report/html_text.h"

namespace howl {
namespace {

std::string Part(const char* title, const std::vector<std::string>& sentences) {
  if (sentences.empty()) return {};
  std::string out = std::string("<div><h3>") + title + "</h3>";
  for (const std::string& sentence : sentences) out += "<p>" + EscapeHtml(sentence) + "</p>";
  return out + "</div>\n";
}

}  // namespace

std::string SummaryHtml(const ReportInput& input) {
  const std::string inside = Part("What was found", WhatWasFound(input)) +
                             Part("How sure it is", HowSureItIs(input)) +
                             Part("What to do next", WhatToDoNext(input));
  if (inside.empty()) return {};
  return "<section id=\"summary\"><h2>In short</h2><div class=\"parts\">\n" + inside +
         "</div></section>\n";
}

}  // namespace howl

#include "io/report/page/page.h"

#include <exception>
#include <functional>

#include "io/report/fault_words.h"
#include "io/report/html_text.h"
#include "io/report/page/browser_data.h"
#include "io/report/page/campaign_section.h"
#include "io/report/page/health_section.h"
#include "io/report/page/page_tables.h"
#include "io/report/page/prediction_section.h"
#include "io/report/render.h"
#include "io/report/summary/summary.h"
#include "model/version.h"
#include "report_assets.inc"

namespace howl {
namespace {

struct Section {
  PageSection section;
  const char* id;
  const char* title;
};

// A figure names its section in its line of figures/catalogue.h.
constexpr Section kSections[] = {
    {PageSection::kData, "data", "What the data show"},
    {PageSection::kModels, "models", "Loops that fit"},
    {PageSection::kFamily, "family", "What the data leave open"},
    {PageSection::kPrediction, "prediction", "What to expect where nobody measured"},
    {PageSection::kDiagnosis, "diagnosis", "Where and why the model falls short"},
    {PageSection::kTrial, "trial", "How far to trust the diagnosis"},
    {PageSection::kCampaign, "campaign", "All rigs"}};

constexpr int kWide = 800;  // figures beyond this width have a row of their own

// Figures stand two in a row; one that would stand alone takes the whole row.
std::string FigureClass(const Figure& figure, bool alone) {
  if (figure.width > kWide) return " class=\"wide\"";
  return alone ? " class=\"alone\"" : "";
}

std::string FigureHtml(const Figure& figure, const std::map<std::string, std::string>& svgs,
                       bool alone) {
  const auto svg = svgs.find(figure.name);
  const std::string title = EscapeHtml(figure.title);
  std::string out = "<figure id=\"figure-" + figure.name + "\"" + FigureClass(figure, alone) + ">";
  if (svg != svgs.end()) {
    out += "<div class=\"drawing\" style=\"max-width:" + std::to_string(figure.width) + "px\">" +
           InlineSvg(svg->second, figure.name, title) + "</div>";
  } else {
    out += "<p class=\"absent\">not drawn</p>";
  }
  out += "<figcaption><strong>" + title + ".</strong> " + EscapeHtml(figure.caption);
  if (!figure.paper_figure.empty()) {
    out += " <span class=\"paper\">The paper's figure " + figure.paper_figure + ".</span>";
  }
  return out + " <span class=\"files\">figures/" + figure.name + ".svg, .pdf, .csv, .gp</span>" +
         "</figcaption></figure>\n";
}

std::string FiguresHtml(const std::vector<Figure>& figures, const Section& section,
                        const std::map<std::string, std::string>& svgs) {
  std::vector<const Figure*> shown;
  for (const Figure& figure : figures) {
    if (figure.section == section.section) shown.push_back(&figure);
  }
  std::string out;
  bool second = false;  // in its row
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const bool wide = shown[i]->width > kWide;
    const bool last = i + 1 == shown.size() || shown[i + 1]->width > kWide;
    out += FigureHtml(*shown[i], svgs, !wide && !second && last);
    second = !wide && !second && !last;
  }
  return out;
}

std::string SectionText(const std::string& id, const ReportInput& input) {
  if (id == "data") return MeasuredTable(input);
  if (id == "models") return FitTable(input);
  if (id == "family") return FamilySummary(input);
  if (id == "prediction") return PredictionSummary(input);
  if (id == "diagnosis") return DiagnosisSummary(input);
  if (id == "trial") return TrialSummary(input);
  if (id == "campaign") return CampaignSummary(input);
  return {};
}

std::string RunText(const ReportInput& input) {
  std::string out = "howl " + std::string(Version());
  if (!input.run) return out;
  out += " · config " + EscapeHtml(input.run->config.filename().string());
  std::string commands;
  for (const auto& [name, entry] : input.run->commands) {
    commands += (commands.empty() ? "" : ", ") + EscapeHtml(name) + " (seed " +
                std::to_string(entry.seed) + ")";
  }
  if (!commands.empty()) out += " · ran: " + commands;
  return out;
}

std::string MissingHtml(const std::vector<std::string>& missing) {
  if (missing.empty()) return {};
  std::string out = "<section id=\"missing\"><h2>What is missing</h2><ul>";
  for (const std::string& each : missing) out += "<li>" + EscapeHtml(each) + "</li>";
  return out + "</ul></section>\n";
}

std::string JsonForScript(const nlohmann::ordered_json& json) {
  std::string out;
  for (const char c : json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)) {
    if (c == '<') {
      out += "\\u003c";
    } else {
      out += c;
    }
  }
  return out;
}

std::string BrowserHtml(const ReportInput& input) {
  const auto data = BrowserData(input);
  if (data.is_null()) return {};
  return "<section id=\"browser\"><h2>Browse the family</h2>" + std::string(kBrowserMarkup) +
         "</section>\n<script type=\"application/json\" id=\"family-data\">" + JsonForScript(data) +
         "</script>\n<script>" + kPlotLibrary + "</script>\n<script>" + kBrowserScript +
         "</script>\n";
}

}  // namespace

std::string ReportPage(const ReportInput& input, const std::vector<Figure>& figures,
                       const std::map<std::string, std::string>& svgs) {
  const std::string title = EscapeHtml(input.title);
  std::string body;
  std::string contents;
  const bool has_browser = input.members.has_value();
  // A bad field of one file costs the part that shows it, not the page.
  std::vector<std::string> missing = input.missing;
  const auto part = [&](const std::string& name, const std::function<std::string()>& make) {
    try {
      return make();
    } catch (const std::exception& error) {
      missing.push_back(name + " is left out: " + FaultWords(error));
      return std::string();
    }
  };
  const std::string summary = part("the summary", [&] { return SummaryHtml(input); });
  const std::string health = part("the health", [&] { return HealthHtml(input); });
  for (const Section& section : kSections) {
    std::string inside = part(std::string("the table under \"") + section.title + "\"",
                              [&] { return SectionText(section.id, input); });
    inside += FiguresHtml(figures, section, svgs);
    if (!inside.empty()) {
      body += "<section id=\"" + std::string(section.id) + "\"><h2>" + section.title + "</h2>" +
              inside + "</section>\n";
      contents += "<a href=\"#" + std::string(section.id) + "\">" + section.title + "</a>\n";
    }
    if (section.id == std::string("family") && has_browser) {
      body += part("the browser", [&] { return BrowserHtml(input); });
      contents += "<a href=\"#browser\">Browse the family</a>\n";
    }
  }
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
         "<meta name=\"color-scheme\" content=\"light dark\">\n"
         "<link rel=\"icon\" href=\"data:,\">\n<title>" +
         title + "</title>\n<style>" + (has_browser ? std::string(kPlotStyle) : std::string()) +
         kPageStyle + "</style>\n</head>\n<body>\n<header><h1>" + title + "</h1><p class=\"run\">" +
         RunText(input) + "</p><nav>" + contents + "</nav></header>\n<main>\n" + summary + health +
         MissingHtml(missing) + body + "</main>\n" + kZoomMarkup + "<script>" + kZoomScript +
         "</script>\n" +
         (has_browser ? std::string("<footer>Plots of the browser: uPlot, MIT License.</footer>\n")
                      : std::string()) +
         "</body>\n</html>\n";
}

}  // namespace howl

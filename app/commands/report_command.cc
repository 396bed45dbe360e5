#include <cstdio>
#include <filesystem>
#include <system_error>

#include "app/command_line/command.h"
#include "app/files/output_lock.h"
#include "app/process/interruption.h"
#include "app/text/text_table.h"
#include "io/report/figures/catalogue.h"
#include "io/report/page/page.h"
#include "io/report/render.h"
#include "io/report/report_input.h"
#include "io/whole_file.h"

namespace howl {
namespace {

// The argument is an output folder, or a config whose output folder is meant.
std::filesystem::path Folder(const Options& options) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(options.config, ignored) ? options.out : options.config;
}

void StopIfAsked() {
  if (IsInterrupted()) throw Interrupted("interrupted: no report written");
}

int RunReportCommand(const Options& options) {
  const std::filesystem::path folder = Folder(options);
  RenderOptions render{.threads = options.threads, .stopped = IsInterrupted};
  render.longest_s = options.Number("--figure-seconds").value_or(render.longest_s);
  if (!(render.longest_s > 0.0)) {
    throw UsageError("--figure-seconds: expected a positive number of seconds");
  }
  WatchForInterruption();
  ReportInput input = ReadReportInput(folder, options.threads);
  const std::vector<Figure> figures = AllFigures(input, options.threads, input.missing);
  StopIfAsked();
  // Not the folder's own lock: a page may be made of what is there while a long run adds to it.
  const OutputLock lock(folder / "figures", ".howl.lock", OutputLock::Kind::kAlone, "howl report");
  RemoveUnpublished(folder, "report.html");
  RemoveUnpublished(folder / "figures");
  const auto svgs = RenderFigures(figures, folder / "figures", render, input.missing);
  StopIfAsked();
  WriteWholeFile(folder / "report.html", ReportPage(input, figures, svgs));
  if (!options.quiet) {
    for (const std::string& each : input.missing)
      std::printf("%s\n", Wrapped("missing: " + each, 2).c_str());
    std::printf("written: report.html and %zu figures in %s\n", figures.size(), folder.c_str());
  }
  return kDone;
}

}  // namespace

Command ReportCommand() {
  return {"report",
          "turn what the other commands wrote to a folder into one page of figures",
          "howl report DIR reads what analyse, fit, family, simulate, diagnose and trial wrote\n"
          "to DIR (or to the output folder of a config) and writes DIR/report.html, one page that\n"
          "needs no network: tables, figures, and a browser of the family. DIR/figures/ has each\n"
          "figure as SVG and PDF, its data as CSV and its gnuplot script, to restyle. What is\n"
          "missing is named on the page, and the rest shown.",
          {{"--figure-seconds", "SECONDS",
            "how long gnuplot may take for a figure before it is ended (default: 60)"}},
          RunReportCommand,
          false};
}

}  // namespace howl

// A figure of the report: its data, and the gnuplot commands that draw it. Each lives in a file of
// its own in figures/, and figures/catalogue.h lists them in the report's order.
//
// In figures/ of the output folder a figure NAME is four files: NAME.csv, NAME.gp, NAME.svg and
// NAME.pdf. Its CSV is long: one row a point, the first column names the curve that it belongs to,
// and `pick(curve, column)` in the script takes that curve's points.
#ifndef HOWL_IO_REPORT_FIGURE_H_
#define HOWL_IO_REPORT_FIGURE_H_

#include <string>
#include <vector>

namespace howl {

// The sections of the page, in its order (page/page.cc has their titles).
enum class PageSection { kData, kModels, kFamily, kPrediction, kDiagnosis, kTrial, kCampaign };

struct Figure {
  // These three come from the figure's line in figures/catalogue.h: the name of its files, its
  // section of the page, and which figure of the paper it answers to ("7"; empty: none).
  std::string name;
  PageSection section = PageSection::kData;
  std::string paper_figure;
  std::string title;
  std::string caption;  // what the figure shows, of which data
  std::string csv;
  std::string script;  // gnuplot commands; io/report/script.h puts the common ones before them
  int width = 560;     // in points of the page
  int height = 360;
};

}  // namespace howl

#endif  // HOWL_IO_REPORT_FIGURE_H_

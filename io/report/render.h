// Writes figures to files: NAME.csv and NAME.gp, and by gnuplot NAME.svg and NAME.pdf.
#ifndef HOWL_IO_REPORT_RENDER_H_
#define HOWL_IO_REPORT_RENDER_H_

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "io/report/figure.h"

namespace howl {

struct RenderOptions {
  int threads = 1;
  double longest_s = 60.0;  // for gnuplot to draw a figure: beyond it hangs, and is ended
  std::function<bool()> stopped = [] { return false; };  // the user wants no more
};

// Writes all figures to `folder` and returns each one's SVG by name. Without gnuplot, or where it
// fails or hangs, data and script are written all the same, and `missing` says so. If stopped, it
// writes nothing. Temporary files are removed in the end.
std::map<std::string, std::string> RenderFigures(const std::vector<Figure>& figures,
                                                 const std::filesystem::path& folder,
                                                 const RenderOptions& options,
                                                 std::vector<std::string>& missing);

// An SVG of gnuplot's made fit to stand inside a page: no XML head and ids of its own. The
// page's style gives ink and grid the page's colours.
std::string InlineSvg(const std::string& svg, const std::string& name, const std::string& title);

}  // namespace howl

#endif  // HOWL_IO_REPORT_RENDER_H_

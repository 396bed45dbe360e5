// The gnuplot commands that all figures share, and the functions that write a script.
#ifndef HOWL_IO_REPORT_SCRIPT_H_
#define HOWL_IO_REPORT_SCRIPT_H_

#include <cstddef>
#include <string>
#include <string_view>

#include "io/report/figure.h"

namespace howl {

// Okabe and Ito's colours, which colour-blind readers can tell apart. Black and white stand for ink
// and paper: the page turns them around when it is dark.
namespace colour {
inline constexpr const char* kInk = "#000000";
inline constexpr const char* kGrey = "#8c8c8c";
inline constexpr const char* kBlue = "#0072B2";
inline constexpr const char* kVermillion = "#D55E00";
inline constexpr const char* kGreen = "#009E73";
inline constexpr const char* kPurple = "#CC79A7";
inline constexpr const char* kOrange = "#E69F00";
inline constexpr const char* kSky = "#56B4E9";
}  // namespace colour

// Colour and point type of experiment `index` of `count`: Okabe and Ito's up to seven, then steps
// of a scale that is monotonic in lightness.
std::string SeriesColour(std::size_t index, std::size_t count);
int SeriesPoint(std::size_t index);

// 'text' as gnuplot reads it literally.
std::string Quoted(std::string_view text);
// The same for a tic, whose label gnuplot takes as a format.
std::string TicLabel(std::string_view text);
// "1.2345": as many digits as a plot needs.
std::string Number(double value);

// The same for a reader: a true minus sign, powers of ten as such.
std::string Spelled(double value, int digits = 4);

// A script being written, line by line.
class Script {
 public:
  Script& Line(const std::string& text) {
    text_ += text + "\n";
    return *this;
  }
  // plot's elements, joined by commas.
  Script& Plot(const std::string& element) {
    text_ += (plotting_ ? ", \\\n     " : "plot ") + element;
    plotting_ = true;
    return *this;
  }
  Script& EndPlot() {
    if (plotting_) text_ += "\n";
    plotting_ = false;
    return *this;
  }
  const std::string& Text() const { return text_; }

 private:
  std::string text_;
  bool plotting_ = false;
};

// The whole file: terminal, data, style, then the figure's own commands.
std::string WholeScript(const Figure& figure);

}  // namespace howl

#endif  // HOWL_IO_REPORT_SCRIPT_H_

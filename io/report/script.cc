#include "io/report/script.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace howl {
namespace {

constexpr std::array kFew = {colour::kBlue,   colour::kVermillion, colour::kGreen, colour::kPurple,
                             colour::kOrange, colour::kSky,        colour::kInk};
// Much as viridis, without the ends that vanish on a dark or a light page.
constexpr std::array<std::array<int, 3>, 5> kScale = {
    {{75, 90, 160}, {44, 113, 142}, {33, 145, 140}, {70, 180, 110}, {160, 200, 50}}};
constexpr std::array kPoints = {7, 5, 9, 13, 11, 6, 4, 8, 12, 10};
constexpr double kPixelsPerInch = 100.0;

}  // namespace

std::string SeriesColour(std::size_t index, std::size_t count) {
  if (count <= kFew.size()) return kFew[index % kFew.size()];
  const double place = static_cast<double>(index) / static_cast<double>(count - 1) *
                       static_cast<double>(kScale.size() - 1);
  const std::size_t low = std::min(static_cast<std::size_t>(place), kScale.size() - 2);
  const double share = place - static_cast<double>(low);
  std::array<int, 3> rgb{};
  for (std::size_t k = 0; k < 3; ++k) {
    rgb[k] = static_cast<int>(
        std::lround(kScale[low][k] + share * (kScale[low + 1][k] - kScale[low][k])));
  }
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", rgb[0], rgb[1], rgb[2]);
  return text;
}

int SeriesPoint(std::size_t index) { return kPoints[index % kPoints.size()]; }

std::string Quoted(std::string_view text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'') out += '\'';
    if (static_cast<unsigned char>(c) >= ' ') out += c;
  }
  return out + "'";
}

std::string TicLabel(std::string_view text) {
  std::string format;
  for (const char c : text) format += c == '%' ? std::string("%%") : std::string(1, c);
  return Quoted(format);
}

std::string Number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string Spelled(double value, int digits) {
  if (!std::isfinite(value)) return "–";
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  const std::string plain = text;
  const std::size_t power = plain.find('e');
  std::string out = plain.substr(0, power);
  if (out.front() == '-') out = "−" + out.substr(1);
  if (power == std::string::npos) return out;
  static constexpr const char* kRaised[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  const int exponent = std::atoi(plain.c_str() + power + 1);
  out += " · 10";
  if (exponent < 0) out += "⁻";
  for (const char digit : std::to_string(std::abs(exponent))) out += kRaised[digit - '0'];
  return out;
}

std::string WholeScript(const Figure& figure) {
  const std::string size = std::to_string(figure.width) + "," + std::to_string(figure.height);
  const std::string inches =
      Number(figure.width / kPixelsPerInch) + "in," + Number(figure.height / kPixelsPerInch) + "in";
  std::string title = figure.title;
  for (char& c : title) {
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  }
  return "# " + title + "\n" + "# gnuplot " + figure.name + ".gp draws " + figure.name + ".svg;\n" +
         "# gnuplot -e \"format='pdf'\" " + figure.name + ".gp draws " + figure.name + ".pdf\n" +
         "if (!exists(\"format\")) format = \"svg\"\n"
         "if (format eq \"pdf\") {\n"
         "  set terminal pdfcairo enhanced color size " +
         inches +
         " font 'sans,9'\n"
         "} else {\n"
         "  set terminal svg enhanced size " +
         size + " dynamic background rgb '#ffffff' font 'sans-serif,12' name '" + figure.name +
         "'\n"
         "}\n"
         "set encoding utf8\n"
         "set output '" +
         figure.name +
         ".'.format\n"
         "data = '" +
         figure.name +
         ".csv'\n"
         "set datafile separator comma\n"
         "set datafile columnheaders\n"
         "set datafile missing NaN\n"
         "pick(curve, c) = strcol(1) eq curve ? column(c) : NaN\n"
         "set border 3 linewidth 0.8\n"
         "set tics nomirror out scale 0.6\n"
         "set grid linetype 1 linewidth 0.4 linecolor rgb '#c8c8c8'\n"
         "set key top right reverse Left samplen 1.5 spacing 1.1 noenhanced\n"
         "set style fill transparent solid 0.25 noborder\n\n" +
         figure.script;
}

}  // namespace howl

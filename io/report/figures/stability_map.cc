// The stability chart of `howl predict --map X:Y`: the growth rate at rest in colour, the boundary
// of stability, and the band in which it lies for 95 % of the members.
#include <algorithm>
#include <cmath>
#include <vector>

#include "io/report/figures/catalogue.h"
#include "io/report/script.h"
#include "io/report/zero_contour.h"
#include "io/results/csv_writer.h"

namespace howl {
namespace {

// Told from all colours of the chart, and from paper by day and by night.
constexpr const char* kBoundary = "#00805c";
constexpr const char* kMembers = "#b0005b";

constexpr std::size_t kMostColoured = 80;  // of an axis: each cell is a shape in the page

struct Axis {
  std::string name;  // in the files
  std::string label;
  double scale = 1.0;
  std::vector<double> values;  // times the scale
};

Axis AxisOf(const ReportInput& input, const std::string& name) {
  if (name == "phi") return {name, input.OperatingLabel()};
  if (name == "tau_s") return {name, "delay τ (ms)", 1e3};
  if (name == "omega_hz") return {name, "natural frequency ω (Hz)"};
  if (name == "xi") return {name, "damping ratio ξ"};
  if (name == "flame_slope") return {name, "flame slope Φ′(0)"};
  return {name, name + " (units of p per unit of q, rad/s)"};
}

void ReadValues(const CsvTable& table, Axis& axis) {
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    axis.values.push_back(axis.scale * table.Number(row, axis.name));
  }
  std::ranges::sort(axis.values);
  axis.values.erase(std::unique(axis.values.begin(), axis.values.end()), axis.values.end());
}

// The edges of a cell: half way to its neighbours.
std::pair<double, double> Edges(const std::vector<double>& values, std::size_t from,
                                std::size_t to) {
  const auto half_step = [&](std::size_t k) { return 0.5 * (values[k + 1] - values[k]); };
  const double below = from == 0 ? half_step(0) : half_step(from - 1);
  const double above = to + 1 == values.size() ? half_step(to - 1) : half_step(to);
  return {values[from] - below, values[to] + above};
}

std::string PercentOf(double count, double all) { return Spelled(100.0 * count / all, 2); }

}  // namespace

std::optional<Figure> StabilityMapFigure(const ReportInput& input) {
  const nlohmann::json& map = JsonAt(input.prediction, "map");
  if (!input.prediction_map || !map.is_object()) return std::nullopt;
  const CsvTable& table = *input.prediction_map;
  if (table.columns.size() < 3 || !table.Find("growth_rate_1_s")) return std::nullopt;
  Axis x = AxisOf(input, table.columns[0]);
  Axis y = AxisOf(input, table.columns[1]);
  ReadValues(table, x);
  ReadValues(table, y);
  const std::size_t columns = x.values.size();
  const std::size_t rows = y.values.size();
  if (columns < 2 || rows < 2 || columns * rows != table.rows.size()) return std::nullopt;
  const auto values = [&](const char* column) {
    std::vector<double> out;
    for (std::size_t k = 0; k < table.rows.size(); ++k) out.push_back(table.Number(k, column));
    return out;
  };
  const std::vector<double> growth = values("growth_rate_1_s");
  CsvWriter csv("curve,x,y,x_lo_or_dx,x_hi_or_dy,y_lo,y_hi,growth_rate_1_s");
  double largest = 0.0;
  const std::size_t skip_x = (columns + kMostColoured - 1) / kMostColoured;
  const std::size_t skip_y = (rows + kMostColoured - 1) / kMostColoured;
  for (std::size_t j = 0; j < rows; j += skip_y) {
    for (std::size_t i = 0; i < columns; i += skip_x) {
      const double value = growth[j * columns + i];
      if (!std::isfinite(value)) continue;
      largest = std::max(largest, value);
      const auto [x_lo, x_hi] = Edges(x.values, i, std::min(i + skip_x, columns) - 1);
      const auto [y_lo, y_hi] = Edges(y.values, j, std::min(j + skip_y, rows) - 1);
      csv.Cell("growth").Cell(x.values[i]).Cell(y.values[j]).Cell(x_lo).Cell(x_hi);
      csv.Cell(y_lo).Cell(y_hi).Cell(value).EndRow();
    }
  }
  for (const auto& [curve, column] :
       {std::pair("boundary", "growth_rate_1_s"), {"boundary_lo", "lo"}, {"boundary_hi", "hi"}}) {
    for (const auto& [from, to] : ZeroContour(x.values, y.values, values(column))) {
      csv.Cell(curve).Cell(from[0]).Cell(from[1]).Cell(to[0] - from[0]).Cell(to[1] - from[1]);
      csv.Cell("").Cell("").Cell("").EndRow();
    }
  }
  bool any_member = false;
  for (const auto& mark : ListAt(map, "members")) {
    csv.Cell("members").Cell(x.scale * NumberAt(JsonAt(mark, "x"), "value"));
    csv.Cell(y.scale * NumberAt(JsonAt(mark, "y"), "value"))
        .Cell(x.scale * NumberAt(JsonAt(mark, "x"), "lo"));
    csv.Cell(x.scale * NumberAt(JsonAt(mark, "x"), "hi"))
        .Cell(y.scale * NumberAt(JsonAt(mark, "y"), "lo"));
    csv.Cell(y.scale * NumberAt(JsonAt(mark, "y"), "hi")).Cell("").EndRow();
    any_member = true;
  }
  Figure figure;
  figure.title = "Where the loop is stable";
  const auto all = static_cast<double>(table.rows.size());
  const double phi = NumberAt(map, "phi");
  figure.caption =
      "Growth rate of the loop at rest, median of " + Spelled(NumberAt(map, "paths"), 6) +
      " members. Green: the boundary, where |L Φ′(0)| is one at a phase crossing (1b); grey: "
      "between these lines it lies for 95 % of the members. At " +
      PercentOf(NumberAt(map, "unstable"), all) + " % of the points nearly all members grow, at " +
      PercentOf(NumberAt(map, "stable"), all) + " % nearly all decay." +
      (any_member ? " Points: the members' own values." : "") +
      (std::isfinite(phi) ? " At " + input.operating_parameter + " " + Spelled(phi, 6) + "." : "");
  figure.csv = csv.Text();
  figure.height = 420;
  // The same colours for growth and decay of one size; what decays faster is as blue as can be.
  const std::string limit = Number(std::max(largest, 1.0));
  const auto [left, right] = Edges(x.values, 0, columns - 1);
  const auto [bottom, top] = Edges(y.values, 0, rows - 1);
  Script script;
  script.Line("set xlabel " + Quoted(x.label))
      .Line("set ylabel " + Quoted(y.label))
      .Line("set xrange [" + Number(left) + ":" + Number(right) + "]")
      .Line("set yrange [" + Number(bottom) + ":" + Number(top) + "]")
      .Line("set key outside top center horizontal")
      .Line("set style fill solid noborder")
      .Line("set palette defined (-1 '#5b9bd5', 0 '#f2f2f2', 1 '#e8743b')")
      .Line("set cbrange [-" + limit + ":" + limit + "]")
      .Line("set cblabel 'growth rate (1/s)'");
  script.Plot(
      "data using (pick('growth',2)):3:4:5:6:7:8 with boxxyerror linecolor palette notitle");
  const std::string line = std::string(" linecolor rgb '") + kBoundary + "'";
  const std::string mark = std::string(" linecolor rgb '") + kMembers + "'";
  for (const char* const end : {"lo", "hi"}) {
    script.Plot("data using (pick('boundary_" + std::string(end) +
                "',2)):3:4:5 with vectors nohead linewidth 1 linecolor rgb '" + colour::kGrey +
                "'" +
                (end == std::string("lo") ? " title 'boundary, 95 % of the members'" : " notitle"));
  }
  script.Plot("data using (pick('boundary',2)):3:4:5 with vectors nohead linewidth 2" + line +
              " title 'boundary'");
  if (any_member) {
    script.Plot(
        "data using (pick('members',2)):3:4:5:6:7 with xyerrorbars pointtype 7 pointsize 0.4" +
        mark + " title 'members'");
  }
  script.EndPlot();
  figure.script = script.Text();
  return figure;
}

}  // namespace howl

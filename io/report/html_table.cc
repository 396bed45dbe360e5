#include "io/report/html_table.h"

#include <cmath>
#include <string_view>

#include "io/records/columns/number_text.h"
#include "io/report/html_text.h"
#include "io/report/script.h"
#include "io/report/spelled_interval.h"

namespace howl {
namespace {

constexpr std::size_t kNumbersLength = 36;  // a column with longer cells is words, which may break

constexpr int kDigits = 3;  // that a reader takes in at a glance

// 4980 rather than 4.98 · 10³.
std::string Readable(double value, int digits) {
  constexpr int kMostPlainPower = 5;
  if (!std::isfinite(value)) return Spelled(value, digits);
  const int power = value == 0.0 ? 0 : static_cast<int>(std::floor(std::log10(std::abs(value))));
  if (power < digits || power > kMostPlainPower) return Spelled(value, digits);
  const double unit = std::pow(10.0, power - digits + 1);
  return Spelled(unit * std::round(value / unit), kMostPlainPower + 2);
}

// What the cell's text leaves out; empty where that is nothing.
std::string Whole(double value, std::string shown) {
  if (!std::isfinite(value)) return "";
  constexpr std::string_view kMinus = "−";
  if (shown.starts_with(kMinus)) shown.replace(0, kMinus.size(), "-");
  std::string whole = NumberText(value);
  return whole == shown ? "" : whole;
}

}  // namespace

TableCell::TableCell(double value, int digits)
    : text(Readable(value, digits)), whole(Whole(value, text)) {}

TableCell::TableCell(const Estimate& estimate, double scale)
    : text(std::isfinite(estimate.std) ? SpelledInterval(estimate, scale, kDigits)
                                       : Readable(scale * estimate.value, kDigits)),
      whole(Whole(scale * estimate.value, text)) {
  if (!whole.empty() && std::isfinite(estimate.std) && estimate.std > 0.0) {
    whole += ", standard deviation " + NumberText(scale * estimate.std);
  }
}

std::string HtmlTable(const std::string& caption, const std::vector<std::string>& head,
                      const std::vector<TableRow>& rows) {
  std::vector<char> words(head.size(), 0);
  for (const auto& row : rows) {
    for (std::size_t k = 1; k < row.size(); ++k) {
      if (row[k].text.size() > kNumbersLength) words[k] = 1;
    }
  }
  const auto cell = [&](const std::string& tag, std::size_t k, const TableCell& shown) {
    const std::string title =
        shown.whole.empty() ? "" : " title=\"" + EscapeHtml(shown.whole) + "\"";
    return "<" + tag + (words[k] ? " class=\"words\"" : "") + title + ">" + EscapeHtml(shown.text) +
           "</" + tag.substr(0, 2) + ">";
  };
  std::string out = "<div class=\"scroll\"><table><caption>" + caption + "</caption><thead><tr>";
  for (std::size_t k = 0; k < head.size(); ++k) out += cell("th scope=\"col\"", k, head[k]);
  out += "</tr></thead><tbody>";
  for (const auto& row : rows) {
    out += "<tr>";
    for (std::size_t k = 0; k < row.size(); ++k) {
      out += cell(k == 0 ? "th scope=\"row\"" : "td", k, row[k]);
    }
    out += "</tr>";
  }
  return out + "</tbody></table></div>\n";
}

}  // namespace howl

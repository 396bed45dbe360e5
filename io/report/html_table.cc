#include "io/report/html_table.h"

#include "io/report/page.h"

namespace howl {
namespace {

constexpr std::size_t kNumbersLength = 36;  // a column with longer cells is words, which may break

}  // namespace

std::string HtmlTable(const std::string& caption, const std::vector<std::string>& head,
                      const std::vector<std::vector<std::string>>& rows) {
  std::vector<char> words(head.size(), 0);
  for (const auto& row : rows) {
    for (std::size_t k = 1; k < row.size(); ++k) {
      if (row[k].size() > kNumbersLength) words[k] = 1;
    }
  }
  const auto cell = [&](const std::string& tag, std::size_t k, const std::string& text) {
    return "<" + tag + (words[k] ? " class=\"words\">" : ">") + EscapeHtml(text) + "</" +
           tag.substr(0, 2) + ">";
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

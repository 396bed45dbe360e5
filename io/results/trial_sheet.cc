#include "io/results/trial_sheet.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace howl {
namespace {

std::string Format(const char* form, double value) {
  if (std::isnan(value)) return "-";
  char text[64];
  std::snprintf(text, sizeof(text), form, value);
  return text;
}

// "83 % (71 .. 91; 45 of 54)"
std::string Text(const Tally& tally) {
  if (tally.total == 0) return "-";
  char text[96];
  std::snprintf(text, sizeof(text), "%.0f %% (%.0f .. %.0f; %d of %d)", 100.0 * tally.Share(),
                100.0 * tally.Low(), 100.0 * tally.High(), tally.right, tally.total);
  return text;
}

class Table {
 public:
  explicit Table(std::vector<std::string> header) { rows_.push_back(std::move(header)); }
  void Row(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
  // In Markdown, columns lined up for reading as it is.
  std::string Text() const {
    std::vector<std::size_t> width(rows_[0].size(), 3);
    for (const auto& row : rows_) {
      for (std::size_t i = 0; i < row.size(); ++i) width[i] = std::max(width[i], row[i].size());
    }
    std::string text;
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      for (std::size_t i = 0; i < width.size(); ++i) {
        text += "| " + rows_[r][i] + std::string(width[i] - rows_[r][i].size() + 1, ' ');
      }
      text += "|\n";
      if (r > 0) continue;
      for (const std::size_t each : width) text += "|" + std::string(each + 2, '-');
      text += "|\n";
    }
    return text + "\n";
  }

 private:
  std::vector<std::vector<std::string>> rows_;
};

std::string Targets(const ScoreSheet& sheet) {
  const MethodScore& score = sheet.howl;
  Table table({"target", "wanted", "measured", "reached"});
  const auto at_least = [&](const std::string& what, const Tally& tally, double wanted) {
    table.Row({what, Format(">= %.0f %%", 100.0 * wanted), Text(tally),
               tally.total == 0          ? "-"
               : tally.Share() >= wanted ? "yes"
                                         : "no"});
  };
  at_least("effect or class of at most three, medium and large", score.medium_and_large.in_class,
           0.85);
  at_least("block, medium and large", score.medium_and_large.block, 0.9);
  table.Row({"false alarms", "<= 5 %", Text(score.false_alarms),
             score.false_alarms.total == 0        ? "-"
             : score.false_alarms.Share() <= 0.05 ? "yes"
                                                  : "no"});
  at_least("unknown recall", score.unknown_recall, 0.7);
  const double ratio = score.median_shrinkage_over_oracle;
  table.Row({"median shrinkage over the oracle's", ">= 0.9",
             Format("%.3f", ratio) + " (" + std::to_string(score.oracle_cases) + " cases)",
             std::isnan(ratio) ? "-"
             : ratio >= 0.9    ? "yes"
                               : "no"});
  int outside = 0;
  int filled = 0;
  for (const ReliabilityBin& bin : score.reliability) {
    if (bin.right.total == 0) continue;
    ++filled;
    outside += bin.mean_probability < bin.right.Low() || bin.mean_probability > bin.right.High();
  }
  table.Row({"reliability within its error bars", "all bins",
             std::to_string(filled - outside) + " of " + std::to_string(filled) + " bins",
             filled == 0    ? "-"
             : outside == 0 ? "yes"
                            : "no"});
  return table.Text();
}

std::string Methods(const ScoreSheet& sheet) {
  Table table({"", "effect", "class of <= 3", "block", "false alarms", "unknown recall",
               "log score", "Brier", "shrinkage/oracle"});
  std::vector<const MethodScore*> all = {&sheet.howl};
  for (const MethodScore& rival : sheet.rivals) all.push_back(&rival);
  for (const MethodScore* score : all) {
    table.Row({score->method, Text(score->medium_and_large.named),
               Text(score->medium_and_large.in_class), Text(score->medium_and_large.block),
               Text(score->false_alarms), Text(score->unknown_recall),
               Format("%.3f", score->log_score), Format("%.3f", score->brier),
               Format("%.2f", score->median_shrinkage_over_oracle)});
  }
  return table.Text();
}

std::string BySize(const MethodScore& score) {
  Table table({"size", "effect", "class of <= 3", "block"});
  for (const auto& [severity, accuracy] : score.by_severity) {
    table.Row({SeverityName(severity), Text(accuracy.named), Text(accuracy.in_class),
               Text(accuracy.block)});
  }
  table.Row({"all", Text(score.catalogue.named), Text(score.catalogue.in_class),
             Text(score.catalogue.block)});
  return table.Text();
}

std::string Reliability(const MethodScore& score) {
  Table table({"probability given", "mean", "right"});
  for (const ReliabilityBin& bin : score.reliability) {
    if (bin.right.total == 0) continue;
    table.Row({Format("%.1f", bin.low) + " .. " + Format("%.1f", bin.high),
               Format("%.3f", bin.mean_probability), Text(bin.right)});
  }
  return table.Text();
}

std::string ByAnswer(const MethodScore& score) {
  Table table({"answer", "right"});
  for (const auto& [kind, right] : score.by_answer) table.Row({kind, Text(right)});
  return table.Text();
}

std::string Size(double severity, double size) {
  const std::string_view beyond = BeyondTried(severity);
  return beyond.empty() ? Format("%.3g", size) : std::string(beyond);
}

std::string Power(const ScoreSheet& sheet) {
  Table table({"effect", "found", "parameter", "found with 90 %", "90 % interval"});
  for (const EffectPower& power : sheet.power) {
    table.Row({power.effect, std::to_string(power.found) + " of " + std::to_string(power.cases),
               power.size_name, power.resolved ? Size(power.severity, power.size) : "not resolved",
               Size(power.severity_low, power.size_low) + " .. " +
                   Size(power.severity_high, power.size_high)});
  }
  return table.Text();
}

std::string ByEffect(const ScoreSheet& sheet) {
  Table table({"withheld", "named, or called unknown", "class of <= 3", "block"});
  for (const auto& [id, accuracy] : sheet.by_effect) {
    table.Row({id, Text(accuracy.named), Text(accuracy.in_class), Text(accuracy.block)});
  }
  for (const auto& [id, tallies] : sheet.outside) {
    table.Row({id, Text(tallies.first), "-", Text(tallies.second)});
  }
  return table.Text();
}

// The confusion matrix as a list, because with twenty effects a square does not fit a page.
std::string Confusions(const Confusion& confusion) {
  std::string text;
  for (std::size_t i = 0; i < confusion.rows.size(); ++i) {
    text += "- " + confusion.rows[i] + ":";
    const char* separator = " ";
    for (std::size_t j = 0; j < confusion.columns.size(); ++j) {
      if (confusion.count[i][j] == 0) continue;
      text += separator + confusion.columns[j] + " " + std::to_string(confusion.count[i][j]);
      separator = ", ";
    }
    text += "\n";
  }
  return text + "\n";
}

}  // namespace

std::string TrialSheet(const ScoreSheet& sheet, const std::string& command,
                       const std::string& seal) {
  const MethodScore& score = sheet.howl;
  std::string text = "# Blind trial: " + std::to_string(sheet.cases) + " cases\n\n    " + command +
                     "\n\nSeal (SHA-256): " + seal + "\n\n";
  if (sheet.failed > 0) {
    text += std::to_string(sheet.failed) + " diagnoses failed; they count as wrong.\n\n";
  }
  text += "Shares are with Wilson's 95 % interval.\n\n## Targets\n\n" + Targets(sheet);
  text += "## Accuracy by size, one effect of the catalogue\n\n" + BySize(score);
  text += "## Against trivial rivals (accuracies: medium and large)\n\n" + Methods(sheet);
  text += "## No effect, unknown effects, two effects\n\n";
  text += "- gap between the simulators with no effect: median " +
          Format("%.3f", sheet.floor.median_gap) + ", largest " +
          Format("%.3f", sheet.floor.largest_gap) + " (" + std::to_string(sheet.floor.cases) +
          " cases); sampling alone: " + Format("%.3f", sheet.floor.median_floor) + "\n";
  text += "- false alarms: " + Text(score.false_alarms) +
          "; an effect named: " + Text(score.accused) + "\n";
  text += "- unknown recall: " + Text(score.unknown_recall) +
          "; medium and large: " + Text(score.unknown_recall_medium_and_large) +
          "; their block: " + Text(score.outside_block) + "\n";
  text += "- false unknowns (effect in the catalogue): " + Text(score.false_unknowns) + "\n";
  text += "- two effects: both named " + Text(score.pairs_both_named) + ", one " +
          Text(score.pairs_one_named) + ", unknown " + Text(score.pairs_unknown) + "\n\n";
  text += "## Reliability of the most probable answer\n\n" + Reliability(score);
  text += "## By what is answered\n\n" + ByAnswer(score);
  text += "## Smallest size found with 90 % probability\n\n" + Power(sheet);
  text += "## Each effect, all sizes\n\n" + ByEffect(sheet);
  text += "## Confusion: withheld, then answers\n\n" + Confusions(sheet.confusion);
  return text;
}

}  // namespace howl

#include "io/inspect/init_config.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "estimation/analysis/cycle/characteristics.h"
#include "estimation/health/number_words.h"
#include "io/config/sections/config_sections.h"
#include "io/config/yaml/placeholder.h"
#include "io/inspect/role_guess.h"
#include "io/inspect/time_guess.h"
#include "io/inspect/yaml_text.h"
#include "io/records/columns/number_text.h"
#include "io/records/columns/time_unit.h"
#include "io/result_files.h"
#include "io/user_error.h"

namespace howl {
namespace {

std::string Count(std::size_t count, const std::string& thing) {
  return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

// "column 2", or "column pmt" by the header's name.
std::string ColumnText(const ColumnLook& column) { return "column " + column.info.name; }

// The keys that the config needs for one layout of files.
struct Layout {
  std::vector<const RecordLook*> looks;
  RoleGuess roles;
};

// p1.txt.gz: p1.
std::string Stem(const std::filesystem::path& file) {
  std::filesystem::path name = file.filename();
  if (name.extension() == ".gz") name = name.stem();
  const std::string stem = name.stem().string();
  return stem.empty() ? name.string() : stem;
}

// A name that a config takes: no separator, quote or leading point, and no file of results.
std::string Allowed(std::string name) {
  for (char& c : name) {
    const bool is_control = static_cast<unsigned char>(c) < 0x20;
    if (is_control || std::string_view("/\\,\"'$").find(c) != std::string_view::npos) c = '_';
  }
  while (!name.empty() && (name.front() == '.' || name.front() == ' ')) name.erase(0, 1);
  if (name.empty() || IsResultsName(name)) name = "record_" + name;
  return name.substr(0, 90);
}

std::vector<std::string> Names(std::span<const RecordLook> looks) {
  std::map<std::string, int> counts;
  for (const RecordLook& look : looks) ++counts[Allowed(Stem(look.file))];
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (const RecordLook& look : looks) {
    std::string name = Allowed(Stem(look.file));
    const std::string folder = look.file.parent_path().filename().string();
    if (counts[name] > 1 && !folder.empty()) name = Allowed(folder + "_" + name);
    const std::string first = name;
    for (int k = 2; !taken.insert(name).second; ++k) name = first + "_" + std::to_string(k);
    names.push_back(name);
  }
  return names;
}

// The path in the config: relative to the config's folder where it was given relative.
std::string PathText(const std::filesystem::path& file, const std::filesystem::path& folder) {
  std::filesystem::path path = file;
  if (!file.is_absolute() && !folder.empty()) {
    path = std::filesystem::absolute(file).lexically_normal().lexically_relative(
        std::filesystem::absolute(folder).lexically_normal());
  }
  std::string text = path.lexically_normal().string();
  if (text.find("${") != std::string::npos) {
    throw UserError(file.string(), 0, "",
                    "has ${ in its path, which a config takes from the environment, expected "
                    "another path");
  }
  return text;
}

// A comment that says whether the pressure has a cycle that can be identified.
std::string CycleText(const RecordLook& look, const RoleGuess& roles, double rate_hz) {
  const ColumnLook& p = look.columns[*roles.pressure];
  if (rate_hz <= 0.0 || p.not_finite > 0 || !p.IsSignal()) return "";
  const std::string lasts =
      ", " + NumberWord(static_cast<double>(look.Samples()) / rate_hz, 4) + " s";
  Record record{rate_hz, p.values, {}};
  const CrossSpectrum spectrum = WelchSpectrum(record.pressure, {}, rate_hz);
  const Characteristics cycle = EstimateCharacteristics(record, spectrum);
  if (cycle.state == CycleState::kNoLimitCycle) return lasts + ", no limit cycle";
  return lasts + ", " + (cycle.state == CycleState::kIntermittent ? "an intermittent" : "a limit") +
         " cycle at " + NumberWord(cycle.frequency_hz.value, 4) + " Hz";
}

class Writer {
 public:
  Writer(std::span<const RecordLook> looks, const InitOptions& options)
      : looks_(looks), options_(options), names_(Names(looks)) {
    for (const RecordLook& look : looks) layouts_[look.Layout()].looks.push_back(&look);
    for (auto& [key, layout] : layouts_) {
      layout.roles = GuessRoles(layout.looks);
      if (layout.roles.pressure) continue;
      const RecordLook& first = *layout.looks.front();
      throw UserError(
          first.file.string(), 0, "",
          "no column is left for pressure, expected one that moves (" + first.format + ")");
    }
  }

  InitConfig Write() {
    std::string experiments;
    std::string layout;
    for (std::size_t i = 0; i < looks_.size(); ++i) {
      if (looks_[i].Layout() != layout) experiments += Explain(looks_[i]);
      layout = looks_[i].Layout();
      experiments += Experiment(i);
    }
    std::string head = YamlComment("Written by howl init from " + Count(looks_.size(), "file") +
                                   ". Comments say what was guessed, and from what.");
    if (config_.left_open > 0) {
      head += YamlComment("To do: replace FILL_IN (" + Count(config_.left_open, "place") +
                          "). howl check says what is left to do, and what the records allow.");
    }
    head += YamlComment(
        "The operating parameter is what was changed from one experiment to the next: phi, an air "
        "flow (air_slpm), a voltage. Call it here as you like.");
    head += "operating_parameter: " + options_.operating_parameter + "\nexperiments:\n";
    config_.text = head + experiments;
    return std::move(config_);
  }

 private:
  std::string Explain(const RecordLook& look) {
    const Layout& layout = layouts_.at(look.Layout());
    const std::size_t others = layout.looks.size() - 1;
    const std::string whose =
        look.file.filename().string() +
        (others == 0 ? "" : " and " + Count(others, "more file") + " like it");
    std::string text = "  " + YamlComment(whose + ": " + look.format, 0, 98);
    const auto say = [&](const std::string& line) {
      std::string comment = YamlComment(line, 2, 98);
      for (std::size_t at = 0; at != std::string::npos && at < comment.size();) {
        text += "  " + comment.substr(at, comment.find('\n', at) + 1 - at);
        at = comment.find('\n', at) + 1;
      }
      config_.columns.push_back(line);
    };
    config_.columns.push_back(whose + ": " + look.format);
    if (look.dialect.skip_rows > 0) {
      say("skip_rows: from line " + std::to_string(look.dialect.skip_rows + 1) +
          " on the file is a table");
    }
    if (look.dialect.decimal_comma) say("decimal: the numbers have commas");
    ExplainTime(look, say);
    const RoleGuess& roles = layout.roles;
    say("pressure: " + ColumnText(look.columns[*roles.pressure]) + ", " + roles.pressure_reason);
    if (roles.heat_release) {
      say("heat_release: " + ColumnText(look.columns[*roles.heat_release]) + ", " +
          roles.heat_release_reason);
    } else {
      say("heat_release: no column is left for it, so pressure only");
    }
    ExplainOthers(look, roles, say);
    return text;
  }

  template <typename Say>
  void ExplainTime(const RecordLook& look, const Say& say) {
    const TimeGuess& time = look.time;
    if (time.column) {
      say("time: " + ColumnText(look.columns[*time.column]) + ", " + time.column_reason);
      say("unit of time: " + std::string(UnitOfSeconds(time.unit_s)) + ", " + time.unit_reason);
    }
    if (time.sampling_hz) {
      say("sampling rate: " + NumberText(*time.sampling_hz, 6) + " Hz, by " + time.sampling_reason);
    } else if (options_.sampling_hz) {
      say("sampling rate: " + NumberText(*options_.sampling_hz) +
          " Hz, as stated to howl init: no column is time, and the file does not state it");
    } else {
      say("sampling rate: no column is time, and the file does not state it");
    }
  }

  template <typename Say>
  void ExplainOthers(const RecordLook& look, const RoleGuess& roles, const Say& say) {
    for (std::size_t i = 0; i < look.columns.size(); ++i) {
      const ColumnLook& column = look.columns[i];
      if (look.time.column == i || roles.pressure == i || roles.heat_release == i) continue;
      const std::string label = column.info.label.empty() || column.info.label == column.info.name
                                    ? ""
                                    : " (" + column.info.label + ")";
      const std::string why = !column.info.problem.empty() ? "is " + column.info.problem
                              : !column.IsSignal()         ? "does not move"
                                                           : "is not used";
      say(ColumnText(column) + label + " " + why);
    }
  }

  std::string Experiment(std::size_t i) {
    const RecordLook& look = looks_[i];
    const RoleGuess& roles = layouts_.at(look.Layout()).roles;
    std::string remark =
        Count(look.Samples(), "sample") + CycleText(look, roles, RateOf(look).value_or(0.0));
    for (const auto& column : {roles.pressure, roles.heat_release, look.time.column}) {
      if (!column || look.columns[*column].not_finite == 0) continue;
      const ColumnLook& each = look.columns[*column];
      remark += ", " + Count(each.not_finite, "gap") + " (nan) in " + ColumnText(each);
    }
    std::string text = "  - name: " + YamlScalar(names_[i]) + "  # " + remark + "\n    " +
                       options_.operating_parameter + ": ";
    if (options_.values.empty()) {
      text += std::string(kFillIn) + "\n";
      ++config_.left_open;
    } else {
      text += options_.values[i] + "\n";
    }
    return text + "    record: {" + RecordKeys(look, roles) + "}\n";
  }

  std::optional<double> RateOf(const RecordLook& look) const {
    return look.time.sampling_hz ? look.time.sampling_hz : options_.sampling_hz;
  }

  std::string RecordKeys(const RecordLook& look, const RoleGuess& roles) {
    const auto column = [&](std::size_t i) { return YamlScalar(look.columns[i].info.name); };
    std::string keys = "file: " + YamlScalar(PathText(look.file, options_.folder));
    keys += ", pressure: " + column(*roles.pressure);
    if (roles.heat_release) keys += ", heat_release: " + column(*roles.heat_release);
    const TimeGuess& time = look.time;
    if (time.column) {
      keys += ", time: " + column(*time.column);
      if (const std::string unit = UnitText(time); !unit.empty()) keys += ", time_unit: " + unit;
    } else if (const auto rate_hz = RateOf(look)) {
      keys += ", sampling_hz: " + NumberText(*rate_hz);
    } else {
      keys += ", sampling_hz: " + std::string(kFillIn);
      ++config_.left_open;
    }
    if (look.dialect.skip_rows > 0) {
      keys += ", skip_rows: " + std::to_string(look.dialect.skip_rows);
    }
    if (look.dialect.decimal_comma) keys += ", decimal: \",\"";
    return keys;
  }

  std::span<const RecordLook> looks_;
  const InitOptions& options_;
  std::vector<std::string> names_;
  std::map<std::string, Layout> layouts_;
  InitConfig config_;
};

}  // namespace

InitConfig WriteInitConfig(std::span<const RecordLook> looks, const InitOptions& options) {
  return Writer(looks, options).Write();
}

}  // namespace howl

#include <algorithm>
#include <map>

#include "io/config/sections/config_sections.h"
#include "io/result_files.h"

namespace howl {
namespace {

constexpr const char* kNeededNumbers[] = {"frequency_hz", "phase_deg", "gain"};
constexpr const char* kOtherNumbers[] = {"flame_slope", "frequency_std_hz", "phase_std_deg",
                                         "gain_std",    "flame_slope_std",  "lines"};

void CheckRecordAlone(const ConfigCursor& cursor) {
  const auto check = [&](const char* key) {
    if (!cursor.Find(key)) return;
    cursor.FailAt(key,
                  "is given with a record, which gives it too; expected either record or published "
                  "numbers (frequency_hz, phase_deg, gain, ...)");
  };
  for (const char* const key : kNeededNumbers) check(key);
  for (const char* const key : kOtherNumbers) check(key);
}

void CheckNumbersComplete(const ConfigCursor& cursor) {
  bool has_any = false;
  for (const char* const key : kNeededNumbers) has_any = has_any || cursor.Find(key);
  for (const char* const key : kNeededNumbers) {
    if (cursor.Find(key)) continue;
    cursor.FailAt(key, has_any ? "is missing, expected frequency_hz, phase_deg and gain together"
                               : "is missing, expected frequency_hz, phase_deg and gain, or a "
                                 "record");
  }
}

void ReadNumbers(const ConfigCursor& cursor, Experiment& experiment) {
  cursor.Read("frequency_hz", experiment.frequency_hz);
  cursor.Read("phase_deg", experiment.phase_deg);
  cursor.Read("gain", experiment.gain);
  cursor.Read("flame_slope", experiment.flame_slope);
  cursor.Read("frequency_std_hz", experiment.frequency_std_hz);
  cursor.Read("phase_std_deg", experiment.phase_std_deg);
  cursor.Read("gain_std", experiment.gain_std);
  cursor.Read("flame_slope_std", experiment.flame_slope_std);
  if (experiment.flame_slope_std && !experiment.flame_slope) {
    cursor.FailAt("flame_slope_std", "has no flame_slope to belong to, expected flame_slope too");
  }
  const auto lines = cursor.Find("lines");
  if (!lines) return;
  for (const ConfigCursor& item : lines->Items()) {
    ObservedLine line;
    item.Read("frequency_hz", line.frequency_hz);
    item.Read("frequency_std_hz", line.frequency_std_hz);
    experiment.lines.push_back(line);
  }
}

// simulate writes NAME.csv into the folder of the other commands' results.
void CheckName(const ConfigCursor& cursor, const std::string& name) {
  if (IsResultsName(name)) {
    cursor.FailAt("name", "\"" + name + "\" is the name of a file of results, " + name +
                              ".csv, expected another name");
  }
  // In the name of a record's file `${` would be replaced from the environment.
  if (name.find("${") != std::string::npos) {
    cursor.FailAt("name", "\"" + name + "\" has ${, expected a name without it");
  }
}

std::optional<CycleBand> ReadCycleBand(const ConfigCursor& cursor) {
  const auto band = cursor.Find("cycle_hz");
  if (!band) return std::nullopt;
  const std::vector<ConfigCursor> ends = band->Items();
  const CycleBand read{ends[0].Node().number, ends[1].Node().number};
  if (!(read.low_hz < read.high_hz)) {
    ends[1].Fail("is not above the first, expected [low, high] in Hz");
  }
  return read;
}

using LinesOfNames = std::map<std::string, int>;

void ReadExperiment(const ConfigCursor& cursor, const std::optional<CycleBand>& common_hz,
                    LinesOfNames& lines_of_names, Config& config) {
  ExperimentConfig& read = config.experiments.back();
  read.line = cursor.Line();
  cursor.Read("name", read.experiment.name);
  CheckName(cursor, read.experiment.name);
  cursor.Read(config.operating_parameter, read.experiment.phi);
  cursor.Read("reliable", read.experiment.reliable);
  const auto [earlier, is_new] =
      lines_of_names.try_emplace(read.experiment.name, cursor.Find("name")->Line());
  if (!is_new) {
    cursor.FailAt("name", "\"" + read.experiment.name + "\" is taken by the experiment on line " +
                              std::to_string(earlier->second) + ", expected another name");
  }
  if (const auto record = cursor.Find("record")) {
    CheckRecordAlone(cursor);
    read.record = ReadRecordSpec(*record, config.source);
    read.record_line = record->Find("file")->Line();
    const std::optional<CycleBand> own_hz = ReadCycleBand(cursor);
    read.cycle_hz = own_hz ? own_hz : common_hz;
  } else {
    if (cursor.Find("cycle_hz")) {
      cursor.FailAt("cycle_hz",
                    "picks an oscillation of a record, expected a record, or no cycle_hz beside "
                    "published numbers");
    }
    CheckNumbersComplete(cursor);
    ReadNumbers(cursor, read.experiment);
  }
}

// Other sections may name it.
void ReadNameAlone(const ConfigCursor& cursor, Experiment& experiment) {
  const LocatedMember* const name = cursor.Node().Find("name");
  if (name != nullptr) experiment.name = name->value.text;
}

}  // namespace

void ReadExperiments(const ConfigCursor& root, Config& config, ExperimentMistakes* mistakes) {
  LinesOfNames lines_of_names;
  std::optional<CycleBand> common_hz;
  try {
    common_hz = ReadCycleBand(root);
  } catch (const UserError& error) {
    if (mistakes == nullptr) throw;
    mistakes->found.push_back(error);
  }
  for (const ConfigCursor& cursor : root.Find("experiments")->Items()) {
    const std::size_t index = config.experiments.size();
    config.experiments.emplace_back();
    if (mistakes != nullptr && mistakes->told.contains(index)) {
      ReadNameAlone(cursor, config.experiments.back().experiment);
      continue;
    }
    try {
      ReadExperiment(cursor, common_hz, lines_of_names, config);
    } catch (const UserError& error) {
      if (mistakes == nullptr) throw;
      mistakes->found.push_back(error);
      mistakes->told.insert(index);
    }
  }
}

}  // namespace howl

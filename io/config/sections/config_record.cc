#include <cctype>
#include <cstdlib>
#include <string_view>
#include <system_error>

#include "io/config/sections/absent_record.h"
#include "io/config/sections/config_sections.h"
#include "io/config/sections/table_name.h"
#include "io/records/columns/time_unit.h"

namespace howl {
namespace {

bool IsVariableName(const std::string& name) {
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name[0])) != 0) return false;
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_') return false;
  }
  return true;
}

[[noreturn]] void FailAbsent(const ConfigCursor& file, const std::string& what) {
  try {
    file.Fail(what);
  } catch (const UserError& error) {
    throw AbsentRecord(error);
  }
}

// What the environment holds may be no one else's business.
std::string ShownPath(const ConfigCursor& file, const std::filesystem::path& path) {
  const std::string& text = file.Node().text;
  return text.find("${") == std::string::npos ? path.string() : text;
}

std::filesystem::path FilePath(const ConfigCursor& file, const std::filesystem::path& config_file,
                               const char* content) {
  std::filesystem::path path =
      (config_file.parent_path() / ExpandEnvironment(file)).lexically_normal();
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) {
    FailAbsent(file, "there is no file \"" + ShownPath(file, path) +
                         "\", expected a path relative to the config's folder");
  }
  if (std::filesystem::is_directory(status)) {
    file.Fail("\"" + ShownPath(file, path) + "\" is a folder, expected a file of " + content);
  }
  return path;
}

std::optional<ResponseSpec> ReadResponse(const ConfigCursor& record, const char* key,
                                         const std::filesystem::path& config_file) {
  const auto cursor = record.Find(key);
  if (!cursor) return std::nullopt;
  ResponseSpec spec;
  spec.line = cursor->Line();
  const std::string& text = cursor->Node().text;
  if (IsTableName(text)) {
    spec.table = FilePath(*cursor, config_file, "frequency_hz, magnitude, phase_deg");
    return spec;
  }
  FormulaError error;
  spec.formula = InstrumentResponse::Parse(text, error);
  if (!spec.formula) {
    cursor->Fail("at character " + std::to_string(error.position + 1) + ": " + error.message +
                 "; expected a formula in s, or a table's file (.csv, .txt, .dat, .mat, .h5)");
  }
  return spec;
}

void ReadFormat(const ConfigCursor& record, RecordSpec& spec) {
  record.Read("skip_rows", spec.dialect.skip_rows);
  std::string decimal;
  record.Read("decimal", decimal);
  spec.dialect.decimal_comma = decimal == ",";
  const auto unit = record.Find("time_unit");
  if (!unit) return;
  spec.time_unit_s = SecondsOfUnit(unit->Node().text);
  if (!spec.time) {
    record.FailAt("time_unit", "has no time to belong to, expected the column of it too");
  }
}

void ReadInstruments(const ConfigCursor& record, const std::filesystem::path& config_file,
                     RecordSpec& spec) {
  spec.pressure_response = ReadResponse(record, "pressure_response", config_file);
  spec.heat_release_response = ReadResponse(record, "heat_release_response", config_file);
  if (const auto delay = record.Find("delay_s")) {
    record.Read("delay_s", spec.delay_s);
    spec.delay_line = delay->Line();
  }
  if (const auto leak = record.Find("pressure_in_heat_release")) {
    record.Read("pressure_in_heat_release", spec.pressure_in_heat_release);
    spec.pressure_in_heat_release_line = leak->Line();
  }
  for (const char* const key : {"heat_release_response", "delay_s", "pressure_in_heat_release"}) {
    if (record.Find(key) && !spec.heat_release) {
      record.FailAt(key, "has no heat_release to act on, expected the column of it too");
    }
  }
}

}  // namespace

std::string ExpandEnvironment(const ConfigCursor& file) {
  const std::string& text = file.Node().text;
  std::string expanded;
  std::size_t begin = 0;
  for (std::size_t open = text.find("${"); open != std::string::npos;
       open = text.find("${", begin)) {
    const std::size_t close = text.find('}', open);
    if (close == std::string::npos) {
      file.Fail("\"" + text + "\" has ${ without }, expected ${NAME} of an environment variable");
    }
    const std::string name = text.substr(open + 2, close - open - 2);
    if (!IsVariableName(name)) {
      file.Fail("\"${" + name +
                "}\" names no environment variable, expected letters, digits and _");
    }
    // Configs are read before any thread starts.
    const char* const value = std::getenv(name.c_str());  // NOLINT(concurrency-mt-unsafe)
    if (value == nullptr || *value == '\0') {
      const std::string rest = text.substr(close + 1);
      const bool is_folder = open == 0 && rest.starts_with('/');
      FailAbsent(file, "the environment variable " + name + " is not set, expected it to hold " +
                           (is_folder ? "the folder that has \"" + rest.substr(1) + "\""
                                      : "its part of the path \"" + text + "\""));
    }
    expanded += text.substr(begin, open - begin) + value;
    begin = close + 1;
  }
  return expanded + text.substr(begin);
}

RecordSpec ReadRecordSpec(const ConfigCursor& record, const std::filesystem::path& config_file) {
  const ConfigCursor file = *record.Find("file");
  RecordSpec spec;
  spec.file = FilePath(file, config_file, "samples");
  record.Read("pressure", spec.pressure);
  record.Read("heat_release", spec.heat_release);
  record.Read("time", spec.time);
  ReadFormat(record, spec);
  record.Read("sampling_hz", spec.sampling_hz);
  record.Read("pressure_scale", spec.pressure_scale);
  record.Read("heat_release_scale", spec.heat_release_scale);
  record.Read("start_s", spec.start_s);
  record.Read("duration_s", spec.duration_s);
  if (!spec.sampling_hz && !spec.time) {
    record.FailAt("sampling_hz", "is missing, expected samples a second, or a column for time");
  }
  if (spec.heat_release == spec.pressure) {
    record.FailAt("heat_release",
                  "\"" + spec.pressure + "\" is the column of pressure already, expected another");
  }
  for (const char* const key : {"pressure_scale", "heat_release_scale"}) {
    const auto scale = record.Find(key);
    if (scale && scale->Node().number == 0.0) {
      scale->Fail("0 leaves nothing of the signal, expected a number other than 0");
    }
  }
  ReadInstruments(record, config_file, spec);
  return spec;
}

}  // namespace howl

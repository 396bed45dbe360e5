#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "app/command_line/asked_points.h"
#include "app/command_line/command.h"
#include "app/input/asked_models.h"
#include "app/input/export_flame.h"
#include "app/input/problem_input.h"
#include "app/text/text_table.h"
#include "io/config/reading/config_reading.h"
#include "io/results/flame_export.h"
#include "io/whole_file.h"

namespace howl {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostFrequencies = 10000;
constexpr std::size_t kMostRatios = 100;

std::vector<double> Values(const Options& options, const std::string& option,
                           const std::string& otherwise, std::size_t most) {
  std::vector<double> values =
      ParseAskedPoints(option, options.Text(option).value_or(otherwise), most);
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  if (values.front() < 0.0) throw UsageError(option + ": a value below zero, expected none");
  return values;
}

// "FTF_0.25.mat"
std::string FtfName(double velocity_ratio) {
  std::array<char, 48> name{};
  std::snprintf(name.data(), name.size(), "FTF_%.6g.mat", velocity_ratio);
  return name.data();
}

// Tables of velocity ratios that an earlier export had and this one has not.
void RemoveOldTables(const std::filesystem::path& folder) {
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("FTF_") && name.ends_with(".mat")) {
      std::filesystem::remove(entry.path(), ignored);
    }
  }
}

Json Export(const Options& options, const ExportedFlame& flame, const LoopModel& model,
            const std::vector<double>& frequencies_hz, const std::vector<double>& ratios) {
  const std::filesystem::path folder = options.out / "export" / flame.name;
  RemoveOldTables(folder);
  Json files = Json::array();
  const auto keep = [&](const std::string& name) { files.push_back(name); };
  WriteWholeFile(folder / "acoustics.csv", AcousticsTableCsv(model, frequencies_hz));
  keep("acoustics.csv");
  Json json = {{"name", flame.name},
               {"phi", flame.phi},
               {"flame", flame.origin},
               {"shape", flame.Saturates() ? Json(FlameShapeName(flame.flame.shape)) : Json()},
               {"flame_slope", flame.HasSlope() ? Json(flame.SlopeAtRest()) : Json()},
               {"tau_s", model.tau_s}};
  if (flame.HasSlope()) {
    std::vector<double> amplitudes;
    std::vector<double> own_ratios = ratios;
    if (!flame.Saturates()) own_ratios = {0.0};
    for (const double ratio : own_ratios) {
      amplitudes.push_back(ratio * flame.scale.rate_at_full_modulation);
    }
    WriteWholeFile(folder / "flame.csv",
                   FlameTableCsv(flame.flame, model.tau_s, frequencies_hz, amplitudes));
    keep("flame.csv");
    const double rest = FlameGain(flame.flame, flame.scale, 0.0);
    WriteWholeFile(folder / "Flame.txt", OscilosLiteFlame(rest, model.tau_s));
    keep("Flame.txt");
    for (const double ratio : own_ratios) {
      WriteOscilosLongFlame(folder / FtfName(ratio), FlameGain(flame.flame, flame.scale, ratio),
                            model.tau_s, frequencies_hz);
      keep(FtfName(ratio));
    }
    json["gain_at_rest"] = rest;
    json["mean_heat_release"] = flame.scale.mean_heat_release;
    json["rate_at_full_modulation"] = flame.scale.rate_at_full_modulation;
    json["velocity_ratios"] = own_ratios;
  }
  json["files"] = files;
  return json;
}

void PrintExported(const std::vector<ExportedFlame>& flames, const std::vector<LoopModel>& models,
                   bool is_scaled) {
  TextTable table({"experiment", "flame", "slope at rest", "gain n", "tau ms"});
  for (std::size_t i = 0; i < flames.size(); ++i) {
    const ExportedFlame& flame = flames[i];
    table.AddRow({flame.name, flame.origin,
                  flame.HasSlope() ? Significant(flame.SlopeAtRest(), 4) : "-",
                  flame.HasSlope() ? Significant(FlameGain(flame.flame, flame.scale, 0.0), 4) : "-",
                  Fixed(1e3 * models[i].tau_s, 4)});
  }
  std::printf("%s", table.Text().c_str());
  if (!is_scaled) {
    std::printf("%s\n", Wrapped("gains are relative to the gain at rest and velocity ratios to the "
                                "flame's knee: --mean-heat-release and --full-modulation give "
                                "those of the rig",
                                2)
                            .c_str());
  }
}

int RunExportCommand(const Options& options) {
  const std::vector<double> frequencies_hz =
      Values(options, "--frequencies", "0:1000:5", kMostFrequencies);
  const std::vector<double> ratios = Values(options, "--ratios", "0:1:0.1", kMostRatios);
  const std::optional<FlameScale> stated = StatedScale(options);
  const Config config = LoadConfig(options.config);
  const ProblemInput input = LoadInput(config, options);
  RequireExperiments(config, options, input);
  const std::vector<LoopModel> models = AskedModels(config, options, input.experiments);
  const std::vector<ExportedFlame> flames = FlamesToExport(config, input, stated);
  Json experiments = Json::array();
  for (std::size_t i = 0; i < flames.size(); ++i) {
    experiments.push_back(Export(options, flames[i], models[i], frequencies_hz, ratios));
  }
  const std::optional<int> member = AskedMember(options);
  const Json json = {{"schema", "howl.export/1"},
                     {"operating_parameter", config.operating_parameter},
                     {"member", member ? Json(*member) : Json(nullptr)},
                     {"scale", stated ? "stated" : "flame"},
                     {"experiments", experiments}};
  WriteWholeFile(options.out / "export.json", json.dump(2) + "\n");
  if (!options.quiet) {
    PrintExported(flames, models, stated.has_value());
    std::printf("written: export.json, and tables of %zu experiments in %s\n", flames.size(),
                (options.out / "export").c_str());
  }
  const bool any = std::ranges::any_of(flames, &ExportedFlame::HasSlope);
  return any ? kDone : kNegativeAnswer;
}

}  // namespace

Command ExportCommand() {
  return {"export",
          "the identified flame and acoustics as tables, and for OSCILOS",
          "Writes for each experiment, to export/NAME/ in the output folder: the flame of the\n"
          "joint fit, or of member K of the family, as OSCILOS_lite (Flame.txt) and OSCILOS_long\n"
          "(FTF_RATIO.mat, one for each velocity ratio) read it, and as a plain table\n"
          "(flame.csv); and the acoustics as a table (acoustics.csv). Exits with 1 where no\n"
          "experiment has a flame slope.",
          {{"--member", "K", "member K of family.csv, from 1, in place of the joint fit"},
           {"--mean-heat-release", "Q", "mean heat release, in the units of q"},
           {"--full-modulation", "RATE",
            "rate of change of p, in its units a second, that modulates the velocity at the flame "
            "by 100 %"},
           {"--frequencies", "FROM:TO:STEP", "of the tables, in Hz (default: 0:1000:5)"},
           {"--ratios", "FROM:TO:STEP", "velocity ratios u' / mean u (default: 0:1:0.1)"}},
          RunExportCommand};
}

}  // namespace howl

// The budget of loops on the practice rigs (HOWL_PRACTICE), each with one effect withheld:
//
//   loop_practice_study FOLDER [CASE ...]
//
// A row for each: what was withheld, and what is named, with the nats that are lost without it.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/budget_row.h"
#include "bench/loop_base.h"
#include "bench/measured_rig.h"
#include "bench/rig_loop_records.h"
#include "bench/seconds.h"
#include "diagnosis/loop_budget/loop_budget.h"
#include "estimation/kept_memory.h"
#include "io/records/records.h"

namespace howl {
namespace {

constexpr double kSampling_hz = 5000.0;

MeasuredRig ReadCase(const std::filesystem::path& folder) {
  std::ifstream list(folder / "data" / "rig.txt");
  MeasuredRig out;
  std::string line;
  while (std::getline(list, line)) {
    if (line.starts_with("#")) continue;
    int number = 0;
    double phi = 0.0;
    char name[64];
    if (std::sscanf(line.c_str(), "%d %lf %63s", &number, &phi, name) != 3) continue;
    RecordSpec spec;
    spec.file = folder / "data" / name;
    spec.heat_release = "q";
    spec.sampling_hz = kSampling_hz;
    out.push_back({spec.file.stem(), phi, LoadRecord(spec, spec.file, 0)});
  }
  return out;
}

void PrintCase(const std::filesystem::path& folder) {
  std::ifstream file(folder.string() + ".truth.json");
  const nlohmann::json truth = nlohmann::json::parse(file);
  const MeasuredRig rig = ReadCase(folder);
  const double begun = Seconds();
  const LoopDiagnosis found = DiagnoseLoops(LoopRecordsOf(rig), PapersForm(), {.one_delay = true});
  std::printf("%s %-24s %s | %s ", folder.filename().c_str(),
              truth["effect"].get<std::string>().c_str(), truth["effect_parameters"].dump().c_str(),
              found.diagnosis.kind == VerdictKind::kUnknown ? "unknown" : "");
  PrintBudget(*found.diagnosis.budget);
  std::printf(" | lines %.1f %.1f | %.0f s\n", found.acoustics.nats, found.flame.nats,
              Seconds() - begun);
  std::fflush(stdout);
}

}  // namespace
}  // namespace howl

int main(int argc, char** argv) {
  howl::KeepFreedMemory();
  const std::filesystem::path folder = argv[1];
  std::vector<std::string> cases(argv + 2, argv + argc);
  if (cases.empty()) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.is_directory()) cases.push_back(entry.path().filename());
    }
  }
  std::ranges::sort(cases);
  for (const std::string& name : cases) howl::PrintCase(folder / name);
  return 0;
}

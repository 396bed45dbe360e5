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

#include "bench/loop_base.h"
#include "bench/seconds.h"
#include "diagnosis/loop_budget/loop_budget.h"
#include "estimation/kept_memory.h"

namespace howl {
namespace {

std::vector<double> Column(const std::filesystem::path& path, int column) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  std::vector<double> out;
  while (std::getline(file, line)) {
    const std::size_t comma = line.find(',');
    out.push_back(std::stod(column == 0 ? line.substr(0, comma) : line.substr(comma + 1)));
  }
  return out;
}

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
    const std::filesystem::path path = folder / "data" / name;
    out.push_back({path.stem(), phi, {5000.0, Column(path, 0), Column(path, 1)}});
  }
  return out;
}

void PrintCase(const std::filesystem::path& folder) {
  std::ifstream file(folder.string() + ".truth.json");
  const nlohmann::json truth = nlohmann::json::parse(file);
  const MeasuredRig rig = ReadCase(folder);
  const double begun = Seconds();
  const LoopDiagnosis found = DiagnoseLoops(LoopRecordsOf(rig), PaperBase(), {});
  const Budget& budget = *found.diagnosis.budget;
  std::printf("%s %-24s %s | %s gap %.3f to %.3f |", folder.filename().c_str(),
              truth["effect"].get<std::string>().c_str(), truth["effect_parameters"].dump().c_str(),
              found.diagnosis.kind == VerdictKind::kUnknown ? "unknown" : "", budget.gap_before,
              budget.gap_left);
  for (const BudgetEntry& entry : budget.entries) {
    std::printf(" %s (%.0f nats, %zu of %zu", entry.item.c_str(), entry.lost_nats,
                entry.experiments_better, budget.experiments);
    for (const EstimatedParameter& p : entry.parameters) {
      std::printf(", %s %.4g, %.4g .. %.4g", p.name.c_str(), p.value, p.low, p.high);
    }
    std::printf(")");
    for (const std::string& other : entry.equals) std::printf(" = %s", other.c_str());
  }
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

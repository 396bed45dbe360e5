// family.csv: the listed members of a family, one row for each member and experiment:
//
//   member,experiment,phi,omega_hz,xi,N,M,tau_s,loop_gain,gain_error,phase_error_deg,
//   loop_phase_error_deg
//
// and behind them the operating parameter under its own name, where that is not phi.
// Members count from 1. Errors are relative (gain) and in degrees, as in the falsification test.
#ifndef HOWL_IO_RESULTS_FAMILY_FAMILY_CSV_H_
#define HOWL_IO_RESULTS_FAMILY_FAMILY_CSV_H_

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "estimation/analysis/loop/experiment.h"
#include "estimation/parameters.h"

namespace howl {

std::string FamilyCsv(std::span<const Experiment> experiments,
                      std::span<const std::vector<LoopModel>> members,
                      std::string_view operating_parameter = "phi");

// The same as a table with one row a member. Columns: member, omega_spread, xi_max, and
// EXPERIMENT.COLUMN for every column of the file.
struct FamilyTable {
  std::vector<std::string> experiments;
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;

  // Index of a column; throws std::out_of_range with the name.
  std::size_t Column(const std::string& name) const;
};

// Throws UserError naming file and line where the file is missing or is no family.csv.
FamilyTable ReadFamilyCsv(const std::filesystem::path& path);

}  // namespace howl

#endif  // HOWL_IO_RESULTS_FAMILY_FAMILY_CSV_H_

// The listed members of a family as whole models: family.csv, member by member.
#ifndef HOWL_IO_REPORT_FAMILY_MEMBERS_H_
#define HOWL_IO_REPORT_FAMILY_MEMBERS_H_

#include <string>
#include <vector>

#include "estimation/parameters.h"
#include "io/results/family/family_csv.h"

namespace howl {

struct FamilyMembers {
  std::vector<std::string> experiments;
  std::vector<double> phi;
  std::vector<std::vector<LoopModel>> models;  // [member][experiment]
  std::vector<double> omega_spread, xi_max;    // [member]

  // Index of an experiment; models' second index. -1 where the family does not have it.
  int Experiment(const std::string& name) const;
  // At most `count` members, evenly spread along omega_spread.
  std::vector<std::size_t> Thinned(std::size_t count) const;
};

FamilyMembers MakeFamilyMembers(const FamilyTable& table, double harmonic_ratio);

}  // namespace howl

#endif  // HOWL_IO_REPORT_FAMILY_MEMBERS_H_

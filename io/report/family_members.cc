#include "io/report/family_members.h"

#include <algorithm>
#include <numeric>

namespace howl {

int FamilyMembers::Experiment(const std::string& name) const {
  const auto found = std::ranges::find(experiments, name);
  return found == experiments.end() ? -1 : static_cast<int>(found - experiments.begin());
}

std::vector<std::size_t> FamilyMembers::Thinned(std::size_t count) const {
  std::vector<std::size_t> order(models.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t m) { return omega_spread[m]; });
  if (order.size() <= count) return order;
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < count; ++i) {
    out.push_back(order[i * (order.size() - 1) / (count - 1)]);
  }
  return out;
}

FamilyMembers MakeFamilyMembers(const FamilyTable& table, double harmonic_ratio) {
  FamilyMembers members;
  members.experiments = table.experiments;
  for (const std::string& name : table.experiments) {
    members.phi.push_back(table.rows.front()[table.Column(name + ".phi")]);
  }
  for (const std::vector<double>& row : table.rows) {
    std::vector<LoopModel>& models = members.models.emplace_back();
    for (const std::string& name : table.experiments) {
      const auto value = [&](const char* column) { return row[table.Column(name + "." + column)]; };
      models.push_back({.omega_hz = value("omega_hz"),
                        .xi = value("xi"),
                        .N = value("N"),
                        .M = value("M"),
                        .tau_s = value("tau_s"),
                        .harmonic_ratio = harmonic_ratio});
    }
    members.omega_spread.push_back(row[table.Column("omega_spread")]);
    members.xi_max.push_back(row[table.Column("xi_max")]);
  }
  return members;
}

}  // namespace howl

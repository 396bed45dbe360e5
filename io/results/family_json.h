// family.json, schema howl.family/1, and tradeoff.csv: what `howl family` found.
#ifndef HOWL_IO_RESULTS_FAMILY_JSON_H_
#define HOWL_IO_RESULTS_FAMILY_JSON_H_

#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "estimation/family/conflict.h"
#include "estimation/family/enclose.h"
#include "estimation/family/enumerate.h"
#include "estimation/family/tradeoff.h"

namespace howl {

nlohmann::ordered_json FamilyJson(const FamilyProblem& problem, const Enumeration& enumeration,
                                  const Enclosure& enclosure, const Conflict& conflict);

// omega_spread,xi_max: the smallest largest-xi that any member has at that spread. Spreads without
// any member are left out.
std::string TradeoffCsv(std::span<const TradeoffPoint> points);

}  // namespace howl

#endif  // HOWL_IO_RESULTS_FAMILY_JSON_H_

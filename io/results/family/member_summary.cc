#include "io/results/family/member_summary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>

#include "estimation/family/problem/family_parameter.h"
#include "io/results/solution_json.h"

namespace howl {
namespace {

using Json = nlohmann::ordered_json;

// Seven significant digits, as a whole number; the shift moves where they are cut.
std::int64_t Rounded(double value, double shift) {
  if (!std::isfinite(value) || value == 0.0) return 0;
  const double decade = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 6.0);
  return static_cast<std::int64_t>(std::floor(value / decade + shift));
}

std::string Digest(const std::vector<double>& values, double shift) {
  std::uint64_t hash = 0xcbf29ce484222325u;  // FNV-1a
  for (const double value : values) {
    auto bits = static_cast<std::uint64_t>(Rounded(value, shift));
    for (int byte = 0; byte < 8; ++byte, bits >>= 8) {
      hash = (hash ^ (bits & 0xffu)) * 0x100000001b3u;
    }
  }
  std::array<char, 20> text{};
  std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(hash));
  return text.data();
}

Json Quantiles(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  Json quantiles = Json::array();
  for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    const auto at = static_cast<std::size_t>(share * static_cast<double>(values.size() - 1));
    quantiles.push_back(NumberOrNull(values[at]));
  }
  return quantiles;
}

}  // namespace

Json MemberSummaryJson(const FamilyProblem& problem, const std::vector<Member>& members) {
  Json summary = Json::object();
  for (std::size_t i = 0; i < problem.experiments.size() && !members.empty(); ++i) {
    Json& own = summary[problem.experiments[i].name] = Json::object();
    for (const FamilyParameter parameter : kFamilyParameters) {
      if (!HasParameter(problem, i, parameter)) continue;
      std::vector<double> values;
      values.reserve(members.size());
      for (const Member& member : members) {
        values.push_back(ParameterValue(problem.experiments[i], member[i], parameter));
      }
      own[std::string(FamilyParameterName(parameter))] = {
          {"quantiles", Quantiles(values)},
          {"digests", {Digest(values, 0.5), Digest(values, 0.0)}}};
    }
  }
  return summary;
}

}  // namespace howl

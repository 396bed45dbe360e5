#include "estimation/family/members/member_spread.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace howl {
namespace {

// Every parameter of every experiment in units of its range over `members`; constants are left out.
std::vector<std::vector<double>> Scaled(const std::vector<Member>& members, std::size_t& columns) {
  std::vector<std::vector<double>> rows(members.size());
  columns = 0;
  for (std::size_t i = 0; !members.empty() && i < members[0].size(); ++i) {
    for (std::size_t k = 0; k < kModelParameters; ++k) {
      double lo = std::numeric_limits<double>::infinity();
      double hi = -lo;
      for (const Member& member : members) {
        lo = std::min(lo, Parameter(member[i], k));
        hi = std::max(hi, Parameter(member[i], k));
      }
      if (!(hi > lo)) continue;
      ++columns;
      for (std::size_t row = 0; row < members.size(); ++row) {
        rows[row].push_back((Parameter(members[row][i], k) - lo) / (hi - lo));
      }
    }
  }
  return rows;
}

double SquaredDistance(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return sum;
}

}  // namespace

double LargestHole(const std::vector<Member>& drawn, const std::vector<Member>& probes) {
  constexpr std::size_t kMostDrawn = 4000;
  std::vector<Member> all(probes);
  const std::size_t step = std::max<std::size_t>(1, drawn.size() / kMostDrawn);
  for (std::size_t k = 0; k < drawn.size(); k += step) all.push_back(drawn[k]);
  std::size_t columns = 0;
  const std::vector<std::vector<double>> rows = Scaled(all, columns);
  double largest = 0.0;
  for (std::size_t p = 0; p < probes.size(); ++p) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = probes.size(); k < rows.size(); ++k) {
      nearest = std::min(nearest, SquaredDistance(rows[p], rows[k]));
    }
    largest = std::max(largest, nearest);
  }
  return columns == 0 ? 0.0 : std::sqrt(largest / static_cast<double>(columns));
}

std::vector<std::size_t> SpreadMembers(const std::vector<Member>& members, std::size_t count) {
  std::vector<std::size_t> taken;
  if (members.empty() || count == 0) return taken;
  std::size_t columns = 0;
  const std::vector<std::vector<double>> rows = Scaled(members, columns);
  std::vector<double> mean(columns, 0.0);
  for (const std::vector<double>& row : rows) {
    for (std::size_t k = 0; k < columns; ++k) {
      mean[k] += row[k] / static_cast<double>(rows.size());
    }
  }
  std::vector<double> distance(rows.size());
  for (std::size_t row = 0; row < rows.size(); ++row) {
    distance[row] = SquaredDistance(rows[row], mean);
  }
  while (taken.size() < std::min(count, members.size())) {
    const std::size_t farthest = static_cast<std::size_t>(
        std::max_element(distance.begin(), distance.end()) - distance.begin());
    for (std::size_t row = 0; row < rows.size(); ++row) {
      const double to_taken = SquaredDistance(rows[row], rows[farthest]);
      distance[row] = taken.empty() ? to_taken : std::min(distance[row], to_taken);
    }
    distance[farthest] = -1.0;
    taken.push_back(farthest);
  }
  return taken;
}

}  // namespace howl

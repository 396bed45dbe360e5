#include "io/report/zero_contour.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace howl {
namespace {

struct Corner {
  ContourPoint at;
  double value;
};

ContourPoint Between(const Corner& a, const Corner& b) {
  const double share = a.value / (a.value - b.value);
  return {a.at[0] + share * (b.at[0] - a.at[0]), a.at[1] + share * (b.at[1] - a.at[1])};
}

}  // namespace

std::vector<ContourSegment> ZeroContour(const std::vector<double>& x, const std::vector<double>& y,
                                        const std::vector<double>& value) {
  std::vector<ContourSegment> segments;
  for (std::size_t j = 0; j + 1 < y.size(); ++j) {
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
      const auto corner = [&](std::size_t di, std::size_t dj) {
        return Corner{{x[i + di], y[j + dj]}, value[(j + dj) * x.size() + i + di]};
      };
      const std::array corners = {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
      if (!std::ranges::all_of(corners, [](const Corner& c) { return std::isfinite(c.value); })) {
        continue;
      }
      std::vector<ContourPoint> crossings;  // side k is from corner k to the next
      for (std::size_t k = 0; k < 4; ++k) {
        const Corner& a = corners[k];
        const Corner& b = corners[(k + 1) % 4];
        if ((a.value > 0.0) != (b.value > 0.0)) crossings.push_back(Between(a, b));
      }
      if (crossings.size() == 2) {
        segments.push_back({crossings[0], crossings[1]});
      } else if (crossings.size() == 4) {
        double mean = 0.0;
        for (const Corner& c : corners) mean += c.value;
        // The corner that differs from the middle is cut off by the two sides that meet in it.
        const bool first_is_cut = (corners[0].value > 0.0) != (mean > 0.0);
        const std::size_t from = first_is_cut ? 3 : 0;
        segments.push_back({crossings[from], crossings[(from + 1) % 4]});
        segments.push_back({crossings[(from + 2) % 4], crossings[(from + 3) % 4]});
      }
    }
  }
  return segments;
}

}  // namespace howl

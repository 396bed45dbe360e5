#include "diagnosis/samples/sample_limits.h"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>

#include "diagnosis/records/channel_signal.h"
#include "estimation/analysis/spectra/statistics.h"

namespace howl {
namespace {

constexpr double kTop = 0.9995;
// Of half the range. Noise that came behind an edge hides it at the narrower one, and what little a
// cycle was cut off shows there alone. Of 220 rigs of two simulators no signal that is not clipped
// has more than 2.5 times as many samples near its ends as a little further in, at either.
constexpr std::array kEdgeWidths = {0.02, 0.04};
constexpr double kNearTop = 0.15;  // of half the range
constexpr double kDensestShare = 0.3;
constexpr double kEdgeRatio = 5.0;
constexpr double kEdgeShare = 0.03;
constexpr double kSameValue = 1e-6;  // of the range
constexpr double kRepeatedShare = 0.01;
constexpr double kRepeatedRatio = 5.0;  // over any other value: coarse levels repeat them all
constexpr std::size_t kMostLevels = 300;

std::vector<double> Levels(const Eigen::VectorXd& x) {
  std::vector<double> values(x.data(), x.data() + x.size());
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

// True where many samples lie just below the extreme and few a little further down.
bool EdgeAt(const Eigen::VectorXd& x, double width) {
  const double top = SampleQuantile(x, kTop);
  const double near = static_cast<double>((x.array() > top - width).count());
  const double below = static_cast<double>(
      (x.array() > top - 3.0 * width && x.array() <= top - 2.0 * width).count());
  return near > kEdgeRatio * std::max(below, 1.0) &&
         near > kEdgeShare * static_cast<double>(x.size());
}

// A saturated sample repeats the extreme value exactly. Distributions that are smooth there have
// one sample at it; where the levels are coarse, their neighbours have as many.
bool RepeatedExtreme(const Eigen::VectorXd& x, double range) {
  std::vector<double> values(x.data(), x.data() + x.size());
  std::sort(values.begin(), values.end(), std::greater<>());
  const double same = kSameValue * range;
  std::size_t at_top = 0;
  while (at_top < values.size() && values[at_top] > values[0] - same) ++at_top;
  std::size_t most = 1;
  std::size_t run = 1;
  for (std::size_t i = at_top + 1; i < values.size(); ++i) {
    // The other rail is no level of the converter.
    if (values[i] < values[0] - 0.5 * range) break;
    run = values[i] == values[i - 1] ? run + 1 : 1;
    most = std::max(most, run);
  }
  return static_cast<double>(at_top) > kRepeatedShare * static_cast<double>(x.size()) &&
         static_cast<double>(at_top) > kRepeatedRatio * static_cast<double>(most);
}

// The level where the samples near the top are densest: the middle of the shortest interval that
// holds a share of them.
double DensestNear(const Eigen::VectorXd& x, double top, double reach) {
  std::vector<double> near;
  for (const double value : x) {
    if (value > top - reach) near.push_back(value);
  }
  std::sort(near.begin(), near.end());
  const auto count = static_cast<std::size_t>(kDensestShare * static_cast<double>(near.size()));
  double level = top;
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + count < near.size(); ++i) {
    const double length = near[i + count] - near[i];
    if (length >= shortest) continue;
    shortest = length;
    level = 0.5 * (near[i + count] + near[i]);
  }
  return level;
}

// Of samples at the signal's upper end, about the level where they are densest: as far below it as
// noise reaches above it.
double ShareAtTop(const Eigen::VectorXd& x, double range) {
  const double top = SampleQuantile(x, kTop);
  const double level = DensestNear(x, top, kNearTop * 0.5 * range);
  return (x.array() > 2.0 * level - top).cast<double>().mean();
}

double Range(const Eigen::VectorXd& x) {
  return SampleQuantile(x, kTop) - SampleQuantile(x, 1.0 - kTop);
}

bool HasEdges(const Eigen::VectorXd& x, double range) {
  // Between coarse levels any density has edges.
  if (Levels(x).size() <= kMostLevels) return false;
  return std::ranges::any_of(kEdgeWidths, [&](double width) {
    return EdgeAt(x, width * 0.5 * range) && EdgeAt(-x, width * 0.5 * range);
  });
}

bool SharpEdge(const Eigen::VectorXd& x) {
  const double range = Range(x);
  return RepeatedExtreme(x, range) || RepeatedExtreme(-x, range) || HasEdges(x, range);
}

}  // namespace

double SampleQuantile(const Eigen::VectorXd& x, double share) {
  std::vector<double> values(x.data(), x.data() + x.size());
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

double ShareOnNoisyRails(const Eigen::VectorXd& x) {
  const double range = Range(x);
  return HasEdges(x, range) ? ShareAtTop(x, range) + ShareAtTop(-x, range) : 0.0;
}

double ShareOnNoisyRails(const std::vector<double>& samples) {
  const Eigen::VectorXd x =
      Eigen::Map<const Eigen::VectorXd>(samples.data(), static_cast<Eigen::Index>(samples.size()));
  return ShareOnNoisyRails(x);
}

bool HasSharpEdge(const std::vector<CutRecord>& records, Channel channel) {
  const auto edges = std::count_if(records.begin(), records.end(), [&](const CutRecord& record) {
    return SharpEdge(SignalOf(record, channel));
  });
  return 2 * static_cast<std::size_t>(edges) > records.size();
}

FewLevels FindQuantisation(const std::vector<CutRecord>& records) {
  FewLevels out;
  std::size_t found = 0;
  for (const CutRecord& record : records) {
    const std::vector<double> values = Levels(record.pressure);
    if (values.size() > kMostLevels || values.size() < 2) continue;
    ++found;
    std::vector<double> steps;
    for (std::size_t i = 1; i < values.size(); ++i) steps.push_back(values[i] - values[i - 1]);
    out.levels += (values.back() - values.front()) / Median(steps) + 1.0;
  }
  out.found = 2 * found > records.size();
  if (found > 0) out.levels /= static_cast<double>(found);
  return out;
}

}  // namespace howl

#include "estimation/family/answers/profile.h"

#include <algorithm>
#include <cmath>

namespace howl {

namespace {

constexpr double kSteepest = 0.3;  // of the way up to the edge, in one step
constexpr int kMostRefined = 4;

struct Branch {
  std::vector<ProfilePoint> points;  // outwards, from the start
  double end = 0.0;
  ProfileEnd reason = ProfileEnd::kPoints;
};

class Walker {
 public:
  Walker(const ConstrainedMinimum& minimise, const ProfileOptions& options, double best_cost)
      : minimise_(minimise), options_(options), rise_(options.cost_max - best_cost) {}

  Branch Walk(double best_value, const ConstrainedFit& best, double direction) const {
    Branch branch;
    const double bound = direction > 0.0 ? options_.bounds.hi : options_.bounds.lo;
    const double first =
        options_.first_step > 0.0 ? options_.first_step : 0.01 * std::abs(best_value);
    double step = first;
    ProfilePoint last{best_value, best.cost, !best.converged, best.parameters};
    branch.points.push_back(last);
    branch.end = best_value;
    int refined = 0;  // times in a row that a step was found too long
    while (branch.points.size() <= options_.max_points) {
      if (direction * (bound - last.value) <= 0.0) {
        branch.reason = ProfileEnd::kBound;
        return branch;
      }
      double value = last.value + direction * step;
      if (direction * (bound - value) < 0.0) value = bound;
      const ProfilePoint point = At(value, last.parameters);
      if (!std::isfinite(point.cost)) {
        step *= 0.25;
        if (step < 1e-9 * std::max(std::abs(last.value), first)) {
          branch.reason = ProfileEnd::kFailed;
          return branch;
        }
        continue;
      }
      if (point.cost > options_.cost_max) {
        branch.reason = ProfileEnd::kEdge;
        branch.end = FindEdge(best_value, last, point, branch.points);
        return branch;
      }
      // A step goes a tenth of the way up to the edge; one far beyond that would miss a bend.
      const double climbed = std::abs(point.cost - last.cost) / std::max(rise_, 1e-300);
      if (climbed > kSteepest && point.cost > last.cost && refined < kMostRefined) {
        step = 0.3 * std::abs(value - last.value);
        ++refined;
        continue;
      }
      refined = 0;
      step = std::abs(value - last.value) * std::clamp(0.1 / std::max(climbed, 1e-3), 0.3, 2.5);
      branch.points.push_back(point);
      branch.end = value;
      last = point;
    }
    return branch;
  }

  // Minimises again from each outer neighbour; flags and mends what differs.
  void Check(std::vector<ProfilePoint>& outwards) const {
    for (std::size_t k = outwards.size(); k-- > 1;) {
      ProfilePoint& point = outwards[k - 1];
      const ProfilePoint again = At(point.value, outwards[k].parameters);
      const double difference = again.cost - point.cost;
      if (std::abs(difference) > options_.agreement * std::abs(rise_)) point.flagged = true;
      if (difference < 0.0) {
        point.cost = again.cost;
        point.parameters = again.parameters;
      }
    }
  }

 private:
  ProfilePoint At(double value, const std::vector<double>& start) const {
    ConstrainedFit fit = minimise_(value, start);
    return {value, fit.cost, !fit.converged, std::move(fit.parameters)};
  }

  double FindEdge(double best_value, const ProfilePoint& inside, const ProfilePoint& outside,
                  std::vector<ProfilePoint>& points) const {
    ProfilePoint in = inside, out = outside;
    for (int iteration = 0; iteration < 60; ++iteration) {
      const double gap = std::abs(out.value - in.value);
      if (gap <= options_.edge_precision * std::abs(in.value - best_value)) break;
      // The false position, kept off the ends.
      double share = (options_.cost_max - in.cost) / (out.cost - in.cost);
      share = std::isfinite(share) ? std::clamp(share, 0.1, 0.9) : 0.5;
      const ProfilePoint middle = At(in.value + share * (out.value - in.value), in.parameters);
      if (middle.cost <= options_.cost_max) {
        points.push_back(middle);
        in = middle;
      } else {
        out = middle;
      }
    }
    return in.value;
  }

  const ConstrainedMinimum& minimise_;
  const ProfileOptions& options_;
  double rise_;
};

}  // namespace

Profile ComputeProfile(const ConstrainedMinimum& minimise, double best_value,
                       const ConstrainedFit& best, const ProfileOptions& options) {
  const Walker walker(minimise, options, best.cost);
  Branch down = walker.Walk(best_value, best, -1.0);
  Branch up = walker.Walk(best_value, best, 1.0);
  walker.Check(down.points);
  walker.Check(up.points);
  Profile profile;
  for (std::size_t k = down.points.size(); k-- > 0;) profile.points.push_back(down.points[k]);
  for (std::size_t k = 0; k < up.points.size(); ++k) {
    if (k > 0) {
      profile.points.push_back(up.points[k]);
    } else if (!profile.points.empty()) {
      profile.points.back().flagged |= up.points[0].flagged;  // the start, in both
    }
  }
  profile.lo = down.end;
  profile.hi = up.end;
  profile.lo_end = down.reason;
  profile.hi_end = up.reason;
  const double slack = options.agreement * std::abs(options.cost_max - best.cost);
  for (const ProfilePoint& point : profile.points) {
    profile.flagged += point.flagged;
    if (point.cost < best.cost - slack) profile.start_was_best = false;
  }
  return profile;
}

}  // namespace howl

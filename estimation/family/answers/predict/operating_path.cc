#include "estimation/family/answers/predict/operating_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "estimation/analysis/loop/closed_form.h"
#include "estimation/family/answers/predict/predict.h"
#include "estimation/fit/two_mode_solve.h"
#include "estimation/parallel.h"
#include "model/numerics/units.h"

namespace howl {
namespace {

enum Coordinate { kFrequency, kGain, kXi, kTau, kSecond, kSlope, kOmega };

constexpr double kReach = 0.2;  // of the cycle's frequency: where its crossing is looked for
constexpr double kSameOmega = 1e-6;
constexpr std::size_t kFewestPaths = 400;

double ArgOfG(double frequency_hz, double tau_s) {
  const double turn = 2.0 * std::numbers::pi;
  return std::remainder(kRadPerSPerHz * frequency_hz * tau_s - LoopTurns(0.0, 0), turn);
}

// ln |Phi'(0)|, drawn within its error; NaN where it is not known.
double DrawLogSlope(const Experiment& experiment, const MembershipTest& test, double log_gain_rate,
                    UnitRandom& random) {
  if (!experiment.flame_slope || *experiment.flame_slope == 0.0) return std::nan("");
  const double steepness = std::abs(*experiment.flame_slope);
  double value = std::log(steepness);
  if (!experiment.flame_slope_std) return value;
  value += *experiment.flame_slope_std / steepness * random.Normal();
  if (!experiment.reliable || !(test.loop_gain_min > 0.0)) return value;
  return std::max(value, std::log(test.loop_gain_min) - log_gain_rate);
}

}  // namespace

double OperatingLoop::LoopGain() const {
  return gain * kRadPerSPerHz * frequency_hz * std::abs(flame_slope);
}

MemberPath::Course MemberPath::CourseOf(std::span<const double> phi,
                                        std::span<const Coordinates> nodes, UnitRandom random) {
  Course course;
  const std::size_t n = phi.size();
  if (n < 2) return course;
  const double width = phi.back() - phi.front();
  course.mean_step = width / static_cast<double>(n - 1);
  double mean = 0.0, sxx = 0.0;
  for (const double each : phi) mean += each / static_cast<double>(n);
  for (const double each : phi) sxx += (each - mean) * (each - mean);
  // The least-squares slope as a sum over steps: what is shared by all points has no step, and
  // stays exactly as it is.
  double weight = 0.0;
  for (std::size_t k = n - 1; k > 0; --k) {
    weight += (phi[k] - mean) / sxx;
    course.slope += weight * (nodes[k] - nodes[k - 1]);
  }
  if (n < 3) return course;
  const Coordinates drift = (nodes.back() - nodes.front()) / width;
  const auto freedom = static_cast<double>(n - 2);
  for (std::size_t k = 1; k < n; ++k) {
    const double step = phi[k] - phi[k - 1];
    course.deviate +=
        random.Normal() / std::sqrt(freedom * step) * (nodes[k] - nodes[k - 1] - drift * step);
  }
  double chi_square = 0.0;
  for (std::size_t k = 0; k < n - 2; ++k) {
    const double z = random.Normal();
    chi_square += z * z;
  }
  course.deviate /= std::sqrt(chi_square / freedom);
  return course;
}

std::optional<OperatingLoop> MemberPath::LoopOf(const Coordinates& y) const {
  OperatingLoop loop;
  LoopModel& model = loop.model;
  loop.frequency_hz = std::exp(y[kFrequency]);
  if (has_slope_) loop.flame_slope = -std::exp(y[kSlope]);
  const double xi = std::min(std::exp(y[kXi]), xi_max_);
  const double tau_s = std::exp(y[kTau]);
  const double second = std::max(y[kSecond], 0.0);
  if (natural_) {
    const double N = std::exp(y[kGain]);
    model = {std::exp(y[kOmega]), xi, N, second_is_M_ ? second : second * N, tau_s,
             harmonic_ratio_};
    const auto f = CrossingNear(
        model, {loop.frequency_hz * (1.0 - kReach), loop.frequency_hz * (1.0 + kReach)});
    if (!f) return std::nullopt;
    loop.frequency_hz = *f;
    loop.gain = Magnitude(AcousticResponse(model.Loop().acoustics, *f));
    return loop;
  }
  const double phase_rad = ArgOfG(loop.frequency_hz, tau_s);
  if (!(std::abs(phase_rad) < 0.5 * std::numbers::pi)) return std::nullopt;
  loop.gain = std::exp(y[kGain]);
  const Experiment experiment{
      .frequency_hz = loop.frequency_hz, .phase_deg = phase_rad / kRadPerDeg, .gain = loop.gain};
  if (!two_modes_) {
    model = ClosedFormMember(experiment, xi);
  } else if (!SolveTwoMode(experiment, xi, harmonic_ratio_,
                           second_is_M_ ? HeldSecond::kM : HeldSecond::kMOverN, second, {},
                           model)) {
    return std::nullopt;
  }
  model.harmonic_ratio = harmonic_ratio_;
  model.tau_s = tau_s;
  return loop;
}

std::optional<MemberPath> MemberPath::Make(const FamilyProblem& problem,
                                           const OperatingPoints& points,
                                           std::span<const LoopModel> member, UnitRandom random) {
  MemberPath path;
  path.two_modes_ = problem.model.modes == 2;
  path.natural_ = problem.IsShared(ParameterKind::kOmega) || problem.IsShared(ParameterKind::kN);
  path.second_is_M_ = path.two_modes_ && problem.IsShared(ParameterKind::kM);
  path.xi_increasing_ = problem.test.xi_increasing;
  path.xi_max_ = std::min(problem.test.xi_max, problem.RangeOf(ParameterKind::kXi).hi);
  path.harmonic_ratio_ = member.front().harmonic_ratio;
  std::vector<double> own_phi, own_log_slope;  // where a slope is known
  for (std::size_t k = 0; k < points.size(); ++k) {
    Coordinates node = Coordinates::Zero();
    const auto share = 1.0 / static_cast<double>(points.ExperimentsAt(k).size());
    double slopes = 0.0;
    int known = 0;
    for (const std::size_t i : points.ExperimentsAt(k)) {
      const Experiment& experiment = problem.experiments[i];
      const LoopModel& model = member[i];
      const double f = experiment.frequency_hz;
      const auto crossing = CrossingNear(model, {f * (1.0 - kReach), f * (1.0 + kReach)});
      if (!crossing) return std::nullopt;
      const double gain = Magnitude(AcousticResponse(model.Loop().acoustics, *crossing));
      Coordinates y = Coordinates::Zero();
      y[kFrequency] = std::log(*crossing);
      y[kGain] = std::log(path.natural_ ? model.N : gain);
      y[kXi] = std::log(model.xi);
      y[kTau] = std::log(model.tau_s);
      y[kSecond] = path.second_is_M_ ? model.M : model.M / model.N;
      y[kOmega] = std::log(model.omega_hz);
      if (!y.allFinite()) return std::nullopt;
      const double slope = DrawLogSlope(experiment, problem.test,
                                        std::log(gain * kRadPerSPerHz * *crossing), random);
      if (std::isfinite(slope)) slopes += slope, ++known;
      // The closed form's branch may not be the member's: then its own parameters are carried.
      const auto again = path.natural_ ? std::nullopt : path.LoopOf(y);
      if (!path.natural_ &&
          !(again && std::abs(again->model.omega_hz / model.omega_hz - 1.0) < kSameOmega)) {
        FamilyProblem own = problem;
        own.model[ParameterKind::kOmega].scope = ParameterScope::kShared;
        return Make(own, points, member, random);
      }
      node += share * y;
    }
    path.nodes_.push_back(node);
    if (known == 0) continue;
    own_phi.push_back(points.phi(k));
    own_log_slope.push_back(slopes / known);
  }
  path.has_slope_ = !own_phi.empty();
  // A point without a slope takes the line between its neighbours that have one.
  for (std::size_t k = 0; path.has_slope_ && k < points.size(); ++k) {
    const auto above = static_cast<std::size_t>(std::ranges::lower_bound(own_phi, points.phi(k)) -
                                                own_phi.begin());
    const std::size_t b = std::min(above, own_phi.size() - 1);
    const std::size_t a = above == 0 || above == own_phi.size() ? b : above - 1;
    const double step = own_phi[b] - own_phi[a];
    const double at = step > 0.0 ? (points.phi(k) - own_phi[a]) / step : 0.0;
    path.nodes_[k][kSlope] = own_log_slope[a] + at * (own_log_slope[b] - own_log_slope[a]);
  }
  std::vector<double> all_phi, reliable_phi;
  std::vector<Coordinates> reliable;
  for (std::size_t k = 0; k < points.size(); ++k) {
    all_phi.push_back(points.phi(k));
    if (!points.IsReliable(k)) continue;
    reliable_phi.push_back(points.phi(k));
    reliable.push_back(path.nodes_[k]);
  }
  path.all_ = CourseOf(all_phi, path.nodes_, random);
  path.reliable_ = reliable.size() < 3 ? path.all_ : CourseOf(reliable_phi, reliable, random);
  return path;
}

MemberPath::Coordinates MemberPath::CoordinatesAt(const OperatingPoints& points, double phi) const {
  const auto [below, above] = points.Neighbours(phi);
  const Coordinates& a = nodes_[below];
  const Coordinates& b = nodes_[above];
  if (points.Measured(phi)) return a;
  const Course& course = points.RestsOnUnreliable(phi) ? all_ : reliable_;
  Coordinates y;
  double lowest_xi = -HUGE_VAL, highest_xi = HUGE_VAL;
  if (below != above) {
    const double step = points.phi(above) - points.phi(below);
    const double from = phi - points.phi(below);
    y = a + from / step * (b - a) + std::sqrt(from * (step - from) / step) * course.deviate;
    lowest_xi = a[kXi];
    highest_xi = b[kXi];
  } else {
    const double from = phi - points.phi(below);
    const double d = std::abs(from);
    y = a + from * course.slope + std::sqrt(d + d * d / course.mean_step) * course.deviate;
    (from > 0.0 ? lowest_xi : highest_xi) = a[kXi];
  }
  if (xi_increasing_ && lowest_xi <= highest_xi) {
    y[kXi] = std::clamp(y[kXi], lowest_xi, highest_xi);
  }
  return y;
}

std::optional<OperatingLoop> MemberPath::At(const OperatingPoints& points, double phi) const {
  return LoopOf(CoordinatesAt(points, phi));
}

std::optional<double> MemberPath::LogLoopGain(const OperatingPoints& points, double phi) const {
  if (!has_slope_) return std::nullopt;
  const Coordinates y = CoordinatesAt(points, phi);
  if (!natural_) return y[kFrequency] + y[kGain] + y[kSlope] + std::log(kRadPerSPerHz);
  const std::optional<OperatingLoop> loop = LoopOf(y);
  if (!loop) return std::nullopt;
  return std::log(loop->LoopGain());
}

std::vector<MemberPath> MakePaths(const FamilyProblem& problem, const OperatingPoints& points,
                                  std::span<const Member> members, std::uint64_t seed,
                                  int threads) {
  if (members.empty()) return {};
  const std::size_t draws = (kFewestPaths + members.size() - 1) / members.size();
  std::vector<std::optional<MemberPath>> made(members.size() * draws);
  RunUnits(made.size(), threads, [&](std::size_t k) {
    made[k] = MemberPath::Make(problem, points, members[k / draws], UnitRandom(seed, k));
  });
  std::vector<MemberPath> paths;
  for (std::optional<MemberPath>& path : made) {
    if (path) paths.push_back(*std::move(path));
  }
  return paths;
}

}  // namespace howl

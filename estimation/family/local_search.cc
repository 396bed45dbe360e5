#include "estimation/family/local_search.h"

#include <ceres/jet.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "estimation/family/targets.h"
#include "estimation/family/two_mode_solve.h"

namespace howl {

namespace {

// Coordinates of one experiment; kSecond is ln omega where each experiment has a second mode of its
// own, else the shared ln M or ln (M / N).
enum Local { kXi, kPhase, kGain, kLoopPhase, kSecond, kLocals };
using Jet = ceres::Jet<double, kLocals>;

constexpr double kMargin = 1e-9;     // of a condition: what is found passes in spite of rounding
constexpr double kLeastXi = 1e-5;    // below, G's phase loses the digits that the test needs
constexpr double kLargestXi = 20.0;  // stands for "no upper limit"
constexpr double kPull = 1e-3;       // of a coordinate's box: how far a start is drawn inside

template <typename T>
struct Point {
  T ln_omega, ln_xi, ln_N, ln_M, ln_gain, tau_s;
  T above, below;           // y - xi t and xi t - y_r: positive where M and N are
  std::vector<T> line_rad;  // loop phase errors
};

constexpr std::size_t kMostSlopes = 2 * static_cast<std::size_t>(kLocals);

struct Row {  // slack = weight * s + value
  double value = 0.0;
  double weight = 0.0;
  int count = 0;
  std::array<int, kMostSlopes> index{};
  std::array<double, kMostSlopes> slope{};
  // Of a transfer's distance, whose curvature is all that holds a step along the ellipsoid: minus
  // the second derivatives, over the coordinates of experiment `owner`.
  int owner = -1;
  Eigen::Matrix<double, kLocals, kLocals> curvature =
      Eigen::Matrix<double, kLocals, kLocals>::Zero();
};

struct Layout {
  std::vector<std::array<int, kLocals>> index;  // -1: a constant
  int size = 0;
};

struct State {
  std::vector<std::array<double, kLocals>> local;
  double s = 1.0;
  std::vector<double> omega_hz;  // where the last root was
};

template <typename T>
T SinhLog(const T& ratio) {  // sinh(ln ratio)
  return 0.5 * (ratio - 1.0 / ratio);
}

}  // namespace

struct LocalSearch::Impl {
  FamilyProblem problem;
  std::vector<ExperimentTarget> targets;
  bool two_modes, relative, shared_second;
  bool supported = true;
  double ratio;
  struct Scale {
    double phase_0, phase, gain_0, gain, loop_phase;
    std::array<Range, kLocals> box;
    bool soft_phase, soft_gain, soft_loop_phase;
  };
  std::vector<Scale> scales;
  Layout layout;
  double ln_spread;

  explicit Impl(const FamilyProblem& p) : problem(p), targets(MakeTargets(p, 0.0)) {
    two_modes = p.model.modes == 2;
    relative = p.model.second_mode_relative;
    shared_second = two_modes && p.IsShared(SecondKind());
    ratio = p.model.harmonic_ratio;
    ln_spread = std::log1p(p.test.omega_spread_max * (1.0 - kMargin));
    for (const ParameterKind kind :
         {ParameterKind::kOmega, ParameterKind::kXi, ParameterKind::kN, ParameterKind::kTau}) {
      if (p.IsShared(kind) && p.experiments.size() > 1) supported = false;
      const Range range = p.RangeOf(kind);
      if (!(range.lo < range.hi)) supported = false;
    }
    if (!(ln_spread > 0.0)) supported = false;
    if (two_modes) {
      const Range range = p.RangeOf(SecondKind());
      if (!(range.lo < range.hi) && !shared_second) supported = false;
    }
    for (const ExperimentTarget& target : targets) {
      if (target.IsEmpty()) supported = false;
    }
    if (supported) Scales();
  }

  ParameterKind SecondKind() const { return relative ? ParameterKind::kMOverN : ParameterKind::kM; }

  void Scales() {
    const MembershipTest& test = problem.test;
    const Range xi = problem.RangeOf(ParameterKind::kXi);
    Range second{std::log(1e-12), std::log(1e15)};
    if (two_modes) {
      const Range range = problem.RangeOf(SecondKind());
      if (range.lo > 0.0) second.lo = std::log(range.lo);
      if (std::isfinite(range.hi)) second.hi = std::log(range.hi);
    }
    const int shared = shared_second && second.lo < second.hi ? layout.size++ : -1;
    for (std::size_t i = 0; i < targets.size(); ++i) {
      const Experiment& e = problem.experiments[i];
      const ExperimentTarget& target = targets[i];
      Scale scale{};
      scale.phase_0 = WrapDeg(e.phase_deg) * kRadPerDeg;
      scale.soft_phase = test.phase_tolerance_deg < 180.0;
      scale.phase = scale.soft_phase ? test.phase_tolerance_deg * kRadPerDeg * (1 - kMargin) : 1.0;
      scale.gain_0 = e.gain;
      scale.soft_gain = test.gain_tolerance < 5e3;
      scale.gain = e.gain * (scale.soft_gain ? test.gain_tolerance * (1 - kMargin) : 1.0);
      scale.soft_loop_phase = test.loop_phase_tolerance_deg < 180.0;
      scale.loop_phase =
          scale.soft_loop_phase ? test.loop_phase_tolerance_deg * kRadPerDeg * (1 - kMargin) : 1.0;
      constexpr double kQuarter = std::numbers::pi / 2 * (1 - 1e-9);
      // The conditions that may be soft bound the coordinates by rows, not by the box.
      scale.box[kXi] = {std::log(std::max(xi.lo, kLeastXi)), std::log(std::min(xi.hi, kLargestXi))};
      scale.box[kPhase] = {(-kQuarter - scale.phase_0) / scale.phase,
                           (kQuarter - scale.phase_0) / scale.phase};
      scale.box[kGain] = {(1e-4 * e.gain - e.gain) / scale.gain, 1e4 * e.gain / scale.gain};
      if (target.gain.lo > e.gain * (1.0 - test.gain_tolerance)) {  // by the least loop gain
        scale.box[kGain].lo = (target.gain.lo * (1 + kMargin) - e.gain) / scale.gain;
      }
      scale.box[kLoopPhase] = {-std::numbers::pi / scale.loop_phase,
                               std::numbers::pi / scale.loop_phase};
      scale.box[kSecond] =
          shared_second ? second
                        : Range{std::log(0.02 * e.frequency_hz), std::log(50 * e.frequency_hz)};
      std::array<int, kLocals> index{};
      const bool fixed[] = {!(scale.box[kXi].lo < scale.box[kXi].hi), !(scale.phase > 0.0),
                            !(scale.gain > 0.0), !(scale.loop_phase > 0.0)};
      for (int k = kXi; k <= kLoopPhase; ++k) {
        if (fixed[k]) supported = false;
        index[static_cast<std::size_t>(k)] = layout.size++;
      }
      index[kSecond] = shared_second ? shared : (two_modes ? layout.size++ : -1);
      layout.index.push_back(index);
      scales.push_back(scale);
    }
  }

  // Natural parameters of one experiment; false where there is none. `omega_hz` starts the search
  // for the root and is left there.
  template <typename T>
  bool Build(std::size_t i, const std::array<double, kLocals>& u, double& omega_hz,
             Point<T>& point) const {
    using std::asinh;
    using std::atan2;
    using std::cos;
    using std::exp;
    using std::log;
    using std::sqrt;
    using std::tan;
    const Scale& scale = scales[i];
    std::array<T, kLocals> v;
    for (int k = 0; k < kLocals; ++k) {
      if constexpr (std::is_same_v<T, double>) {
        v[static_cast<std::size_t>(k)] = u[static_cast<std::size_t>(k)];
      } else {
        v[static_cast<std::size_t>(k)] = T(u[static_cast<std::size_t>(k)], k);
      }
    }
    const double f = targets[i].frequency_hz;
    const double w = targets[i].w_rad_s;
    const T xi = exp(v[kXi]);
    const T theta = scale.phase_0 + scale.phase * v[kPhase];
    const T gain = scale.gain_0 + scale.gain * v[kGain];
    const T t = tan(-theta);
    const T loop_phase = scale.loop_phase * v[kLoopPhase];
    const T across = xi * t;
    const T root = sqrt(across * across + 1.0);
    const T top = f * (root - across);  // the one-mode solution
    point.ln_xi = v[kXi];
    point.ln_gain = log(gain);
    point.tau_s = (1.5 * std::numbers::pi + theta - loop_phase +
                   2.0 * std::numbers::pi * problem.domain.delay_periods) /
                  w;
    const T stretch = w * gain * cos(theta);
    if (!two_modes) {
      point.ln_omega = log(top);
      point.ln_N = log(2.0 * stretch * xi * (root - across) / (cos(theta) * cos(theta)));
      point.ln_M = T(0.0);
      return true;
    }
    // The equation of two_mode_solve.h for the shared second mode, divided by its scale.
    const auto balance = [&](const auto& omega, const auto& x, const auto& c, const auto& k,
                             const auto& second) {
      const auto y = SinhLog(f / omega);
      const auto y_r = SinhLog(f / (ratio * omega));
      if (relative) {
        return ratio * (y - c) * (x * x + y_r * y_r) - second * (c - y_r) * (x * x + y * y);
      }
      return 2.0 * ratio * (omega / f) * (y - c) * (x * x + y_r * y_r) - second / k * x * (y - y_r);
    };
    T omega;
    if (!shared_second) {
      omega = exp(v[kSecond]);
    } else {
      const T second = exp(v[kSecond]);
      const auto value = [](const T& x) {
        if constexpr (std::is_same_v<T, double>) {
          return x;
        } else {
          return x.a;
        }
      };
      const double x = value(xi), c = value(across), k = value(stretch), held = value(second);
      const double highest = value(top);
      using One = ceres::Jet<double, 1>;
      double at = std::clamp(omega_hz, highest / ratio * (1 + 1e-12), highest * (1 - 1e-12));
      bool found = false;
      double slope = 0.0;
      for (int iteration = 0; iteration < 40 && !found; ++iteration) {
        const One error = balance(One(at, 0), One(x), One(c), One(k), One(held));
        slope = error.v[0];
        double next = at - error.a / slope;
        if (!std::isfinite(next)) return false;
        if (next >= highest) next = 0.5 * (at + highest);
        if (next <= highest / ratio) next = 0.5 * (at + highest / ratio);
        found = std::abs(next - at) <= 2e-15 * at ||
                (iteration > 6 && std::abs(next - at) <= 1e-13 * at);
        at = next;
      }
      if (!found) return false;
      omega_hz = at;
      if constexpr (std::is_same_v<T, double>) {
        omega = at;
      } else {
        const T error = balance(T(at), xi, across, stretch, second);
        omega = T(at);
        omega.v = -error.v / slope;
      }
    }
    const T y = SinhLog(f / omega);
    const T y_r = SinhLog(f / (ratio * omega));
    point.above = y - across;
    point.below = across - y_r;
    if (!(point.above > 0.0) || !(point.below > 0.0)) return false;
    const T factor = 2.0 * (omega / f) * stretch / (xi * (y - y_r));
    point.ln_omega = log(omega);
    point.ln_N = log(factor * point.below * (xi * xi + y * y));
    if (shared_second) {
      point.ln_M = relative ? v[kSecond] + point.ln_N : v[kSecond];
    } else {
      point.ln_M = log(factor * ratio * point.above * (xi * xi + y_r * y_r));
    }
    Lines(i, point);
    return true;
  }

  template <typename T>
  void Lines(std::size_t i, Point<T>& point) const {
    using std::exp;
    point.line_rad.clear();
    if (!two_modes || !(problem.test.second_crossing_tolerance_deg < 180.0)) return;
    for (const ObservedLine& line : problem.experiments[i].lines) {
      const LoopParameters<T> loop{
          {exp(point.ln_omega), exp(point.ln_xi), exp(point.ln_N), exp(point.ln_M), T(ratio)},
          point.tau_s};
      point.line_rad.push_back(LoopPhaseError(loop, T(line.frequency_hz)));
    }
  }

  // `values`: of slack at s = 0 for weight 1 (minus the violation), at any s for weight 0.
  bool Rows(State& state, const ConditionSet& soft, bool domain_soft,
            std::vector<Row>* rows) const {
    static thread_local std::vector<Point<Jet>> points;
    points.resize(targets.size());
    for (std::size_t i = 0; i < targets.size(); ++i) {
      if (!Build(i, state.local[i], state.omega_hz[i], points[i])) return false;
    }
    rows->clear();
    const MembershipTest& test = problem.test;
    const auto add = [&](const Jet& violation, std::size_t i, bool is_soft) {
      Row row;
      row.weight = is_soft ? 1.0 : 0.0;
      row.value = (is_soft ? 0.0 : 1.0) - violation.a;
      for (int k = 0; k < kLocals; ++k) {
        const int at = layout.index[i][static_cast<std::size_t>(k)];
        if (at < 0 || violation.v[k] == 0.0) continue;
        row.index[static_cast<std::size_t>(row.count)] = at;
        row.slope[static_cast<std::size_t>(row.count++)] = -violation.v[k];
      }
      rows->push_back(row);
    };
    const auto add_pair = [&](const Jet& a, std::size_t i, const Jet& b, std::size_t j,
                              double scale, double offset,
                              bool is_soft) {  // offset + (a - b) / scale
      add(offset + a / scale, i, is_soft);
      Row& row = rows->back();
      row.value += b.a / scale;
      for (int k = 0; k < kLocals; ++k) {
        const int at = layout.index[j][static_cast<std::size_t>(k)];
        if (at < 0 || b.v[k] == 0.0) continue;
        row.index[static_cast<std::size_t>(row.count)] = at;
        row.slope[static_cast<std::size_t>(row.count++)] = b.v[k] / scale;
      }
    };
    const double xi_max = test.xi_max;
    for (std::size_t i = 0; i < targets.size(); ++i) {
      const Point<Jet>& p = points[i];
      const auto coordinate = [&](int k) {
        return Jet(state.local[i][static_cast<std::size_t>(k)], k);
      };
      const auto both = [&](int k, Condition condition) {
        add(coordinate(k), i, soft.Contains(condition));
        add(-coordinate(k), i, soft.Contains(condition));
      };
      if (scales[i].soft_phase) both(kPhase, Condition::kPhase);
      if (scales[i].soft_gain) both(kGain, Condition::kGain);
      if (scales[i].soft_loop_phase) both(kLoopPhase, Condition::kLoopPhase);
      if (std::isfinite(xi_max)) {
        add(1.0 + (p.ln_xi - std::log(xi_max * (1 - kMargin))), i,
            soft.Contains(Condition::kXiMax));
      }
      if (two_modes) {
        const double tolerance = test.second_crossing_tolerance_deg * kRadPerDeg * (1.0 - kMargin);
        for (const Jet& error : p.line_rad) {
          add(error / tolerance, i, soft.Contains(Condition::kSecondCrossing));
          add(-error / tolerance, i, soft.Contains(Condition::kSecondCrossing));
        }
        if (!shared_second) {
          add(1.0 - p.above, i, false);
          add(1.0 - p.below, i, false);
        }
      }
      const auto domain = [&](ParameterKind kind, const Jet& ln) {
        const Range range = problem.RangeOf(kind);
        if (range.lo > 0.0) add(1.0 + (std::log(range.lo) - ln), i, domain_soft);
        if (std::isfinite(range.hi)) add(1.0 + (ln - std::log(range.hi)), i, domain_soft);
      };
      domain(ParameterKind::kOmega, p.ln_omega);
      domain(ParameterKind::kN, p.ln_N);
      if (two_modes && !shared_second) {
        domain(SecondKind(), relative ? p.ln_M - p.ln_N : p.ln_M);
      }
      const Range tau = problem.RangeOf(ParameterKind::kTau);
      if (tau.lo > 0.0) add(1.0 + (1.0 - p.tau_s / tau.lo), i, domain_soft);
      if (std::isfinite(tau.hi)) add(1.0 + (p.tau_s / tau.hi - 1.0), i, domain_soft);
      const auto& ellipsoid = problem.experiments[i].transfer_ellipsoid;
      if (ellipsoid && std::isfinite(test.transfer_distance_max)) {
        const TransferMatrix& factor = ellipsoid->Factor(two_modes);
        const Jet v[kNumTransferParameters] = {
            p.ln_omega - ellipsoid->Centre()(0), p.ln_xi - ellipsoid->Centre()(1),
            p.ln_N - ellipsoid->Centre()(2), p.ln_M - ellipsoid->Centre()(3)};
        Jet sum(1e-8);
        Eigen::Matrix<double, kLocals, kLocals> form;
        form.setZero();
        for (int r = 0; r < kNumTransferParameters; ++r) {
          Jet part(0.0);
          for (int c = r; c < kNumTransferParameters; ++c) {
            if (factor(r, c) != 0.0) part += factor(r, c) * v[c];
          }
          sum += part * part;
          form += part.v * part.v.transpose();
        }
        const Jet distance = sqrt(sum);
        const double limit = test.transfer_distance_max * (1 - kMargin);
        add(distance / limit, i, soft.Contains(Condition::kTransfer));
        rows->back().owner = static_cast<int>(i);
        rows->back().curvature =
            (form - distance.v * distance.v.transpose()) / (distance.a * limit);
      }
    }
    for (std::size_t i = 0; i < targets.size(); ++i) {
      for (std::size_t j = 0; j < targets.size(); ++j) {
        if (i == j) continue;
        if (std::isfinite(ln_spread)) {
          add_pair(points[i].ln_omega, i, points[j].ln_omega, j, ln_spread, 0.0,
                   soft.Contains(Condition::kOmegaSpread));
        }
        if (test.xi_increasing && targets[j].phi < targets[i].phi) {
          add_pair(points[j].ln_xi, j, points[i].ln_xi, i, 1.0, 1.0 + kMargin,
                   soft.Contains(Condition::kXiIncreasing));
        }
      }
    }
    return true;
  }

  bool FromMember(const Member& member, State& state) const {
    state.local.resize(member.size());
    state.omega_hz.resize(member.size());
    for (std::size_t i = 0; i < member.size(); ++i) {
      const LoopModel& model = member[i];
      const ExperimentErrors errors = ComputeErrors(problem.experiments[i], model);
      std::array<double, kLocals>& u = state.local[i];
      u[kXi] = std::log(model.xi);
      u[kPhase] = errors.phase_error_deg * kRadPerDeg / scales[i].phase;
      u[kGain] = errors.gain_error * problem.experiments[i].gain / scales[i].gain;
      u[kLoopPhase] = errors.loop_phase_error_deg * kRadPerDeg / scales[i].loop_phase;
      u[kSecond] = 0.0;
      if (two_modes) {
        u[kSecond] = shared_second ? std::log(relative ? member[0].M / member[0].N : member[0].M)
                                   : std::log(model.omega_hz);
      }
      state.omega_hz[i] = model.omega_hz;
      for (std::size_t k = 0; k < kLocals; ++k) {
        if (layout.index[i][k] < 0) continue;
        const Range& box = scales[i].box[k];
        const double pull = std::min(kPull * (box.hi - box.lo), 1e-2);
        u[k] = std::clamp(u[k], box.lo + pull, box.hi - pull);
        if (!std::isfinite(u[k])) return false;
      }
    }
    return true;
  }

  bool ToMember(State& state, Member& member) const {
    member.resize(targets.size());
    for (std::size_t i = 0; i < targets.size(); ++i) {
      if (!ToModel(i, state, member[i])) return false;
    }
    return true;
  }

  bool ToModel(std::size_t i, State& state, LoopModel& model) const {
    Point<double> point;
    if (!Build(i, state.local[i], state.omega_hz[i], point)) return false;
    model = {std::exp(point.ln_omega),
             std::exp(point.ln_xi),
             std::exp(point.ln_N),
             two_modes ? std::exp(point.ln_M) : 0.0,
             point.tau_s,
             ratio};
    // What is shared is shared to the last digit.
    if (shared_second) {
      const double second = std::exp(state.local[i][kSecond]);
      model.M = relative ? second * model.N : second;
    }
    return true;
  }

  State Moved(const State& state, const Eigen::VectorXd& step, double length, bool has_s) const {
    State moved = state;
    for (std::size_t i = 0; i < targets.size(); ++i) {
      for (std::size_t k = 0; k < kLocals; ++k) {
        const int at = layout.index[i][k];
        if (at >= 0) moved.local[i][k] += length * step(at);
      }
    }
    if (has_s) moved.s += length * step(layout.size);
    return moved;
  }

  // d quantity / d coordinates, by central differences: one experiment is rebuilt at a time.
  bool Gradient(const State& state, const MemberQuantity& quantity, double& value,
                Eigen::VectorXd& gradient) const {
    constexpr double kStep = 1e-6;
    gradient = Eigen::VectorXd::Zero(layout.size);
    State at = state;
    Member member;
    if (!ToMember(at, member)) return false;
    value = quantity.value(member);
    if (!std::isfinite(value)) return false;
    for (const std::size_t i : quantity.experiments) {
      const LoopModel kept = member[i];
      for (std::size_t k = 0; k < kLocals; ++k) {
        const int column = layout.index[i][k];
        if (column < 0) continue;
        double ends[2];
        for (const int side : {0, 1}) {
          State moved_state = at;
          moved_state.local[i][k] += side == 0 ? -kStep : kStep;
          if (!ToModel(i, moved_state, member[i])) return false;
          ends[side] = quantity.value(member);
        }
        member[i] = kept;
        gradient(column) += (ends[1] - ends[0]) / (2.0 * kStep);
      }
    }
    return gradient.allFinite();
  }

  struct Task {
    ConditionSet soft;
    bool domain_soft = false;
    bool has_s = false;          // minimise s; else maximise the quantity
    double enough = -kInfinite;  // s at which to stop
    const MemberQuantity* quantity = nullptr;
    double sign = 1.0;
    double scale = 1.0;
    bool pinned = false;  // the quantity is held at `at`
    double at = 0.0;
  };

  // Barrier value; infinite where a row or a box is not kept.
  double Barrier(State& state, const Task& task, std::vector<Row>& rows) const {
    if (!Rows(state, task.soft, task.domain_soft, &rows)) return kInfinite;
    double sum = 0.0;
    for (const Row& row : rows) {
      const double slack = row.weight * state.s + row.value;
      if (!(slack > 0.0)) return kInfinite;
      sum -= std::log(slack);
    }
    for (std::size_t i = 0; i < targets.size(); ++i) {
      for (std::size_t k = 0; k < kLocals; ++k) {
        if (layout.index[i][k] < 0 || (k == kSecond && shared_second && i > 0)) continue;
        const Range& box = scales[i].box[k];
        const double u = state.local[i][k];
        if (!(u > box.lo) || !(u < box.hi)) return kInfinite;
        sum -=
            std::log((u - box.lo) / (box.hi - box.lo)) + std::log((box.hi - u) / (box.hi - box.lo));
      }
    }
    return sum;
  }

  double Merit(const State& state, const Task& task, double barrier, double t,
               double penalty) const {
    double merit = barrier;
    if (task.has_s) merit += t * state.s;
    if (task.quantity != nullptr) {
      State copy = state;
      Member member;
      if (!ToMember(copy, member)) return kInfinite;
      const double value = task.quantity->value(member);
      merit += task.pinned ? penalty * std::abs(value - task.at) / task.scale
                           : -t * task.sign * value / task.scale;
    }
    if (!std::isfinite(merit)) return kInfinite;
    return merit;
  }

  bool Solve(State& state, const Task& task) const {
    constexpr int kSteps = 80;
    // Of s, or of the quantity in units of its scale.
    const double gap = task.has_s ? 5e-7 : 2e-5;
    const int n = layout.size + (task.has_s ? 1 : 0);
    std::vector<Row> rows, trial;
    double barrier = Barrier(state, task, rows);
    if (!std::isfinite(barrier)) return false;
    Eigen::MatrixXd hessian(n, n);
    Eigen::VectorXd gradient(n), step(n), slope;
    const double conditions = static_cast<double>(rows.size() + 2 * static_cast<std::size_t>(n));
    // On the central path s exceeds its least value by conditions / t.
    for (double t = task.has_s ? 3.0 * conditions / std::max(state.s, 0.1) : 10.0;; t *= 6.0) {
      bool stuck = false;
      for (int iteration = 0; iteration < kSteps; ++iteration) {
        hessian.setZero();
        gradient.setZero();
        for (const Row& row : rows) {
          const double inverse = 1.0 / (row.weight * state.s + row.value);
          std::array<int, kMostSlopes + 1> index{};
          std::array<double, kMostSlopes + 1> d{};
          int count = row.count;
          for (int a = 0; a < count; ++a) {
            index[static_cast<std::size_t>(a)] = row.index[static_cast<std::size_t>(a)];
            d[static_cast<std::size_t>(a)] = row.slope[static_cast<std::size_t>(a)] * inverse;
          }
          if (task.has_s && row.weight > 0.0) {
            index[static_cast<std::size_t>(count)] = layout.size;
            d[static_cast<std::size_t>(count++)] = row.weight * inverse;
          }
          for (int a = 0; a < count; ++a) {
            const auto ia = static_cast<std::size_t>(a);
            gradient(index[ia]) -= d[ia];
            for (int b = 0; b < count; ++b) {
              const auto ib = static_cast<std::size_t>(b);
              hessian(index[ia], index[ib]) += d[ia] * d[ib];
            }
          }
        }
        for (const Row& row : rows) {
          if (row.owner < 0) continue;
          const double inverse = 1.0 / (row.weight * state.s + row.value);
          const auto& index = layout.index[static_cast<std::size_t>(row.owner)];
          for (int a = 0; a < kLocals; ++a) {
            for (int b = 0; b < kLocals; ++b) {
              const int ia = index[static_cast<std::size_t>(a)];
              const int ib = index[static_cast<std::size_t>(b)];
              if (ia >= 0 && ib >= 0) hessian(ia, ib) += inverse * row.curvature(a, b);
            }
          }
        }
        for (std::size_t i = 0; i < targets.size(); ++i) {
          for (std::size_t k = 0; k < kLocals; ++k) {
            const int at = layout.index[i][k];
            if (at < 0 || (k == kSecond && shared_second && i > 0)) continue;
            const double lo = 1.0 / (state.local[i][k] - scales[i].box[k].lo);
            const double hi = 1.0 / (scales[i].box[k].hi - state.local[i][k]);
            gradient(at) += hi - lo;
            hessian(at, at) += lo * lo + hi * hi;
          }
        }
        if (task.has_s) gradient(layout.size) += t;
        double value = 0.0;
        double penalty = 0.0;
        if (task.quantity != nullptr) {
          if (!Gradient(state, *task.quantity, value, slope)) return false;
          if (!task.pinned) {
            gradient.head(layout.size) -= t * task.sign / task.scale * slope;
          }
        }
        for (int a = 0; a < n; ++a) hessian(a, a) *= 1.0 + 1e-12;
        const Eigen::LDLT<Eigen::MatrixXd> factor(hessian);
        if (factor.info() != Eigen::Success) return false;
        step = -factor.solve(gradient);
        double descent = gradient.dot(step);
        double miss = 0.0;
        if (task.pinned) {
          Eigen::VectorXd a = Eigen::VectorXd::Zero(n);
          a.head(layout.size) = slope / task.scale;
          miss = (value - task.at) / task.scale;
          const Eigen::VectorXd solved = factor.solve(a);
          const double multiplier = (miss + a.dot(step)) / a.dot(solved);
          step -= multiplier * solved;
          penalty = 2.0 * std::abs(multiplier) + 1.0;
          descent = gradient.dot(step) - penalty * std::abs(miss);
        }
        if (!step.allFinite()) return false;
        if (-descent < 1e-4 && std::abs(miss) < 1e-10) break;
        const double before = Merit(state, task, barrier, t, penalty);
        double length = 1.0;
        bool moved = false;
        for (int halving = 0; halving < 40; ++halving, length *= 0.5) {
          State next = Moved(state, step, length, task.has_s);
          const double next_barrier = Barrier(next, task, trial);
          if (!std::isfinite(next_barrier)) continue;
          const double after = Merit(next, task, next_barrier, t, penalty);
          if (!(after <= before + 1e-3 * length * descent)) continue;
          state = std::move(next);
          barrier = next_barrier;
          rows.swap(trial);
          moved = true;
          break;
        }
        if (!moved) {
          stuck = true;
          break;
        }
        if (task.has_s && !task.pinned && state.s < task.enough) return true;
      }
      if (conditions / t < gap || (stuck && t > 1e7)) return true;
    }
  }

  // The largest violation of the soft conditions of a state, at least zero.
  double LargestViolation(State& state, const Task& task) const {
    std::vector<Row> rows;
    if (!Rows(state, task.soft, task.domain_soft, &rows)) return kInfinite;
    double largest = 0.0;
    for (const Row& row : rows) {
      if (row.weight > 0.0) largest = std::max(largest, -row.value);
    }
    return largest;
  }

  struct Centre {
    double omega_hz, xi;
  };

  // Models at the measured phase and gain.
  std::optional<Member> FromCentres(const std::vector<Centre>& centres, double ln_second) const {
    if (shared_second) {
      ln_second = std::clamp(ln_second, scales[0].box[kSecond].lo, scales[0].box[kSecond].hi);
    }
    Member member;
    for (std::size_t i = 0; i < centres.size(); ++i) {
      const double xi = centres[i].xi;
      State state;
      state.local.assign(i + 1, {});
      state.omega_hz.assign(i + 1, centres[i].omega_hz);
      state.local[i] = {std::log(xi), 0.0, 0.0, 0.0, ln_second};
      const double top =
          OmegaFromDetuning(problem.experiments[i].frequency_hz, xi * std::tan(-scales[i].phase_0));
      if (two_modes && !shared_second) {
        state.local[i][kSecond] =
            std::log(std::clamp(centres[i].omega_hz, top / ratio * 1.001, top * 0.999));
      }
      LoopModel model;
      if (!ToModel(i, state, model)) return std::nullopt;
      member.push_back(model);
    }
    return member;
  }

  static constexpr double kInfinite = std::numeric_limits<double>::infinity();
};

LocalSearch::LocalSearch(const FamilyProblem& problem) : impl_(std::make_unique<Impl>(problem)) {}
LocalSearch::~LocalSearch() = default;

bool LocalSearch::IsSupported() const { return impl_->supported; }

std::optional<Approach> LocalSearch::FindMember(const Member& start, double enough) const {
  State state;
  if (!impl_->supported || !impl_->FromMember(start, state)) return std::nullopt;
  Impl::Task task;
  for (const Condition condition : kConditions) task.soft.Insert(condition);
  task.domain_soft = true;
  task.has_s = true;
  task.enough = enough;
  const double violation = impl_->LargestViolation(state, task);
  if (!std::isfinite(violation)) return std::nullopt;
  state.s = violation + 0.1;
  Approach approach;
  if (violation > enough) approach.converged = impl_->Solve(state, task);
  if (!impl_->ToMember(state, approach.member)) return std::nullopt;
  approach.violation = impl_->LargestViolation(state, task);
  approach.converged |= approach.violation <= enough;
  return approach;
}

std::optional<Approach> LocalSearch::Minimise(const Member& start, const ConditionSet& soft,
                                              const MemberQuantity* quantity, double at) const {
  State state;
  if (!impl_->supported || !impl_->FromMember(start, state)) return std::nullopt;
  Impl::Task task;
  task.soft = soft;
  task.has_s = true;
  if (quantity != nullptr) {
    task.quantity = quantity;
    task.pinned = true;
    task.at = at;
    task.scale = std::max(std::abs(at), 1e-300);
  }
  const double violation = impl_->LargestViolation(state, task);
  if (!std::isfinite(violation)) return std::nullopt;
  state.s = violation + 0.1;
  Approach approach;
  approach.converged = impl_->Solve(state, task);
  if (!impl_->ToMember(state, approach.member)) return std::nullopt;
  approach.violation = impl_->LargestViolation(state, task);
  if (quantity != nullptr &&
      !(std::abs(quantity->value(approach.member) - at) <= 1e-7 * std::max(std::abs(at), 1e-300))) {
    return std::nullopt;
  }
  return approach;
}

std::optional<Member> LocalSearch::Farthest(const Member& start, const MemberQuantity& quantity,
                                            double sign, double scale) const {
  const std::optional<Approach> inside = FindMember(start);
  if (!inside || !(inside->violation < 1.0)) return std::nullopt;
  State state;
  if (!impl_->FromMember(inside->member, state)) return std::nullopt;
  Impl::Task task;
  task.quantity = &quantity;
  task.sign = sign;
  task.scale = scale > 0.0 ? scale : std::abs(quantity.value(inside->member));
  if (!(task.scale > 0.0) || !impl_->Solve(state, task)) return std::nullopt;
  Member member;
  if (!impl_->ToMember(state, member) || !Holds(impl_->problem, member)) return std::nullopt;
  return member;
}

std::optional<Member> LocalSearch::Nominal(double xi, double relative) const {
  const FamilyProblem& problem = impl_->problem;
  if (!impl_->supported) return std::nullopt;
  const Range range = problem.RangeOf(ParameterKind::kXi);
  xi = std::clamp(xi, std::max(range.lo, kLeastXi) * (1 + 1e-6),
                  std::min({range.hi, problem.test.xi_max, kLargestXi}) * (1 - 1e-6));
  double ln_second = std::log(relative);
  if (impl_->shared_second && !impl_->relative) {
    for (const Experiment& experiment : problem.experiments) {  // about N = 2 xi w |G|
      ln_second += std::log(2.0 * xi * kRadPerSPerHz * experiment.frequency_hz * experiment.gain) /
                   static_cast<double>(problem.experiments.size());
    }
  }
  std::vector<Impl::Centre> centres;
  for (const Experiment& experiment : problem.experiments) {
    centres.push_back({0.99 * experiment.frequency_hz, xi});
  }
  return impl_->FromCentres(centres, ln_second);
}

std::optional<Member> LocalSearch::FromTransfer() const {
  const FamilyProblem& problem = impl_->problem;
  if (!impl_->supported) return std::nullopt;
  double ln_second = 0.0;
  std::vector<Impl::Centre> centres;
  const Range xi = problem.RangeOf(ParameterKind::kXi);
  for (const Experiment& experiment : problem.experiments) {
    if (!experiment.transfer_ellipsoid) return std::nullopt;
    const TransferVector& centre = experiment.transfer_ellipsoid->Centre();
    ln_second += (impl_->relative ? centre(3) - centre(2) : centre(3)) /
                 static_cast<double>(problem.experiments.size());
    centres.push_back({std::exp(centre(0)),
                       std::clamp(std::exp(centre(1)), std::max(xi.lo, kLeastXi) * (1 + 1e-6),
                                  std::min(xi.hi, kLargestXi) * (1 - 1e-6))});
  }
  return impl_->FromCentres(centres, ln_second);
}

}  // namespace howl

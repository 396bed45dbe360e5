#include "estimation/family/local/local_state.h"

#include <algorithm>
#include <cmath>

#include "estimation/family/local/local_point.h"
#include "model/numerics/units.h"

namespace howl {

namespace {

constexpr double kPull = 1e-3;  // of a coordinate's box: how far a start is drawn inside

}  // namespace

bool StateOf(const LocalCoordinates& c, const Member& member, LocalState& state) {
  state.local.resize(member.size());
  state.omega_hz.resize(member.size());
  for (std::size_t i = 0; i < member.size(); ++i) {
    const LoopModel& model = member[i];
    const Experiment& experiment = c.problem.experiments[i];
    const LocalScale& scale = c.scales[i];
    const ExperimentErrors errors = ComputeErrors(experiment, model);
    std::array<double, kLocals>& u = state.local[i];
    u[kLocalXi] = std::log(model.xi);
    u[kLocalPhase] = errors.phase_error_deg * kRadPerDeg / scale.phase;
    u[kLocalGain] = errors.gain_error * experiment.gain / scale.gain;
    u[kLocalDelay] = c.shared_tau ? (member[0].tau_s - c.tau_0_s) / c.tau_scale_s
                                  : errors.loop_phase_error_deg * kRadPerDeg / scale.loop_phase;
    u[kLocalSecond] = 0.0;
    if (c.two_modes) {
      u[kLocalSecond] = c.shared_second
                            ? std::log(c.relative ? member[0].M / member[0].N : member[0].M)
                            : std::log(model.omega_hz);
    }
    state.omega_hz[i] = model.omega_hz;
    for (std::size_t k = 0; k < kLocals; ++k) {
      if (c.index[i][k] < 0) continue;
      const Range& box = scale.box[k];
      const double pull = std::min(kPull * (box.hi - box.lo), 1e-2);
      u[k] = std::clamp(u[k], box.lo + pull, box.hi - pull);
      if (!std::isfinite(u[k])) return false;
    }
  }
  return true;
}

bool ModelOf(const LocalCoordinates& c, std::size_t experiment, LocalState& state,
             LoopModel& model) {
  LocalPoint<double> point;
  if (!BuildLocalPoint(c, experiment, state.local[experiment], state.omega_hz[experiment], point)) {
    return false;
  }
  model = {std::exp(point.ln_omega),
           std::exp(point.ln_xi),
           std::exp(point.ln_N),
           c.two_modes ? std::exp(point.ln_M) : 0.0,
           point.tau_s,
           c.ratio};
  if (c.shared_second) {
    const double second = std::exp(state.local[experiment][kLocalSecond]);
    model.M = c.relative ? second * model.N : second;
  }
  return true;
}

bool MemberOf(const LocalCoordinates& c, LocalState& state, Member& member) {
  member.resize(c.targets.size());
  for (std::size_t i = 0; i < c.targets.size(); ++i) {
    if (!ModelOf(c, i, state, member[i])) return false;
  }
  return true;
}

LocalState Moved(const LocalCoordinates& c, const LocalState& state, const Eigen::VectorXd& step,
                 double length, bool has_s) {
  LocalState moved = state;
  for (std::size_t i = 0; i < c.targets.size(); ++i) {
    for (std::size_t k = 0; k < kLocals; ++k) {
      const int at = c.index[i][k];
      if (at >= 0) moved.local[i][k] += length * step(at);
    }
  }
  if (has_s) moved.s += length * step(c.size);
  return moved;
}

}  // namespace howl

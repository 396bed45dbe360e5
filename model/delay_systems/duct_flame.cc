#include "model/delay_systems/duct_flame.h"

#include <glog/logging.h>

#include <cmath>

#include "model/numerics/units.h"

namespace howl {
namespace {

Eigen::Index States(const DuctFlame& duct) {
  return 2 * static_cast<Eigen::Index>(duct.modes.size()) + (std::isinf(duct.cutoff_hz) ? 0 : 1);
}

}  // namespace

Eigen::VectorXd DriveOf(const DuctFlame& duct) {
  const auto modes = static_cast<Eigen::Index>(duct.modes.size());
  Eigen::VectorXd c = Eigen::VectorXd::Zero(States(duct));
  const Eigen::Index first = duct.drive == FlameDrive::kVelocity ? 0 : modes;
  for (Eigen::Index k = 0; k < modes; ++k) {
    c(first + k) = duct.modes[static_cast<std::size_t>(k)].at_flame;
  }
  return c;
}

DelaySystem MakeDelaySystem(const DuctFlame& duct) {
  CHECK(!duct.modes.empty());
  CHECK_GT(duct.tau_s, 0.0);
  CHECK_GT(duct.cutoff_hz, 0.0);
  const auto modes = static_cast<Eigen::Index>(duct.modes.size());
  const Eigen::VectorXd drive = DriveOf(duct);
  const bool low_pass = !std::isinf(duct.cutoff_hz);
  const auto rate = [duct, drive, modes, low_pass](double strength, const Eigen::VectorXd& x,
                                                   std::span<const Eigen::VectorXd> delayed,
                                                   Eigen::VectorXd* out) {
    const double v = drive.dot(delayed[0]);
    const double felt = low_pass ? x(2 * modes) : v;
    const double q = strength * FlameResponse(duct.flame, felt);
    for (Eigen::Index k = 0; k < modes; ++k) {
      const DuctMode& mode = duct.modes[static_cast<std::size_t>(k)];
      const double w = kRadPerSPerHz * mode.omega_hz;
      (*out)(k) = w * x(modes + k);
      (*out)(modes + k) = -w * x(k) - 2.0 * mode.xi * w * x(modes + k) + mode.N * q;
    }
    if (low_pass) (*out)(2 * modes) = kRadPerSPerHz * duct.cutoff_hz * (v - felt);
  };
  return {static_cast<int>(States(duct)), {duct.tau_s}, rate};
}

}  // namespace howl

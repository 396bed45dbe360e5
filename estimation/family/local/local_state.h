// The state of a local search: the coordinates of every experiment
// (estimation/family/local/local_coordinates.h) and s, the bound on what is minimised. It is
// converted to and from a member, whose shared parameters are equal to the last digit.
#ifndef HOWL_ESTIMATION_FAMILY_LOCAL_LOCAL_STATE_H_
#define HOWL_ESTIMATION_FAMILY_LOCAL_LOCAL_STATE_H_

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "estimation/family/local/local_coordinates.h"

namespace howl {

struct LocalState {
  std::vector<std::array<double, kLocals>> local;
  double s = 1.0;
  std::vector<double> omega_hz;  // where the last root was
};

// Pulls the state inside the boxes; false where a coordinate is not finite.
bool StateOf(const LocalCoordinates& c, const Member& member, LocalState& state);

// False where there is no such model; the roots are left in `state`.
bool ModelOf(const LocalCoordinates& c, std::size_t experiment, LocalState& state,
             LoopModel& model);
bool MemberOf(const LocalCoordinates& c, LocalState& state, Member& member);

// Moves the state by length * step; with `has_s` the step's last entry is that of s.
LocalState Moved(const LocalCoordinates& c, const LocalState& state, const Eigen::VectorXd& step,
                 double length, bool has_s);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_LOCAL_LOCAL_STATE_H_

// Slack: what is free at one block of the loop, and explains nothing. Each form is an effect with
// no meaning (model/effects/effect.h), so that base and slack are fitted together and what the base
// can absorb is no evidence for any place.
//
// A channel's, the flame's or the duct's free factor is causal and of minimum phase,
//
//   H(s) = exp(sum over j of c_j ((s - a) / (s + a))^j),   j = 1 ... n
//
// analytic in the right half-plane with its inverse; c_0, a gain, is absorbed by every base. A
// duct's response at one place from another's heat need not be of minimum phase: j < 0 too.
#ifndef HOWL_DIAGNOSIS_LOCALISE_FREE_SLACK_H_
#define HOWL_DIAGNOSIS_LOCALISE_FREE_SLACK_H_

#include <string>
#include <vector>

#include "model/effects/catalogue.h"

namespace howl {

// All that a slack's form needs of the rig.
struct SlackScale {
  double cycle_hz = 0.0;
  double centre_hz = 0.0;  // a / (2 pi)
  double tau_s = 0.0;
};

// Forms of the acoustics: a free factor; the upper mode's place and damping with one more mode;
// frequency and damping that move with time and with the slow amplitude.
std::vector<EffectPointer> FreeAcoustics(const SlackScale& scale);
// Behind the flame's characteristic: a free factor; a section of second order.
std::vector<EffectPointer> FreeFlame(const SlackScale& scale);
// A distribution of delays about two means; a delay that moves with the operating parameter and
// with the slow amplitude.
std::vector<EffectPointer> FreeDelay(const SlackScale& scale);
// The delay of the experiment at this position alone.
std::vector<EffectPointer> FreePoint(double phi_position);
// On recorded p, its inverse before the flame: a free factor; a section of second order.
std::vector<EffectPointer> FreePressureInstrument(const SlackScale& scale);
// On recorded q with a shift in time: a free factor; a section of second order; a share of p.
std::vector<EffectPointer> FreeHeatReleaseInstrument(const SlackScale& scale);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOCALISE_FREE_SLACK_H_

// Slack: a free error of one block of the loop, which explains nothing. Each form is an effect
// without a physical cause (model/effects/effect.h), so that base and slack are fitted together and
// what the base can absorb is no evidence for any place.
//
// A channel's, the flame's or the duct's free factor is causal and of minimum phase,
//
//   H(s) = exp(sum over j of c_j ((s - a) / (s + a))^j),   j = 1 ... n
//
// and analytic in the right half-plane together with its inverse; c_0, a gain, is absorbed by every
// base. The response of a duct at one place to heat released at another need not be of minimum
// phase; there j < 0 is used too.
#ifndef HOWL_DIAGNOSIS_LOCALISE_FREE_SLACK_H_
#define HOWL_DIAGNOSIS_LOCALISE_FREE_SLACK_H_

#include <string>
#include <vector>

#include "model/effects/effect.h"

namespace howl {

// What the forms of slack need to know of the rig.
struct SlackScale {
  double cycle_hz = 0.0;
  double centre_hz = 0.0;  // a / (2 pi)
  double tau_s = 0.0;
};

// Forms of the acoustics: a free factor; the upper mode's place and damping with one more mode;
// frequency and damping that move with time and with the slow amplitude.
std::vector<EffectPointer> FreeAcoustics(const SlackScale& scale);
// Forms behind the flame's characteristic: a free factor; a section of second order.
std::vector<EffectPointer> FreeFlame(const SlackScale& scale);
// Forms of the delay: a distribution of delays about two means; a delay that moves with the
// operating parameter and with the slow amplitude.
std::vector<EffectPointer> FreeDelay(const SlackScale& scale);
// A free delay of the experiment at this position alone.
std::vector<EffectPointer> FreePoint(double phi_position);
// Forms on recorded p, with the inverse before the flame: a free factor; a section of second order.
std::vector<EffectPointer> FreePressureInstrument(const SlackScale& scale);
// Forms on recorded q with a shift in time: a free factor; a section of second order; a share of p.
std::vector<EffectPointer> FreeHeatReleaseInstrument(const SlackScale& scale);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOCALISE_FREE_SLACK_H_

// A record without an oscillation that is not the one asked about. With the blocks z_b of a channel
// at the oscillation's frequency f_o (spectrum.h), joined by their own windows w_b,
//
//   x(t) - Re[ e^(2 pi j f_o t) sum_b w_b(t) z_b / sum_b w_b(t) ]
//
// A steady tone at f_o is taken out to the last bit, and one whose phase and amplitude wander as
// far as the blocks follow. At a distance d from f_o the channel is left at 1 - H(d)^2 of itself, H
// the response of a Hann block: at three block widths 1/L, or more, within 1e-3, whatever was
// there. Both channels lose the same share, so that their ratio at the cycle is what it was.
#ifndef HOWL_ESTIMATION_ANALYSIS_OSCILLATIONS_NOTCH_H_
#define HOWL_ESTIMATION_ANALYSIS_OSCILLATIONS_NOTCH_H_

#include <optional>
#include <span>
#include <vector>

#include "estimation/analysis/spectra/record.h"

namespace howl {

struct Notch {
  double frequency_hz = 0.0;
  double block_s = 0.0;
};

// The widest notch at other_hz that leaves cycle_hz alone; none where a record of this length
// does not tell the two apart.
std::optional<Notch> NotchBeside(double other_hz, double cycle_hz, double duration_s);

// The oscillation that the notch takes out of the samples, whose mean does not matter.
std::vector<double> OscillationAt(std::span<const double> samples, double sampling_hz,
                                  const Notch& notch);

// The record without all of them; its means stay.
Record WithoutOscillations(const Record& record, std::span<const Notch> notches);

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_OSCILLATIONS_NOTCH_H_

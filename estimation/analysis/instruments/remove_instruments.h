// Removes known instruments' responses from a record before anything is estimated:
//
//   P(f) = P_recorded(f) / H_p(f),
//   Q(f) = (Q_recorded(f) - leak P_recorded(f)) e^(+s delay_s) / H_q(f),   s = 2 pi j f
//
// in the discrete Fourier transform of the whole record.
//
// The division is limited where it would blow up noise: its gain is 1 / |H|, and nowhere more than
// that at a hundredth of the largest |H| up to half of the sampling rate. Its phase is that of
// 1 / H everywhere. So a line where |H| is above that hundredth is restored in full, and below it
// the phase is right and the magnitude too small by |H| over the hundredth. (A bound on the gain
// and not Tikhonov's |H|^2 + c^2, which moves every magnitude.)
//
// The mean is subtracted before and added again after, because a probe that loses it (H = 0 at s =
// 0) leaves nothing to restore. An H that is not one at s = 0 therefore acts on the fluctuations
// alone; nothing that is estimated from a record depends on its mean.
//
// At the ends the instruments responded to signals that lie before the record's first sample, and,
// with a delay, after its last. The record is continued beyond both ends by its own linear
// prediction (linear_prediction.h), which goes on with its cycle, and fades out over a twentieth of
// its length. Then the samples that depend on the continuation are dropped, from both ends of both
// channels alike: as many as the memory of the division, beyond which its impulse response has less
// than 1e-6 of its energy. (The response is taken under a window that falls from one at zero
// frequency to zero at half of the sampling rate, because a band that ends sharply would ring for
// ever.) No more than a fiftieth of the record is dropped at an end. A longer memory is that of a
// probe without low frequencies, which leaves a slow error, or that of a sharp notch.
#ifndef HOWL_ESTIMATION_ANALYSIS_INSTRUMENTS_REMOVE_INSTRUMENTS_H_
#define HOWL_ESTIMATION_ANALYSIS_INSTRUMENTS_REMOVE_INSTRUMENTS_H_

#include <cstddef>
#include <optional>

#include "estimation/analysis/instruments/instrument_response.h"
#include "estimation/analysis/spectra/record.h"
#include "model/loop/instrument.h"

namespace howl {

struct Instruments {
  std::optional<InstrumentResponse> pressure;
  std::optional<InstrumentResponse> heat_release;
  double delay_s = 0.0;  // by how much heat release is recorded later than pressure
  double leak = 0.0;     // of recorded pressure into recorded heat release, in q's unit over p's

  bool None() const { return !pressure && !heat_release && delay_s == 0.0 && leak == 0.0; }
};

inline constexpr double kLeastResponseShare = 0.01;  // of the largest |H|
inline constexpr double kMostDroppedShare = 0.02;    // of the record, at each end

// The fault of a response that has no finite value, or is zero at every frequency of the record.
struct ResponseFault {
  Channel channel = Channel::kPressure;
  double frequency_hz = 0.0;
  bool zero = false;
};

// The record without its instruments, shorter by what is dropped; it is left as it was where there
// is a fault. |delay_s| is at most kMostDroppedShare of the record. Without instruments no bit
// changes.
std::optional<ResponseFault> RemoveInstruments(const Instruments& instruments, Record& record);

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_INSTRUMENTS_REMOVE_INSTRUMENTS_H_

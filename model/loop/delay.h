// Transport delay between nozzle and burning plane (the paper, section 3.1): e^(-tau s), here at
// s = j 2 pi f. Unit magnitude; phase -360 tau f degrees. tau in seconds, f in hertz.
//
// Exact, so that its derivative with respect to tau is -j 2 pi f e^(-j 2 pi f tau), never zero.
#ifndef HOWL_MODEL_LOOP_DELAY_H_
#define HOWL_MODEL_LOOP_DELAY_H_

#include "model/numerics/complex.h"
#include "model/numerics/units.h"

namespace howl {

template <typename T>
Complex<T> DelayResponse(const T& tau_s, const T& frequency_hz) {
  return UnitPhasor(T(-kRadPerSPerHz) * tau_s * frequency_hz);
}

}  // namespace howl

#endif  // HOWL_MODEL_LOOP_DELAY_H_

// Loops over the bins of a kept loop (kept_loop.h), in vectors as wide as the machine has. The bits
// do not depend on the width (vector_clones.h).
//
// Arrays have as many numbers as are said; x: the frequencies s = j x.
#ifndef HOWL_ESTIMATION_RECORD_FIT_LOOP_LOOP_LANES_H_
#define HOWL_ESTIMATION_RECORD_FIT_LOOP_LOOP_LANES_H_

#include <complex>
#include <cstddef>

#include "estimation/record_fit/loop/loop_point.h"
#include "estimation/record_fit/loop/mode_sums.h"

namespace howl {

// 1 / (s^2 + 2 xi omega s + omega^2)
void SetResonance(const LoopMode& mode, const double* x, std::ptrdiff_t count,
                  std::complex<double>* out);

// out += (a s + b omega) over, of a mode's resonance `over`.
void AddTransfer(const LoopMode& mode, const double* x, const std::complex<double>* over,
                 std::ptrdiff_t count, std::complex<double>* out);

// out += ((a s + b omega) q + g s + h omega) over.
void AddAnswer(const LoopMode& mode, const double* x, const std::complex<double>* q,
               const std::complex<double>* over, std::ptrdiff_t count, std::complex<double>* out);

// What the taper's differences leave of a signal: count - 1 numbers, of what stands at i less what
// stands at i + 1 of signal - answer factors. factors: null for ones.
void SetLeft(const std::complex<double>* signal, const std::complex<double>* answer,
             const std::complex<double>* factors, std::ptrdiff_t count, std::complex<double>* out);

// a b of each.
void SetProducts(const std::complex<double>* a, const std::complex<double>* b, std::ptrdiff_t count,
                 std::complex<double>* out);

// The real part of the sum of a b c.
double SumOfProducts(const std::complex<double>* a, const std::complex<double>* b,
                     const std::complex<double>* c, std::ptrdiff_t count);

ModeSums SumsOfMode(const std::complex<double>* weights, const double* x,
                    const std::complex<double>* over, std::ptrdiff_t count);

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_LOOP_LOOP_LANES_H_

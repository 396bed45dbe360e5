// The loop at one frequency, and the integral of ln |D| from an octave above a record's band to
// infinity (return_difference.h):
//
//   integral of ln |D| = - Re Value,   Value = Li2(K) / -j l + (Li2(U) - Li2(K)) / (m / omega_2 - j
//   l)
#ifndef HOWL_ESTIMATION_RECORD_FIT_LOOP_LOOP_TAIL_H_
#define HOWL_ESTIMATION_RECORD_FIT_LOOP_LOOP_TAIL_H_

#include <Eigen/Core>
#include <complex>

#include "estimation/record_fit/loop/loop_point.h"

namespace howl {

// At s, D_tau(s) V(s) and U: that times R.
struct LoopAt {
  LoopAt(const RecordSpectra& record, const LoopPoint& point, std::complex<double> at);

  // Adds the real part of `by` times dU, by the acoustics' parameters, ln tau and ln rho.
  void AddSlopes(const PointStructure& structure, const LoopPoint& point, std::complex<double> by,
                 Eigen::VectorXd* out) const;

  std::complex<double> s;
  PathSlopes slopes;
  std::complex<double> path;
  std::complex<double> u;
};

struct LoopTail {
  LoopTail(const RecordSpectra& record, const LoopPoint& point);

  std::complex<double> Value() const;
  // Of Value by ln K, by ln U, and by l.
  std::complex<double> ByConstant() const;
  std::complex<double> ByLoop() const;
  std::complex<double> ByFall() const;

  LoopAt loop;                          // at omega_2
  std::complex<double> u;               // with the flame's slope in it
  std::complex<double> constant = 0.0;  // K
  std::complex<double> of_constant;     // 1 / j l
  std::complex<double> of_rest;         // 1 / (m / omega_2 + j l)
};

// The delay by which the loop turns half a turn over the record's band. A shorter one cannot be
// told from an answer at once, which mixes p and q within a sample: over the band ln |D| may then
// have one sign throughout, and the likelihood is as good as the model's word for what the loop
// does where there are no records. With any longer one ln |1 - K e^(-tau s)| has a mean of zero
// over the band.
double LeastDelay(const RecordSpectra& record);

// What K is proportional to.
double SumOfResidues(const LoopPoint& point);

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_LOOP_LOOP_TAIL_H_

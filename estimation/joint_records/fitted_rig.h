// The loop that a record shows, as a rig that can be simulated (model/simulation/simulate_modal.h):
//
//   R, tau and Phi = Q sum_k c_k b_k(v) of loop_point.h in units of the rig; noise with the spectra
//   of noise_sources.h
//
// What the record does not tell is chosen so that little depends on it:
//
//   outside of the largest |v|     Phi is constant, as its splines are
//   Phi's constant                 q has the mean zero in the cycle, as records have it
//   below the band                 spectra stay as they are at its lower end
//   above it                       those of combustion and duct fall as 1 / f^4, of sensors and
//                                  background stay
//   integral of p                  leaks, so that its mean stays: at a thousandth of the cycle's
//                                  frequency, faster where a mean would run away otherwise
#ifndef HOWL_ESTIMATION_JOINT_RECORDS_FITTED_RIG_H_
#define HOWL_ESTIMATION_JOINT_RECORDS_FITTED_RIG_H_

#include "estimation/record_fit/loop/loop_point.h"
#include "model/simulation/simulate_modal.h"

namespace howl {

// cycle_amplitude: of the fundamental of p in the cycle with which the simulation begins, in units
// of the rig; zero: at rest.
ModalRig FittedRigOf(const RecordSpectra& record, const PointStructure& structure,
                     const LoopPoint& point, double cycle_amplitude);

}  // namespace howl

#endif  // HOWL_ESTIMATION_JOINT_RECORDS_FITTED_RIG_H_

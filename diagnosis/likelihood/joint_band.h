// A record made ready for the joint likelihood (joint_likelihood.h): both signals on one band of
// bins, under the sine taper sin(pi n / N), which is zero at the record's ends. In the frequency
// domain it is the difference of neighbouring bins, taken of a residual, so that no filter's
// transient at the ends is left in it.
//
// Bin i stands at the middle of two bins of the record's transform. Under this taper neighbouring
// bins are correlated by -1/2, so that a bin counts for 1 / 1.5 of an independent one: two thirds
// of all that the record holds, whatever its length.
#ifndef HOWL_DIAGNOSIS_LIKELIHOOD_JOINT_BAND_H_
#define HOWL_DIAGNOSIS_LIKELIHOOD_JOINT_BAND_H_

#include <Eigen/Core>

#include "diagnosis/records/cut_record.h"
#include "estimation/record_fit/spectra/record_spectra.h"

namespace howl {

inline constexpr Eigen::Index kPowerReach = 4;  // bins to either side, of smoothed powers

struct JointBand {
  CutRecord record;  // with the flame driven by p as it was recorded
  Eigen::Index count = 0;
  Eigen::VectorXd frequency_hz;
  Eigen::VectorXcd pressure;  // tapered
  Eigen::VectorXcd heat_release;
  Eigen::VectorXd log_frequency;  // -1 .. 1 over the band

  // What a bin counts for: kSineTaperShare, and nothing where a line is masked.
  Eigen::VectorXd share;

  // |R Q|^2 and |H Phi|^2 of the base, smoothed over a few bins, to which the model's errors are
  // relative. They are the first fit's for every structure, so that none can make its errors
  // smaller by predicting less (structure_fit.h). Ones until then.
  Eigen::VectorXd acoustic_power;
  Eigen::VectorXd flame_power;
  // |P|^2 and |Q|^2, smoothed over a few bins: an error in proportion to one bin's own power would
  // take bins that noise makes large for errors.
  Eigen::VectorXd pressure_power;
  Eigen::VectorXd heat_release_power;
};

JointBand MakeJointBand(const CutRecord& record);

// A spectrum on the record's extended band after the taper: `count` bins.
Eigen::VectorXcd SineTapered(const Eigen::Ref<const Eigen::VectorXcd>& extended,
                             Eigen::Index count);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LIKELIHOOD_JOINT_BAND_H_

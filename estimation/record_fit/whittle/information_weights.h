// What each bin of a chunk weighs in the information of whittle.h: the coefficients of products of
// the slopes that two parameters have there, with what the bin counts for in them.
#ifndef HOWL_ESTIMATION_RECORD_FIT_WHITTLE_INFORMATION_WEIGHTS_H_
#define HOWL_ESTIMATION_RECORD_FIT_WHITTLE_INFORMATION_WEIGHTS_H_

#include <Eigen/Core>

#include "estimation/record_fit/whittle/noise_of_bins.h"
#include "estimation/record_fit/whittle/whittle.h"

namespace howl {

// What two parameters that move R or F have in common at each bin: the coefficients of dx dy and of
// dx conj(dy).
struct Coupling {
  Eigen::VectorXcd alpha;
  Eigen::VectorXcd beta;
};

// All that the information needs of a chunk of bins, with their weights in it.
struct InformationWeights {
  InformationWeights(Eigen::Index bins, Eigen::Index sources)
      : rr{Eigen::VectorXcd(bins), Eigen::VectorXcd(bins)},
        rf(rr),
        ff(rr),
        aa(bins),
        ab(bins),
        bb(bins),
        r_spectra(bins, sources),
        f_spectra(bins, sources),
        spectra_spectra(bins, sources * sources),
        r_ratio(bins),
        f_ratio(bins),
        spectra_ratio(bins, sources) {}

  Coupling rr, rf, ff;
  Eigen::VectorXcd aa, ab, bb;            // of dE_A conj(dE_A), dE_A conj(dE_B), dE_B conj(dE_B)
  Eigen::MatrixXcd r_spectra, f_spectra;  // of dR d ln S_j
  Eigen::MatrixXd spectra_spectra;
  // Of the background's ratio, which is the same at all bins: sums where no other parameter's
  // slope depends on the bin.
  double ratio_ratio = 0.0;
  Eigen::VectorXcd r_ratio, f_ratio;
  Eigen::MatrixXd spectra_ratio;
};

// Of a chunk of `bins`, of which `first` is the first; share: of all bins. The background's own is
// added to what there is.
void WeighInformation(const NoiseOfBins& noise, const LoopResiduals& at, const double* share,
                      Eigen::Index first, Eigen::Index bins, InformationWeights* out);

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_WHITTLE_INFORMATION_WEIGHTS_H_

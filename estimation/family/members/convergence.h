// Convergence of several chains of one scalar (Gelman et al., Bayesian Data Analysis, 3rd ed.,
// section 11.4-11.5; Geyer 1992).
#ifndef HOWL_ESTIMATION_FAMILY_MEMBERS_CONVERGENCE_H_
#define HOWL_ESTIMATION_FAMILY_MEMBERS_CONVERGENCE_H_

#include <vector>

namespace howl {

struct Convergence {
  double effective_sample_size = 0.0;
  double split_r_hat = 1.0;
};

// Chains of equal length (at least four); every one is split in two.
Convergence AssessConvergence(const std::vector<std::vector<double>>& chains);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_MEMBERS_CONVERGENCE_H_

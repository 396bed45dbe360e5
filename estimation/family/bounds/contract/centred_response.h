// The response (5a) and its derivatives over a box, with N eliminated by the limit cycle at f,
// where G = |G| e^(j theta). With d_k(f) = 2 r_k omega xi + j (w - r_k^2 omega^2 / w), r_k = 1 and
// r, so that U_k = 1 / d_k,
//
//   N       = |G| e^(j theta) d_1(f) - M d_1(f) U_r(f),   the right-hand side being real,
//   G(f_l)  = |G| e^(j theta) q + M (U_r(f_l) - q U_r(f)),   q = d_1(f) / d_1(f_l).
//
// The variables are omega in rad/s, xi, t = tan(-theta), |G|, M and the loop phase error, which
// none of the two depends on. All need a RoundingGuard.
#ifndef HOWL_ESTIMATION_FAMILY_BOUNDS_CONTRACT_CENTRED_RESPONSE_H_
#define HOWL_ESTIMATION_FAMILY_BOUNDS_CONTRACT_CENTRED_RESPONSE_H_

#include <array>

#include "estimation/family/bounds/contract/centred_row.h"
#include "estimation/family/bounds/contract/contract.h"
#include "model/numerics/complex.h"

namespace howl {

enum ResponseVariable {
  kResponseOmega,
  kResponseXi,
  kResponseTangent,
  kResponseGain,
  kResponseM,
  kResponseLoopPhase,
  kResponseVariables
};

using ResponseBox = std::array<Interval, kResponseVariables>;
using ResponseRow = CentredRow<kResponseVariables>;

// A complex value over the box, and its derivatives there.
struct ComplexForm {
  Complex<Interval> value;
  std::array<Complex<Interval>, kResponseVariables> by;
};

// Of omega and xi alone.
struct ModeForm {
  Complex<Interval> value, by_omega, by_xi;
};

class CentredResponse {
 public:
  CentredResponse(const ContractTarget& target, const ResponseBox& box);

  ComplexForm N() const;
  ComplexForm AtLine(const Interval& w_line) const;

 private:
  ComplexForm Assembled(const ModeForm& of_gain, const ModeForm& of_m) const;

  const ContractTarget& target_;
  const ResponseBox& box_;
  Complex<Interval> phasor_;
  ModeForm first_, other_;  // d_1(f) and U_r(f)
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_BOUNDS_CONTRACT_CENTRED_RESPONSE_H_

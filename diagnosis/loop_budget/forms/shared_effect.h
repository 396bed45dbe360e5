// Effects of the catalogue whose parameters all operating points share: of the instruments,
//
//   P_recorded = H_p P                      so that P = P_recorded / H_p
//   Q_recorded = H_q Q + leak P_recorded            Q = (Q_recorded - leak P_recorded) / H_q
//
// are what the loop is fitted to, and filters before and behind the flame's curve, which the record
// is made ready with (record_spectra.h). The likelihood of what was recorded has the Jacobian of
// the divisions, which is what a bin counts for times -2 ln |H|.
//
// What stands before the curve turns the cycle's phase. Its turn is taken back, as a delay at all
// frequencies, so that the loop's own delay stays that of the cycle, which records tell best; and
// H_p is over its size there, so that the unit of p stays.
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_FORMS_SHARED_EFFECT_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_FORMS_SHARED_EFFECT_H_

#include <Eigen/Core>
#include <complex>
#include <string_view>
#include <vector>

#include "estimation/record_fit/spectra/record_spectra.h"
#include "model/effects/effect.h"

namespace howl {

struct SharedEffect {
  EffectPointer effect;
  std::vector<double> values;  // of its parameters
};

// The leak of p into q.
inline constexpr std::string_view kLeakId = "crosstalk_p_to_q";
// Before the curve they filter what drives it. Behind the curve they are the loop's own, with other
// values at each operating point (loop_point.h).
inline constexpr std::string_view kSecondPathId = "second_delay_path";
inline constexpr std::string_view kDelayDispersionId = "delay_dispersion";

// Of a flame.
bool IsFlameFilter(const Effect& effect);

// Those of the catalogue: of q's instrument, with one parameter, of p's, and the flame's filters,
// in all their forms. A declared one is such an effect where it is one transfer function
// (declared_effect.h).
std::vector<EffectPointer> SharedEffects();

// The record as it would be without the instruments, and with the flame's filters.
RecordSpectra RecordBeside(RecordSpectra record, const std::vector<SharedEffect>& effects);

// Noise of p that was told beside these effects, one value a sample, as it was recorded.
Eigen::VectorXd PressureAsRecorded(const RecordSpectra& record,
                                   const std::vector<SharedEffect>& effects, Eigen::VectorXd noise);

// How P and Q, as the loop is fitted to them, change with what was recorded of either, at a
// frequency over the cycle's: a column each.
Eigen::Matrix2cd ByRecorded(const std::vector<SharedEffect>& effects, double cycle_hz,
                            std::complex<double> s);

// What they add to the loop's delay, in radians of the cycle: their turn of its phase is taken
// back, so that the loop's delay is that of the cycle, and the flame's own is less by so much.
double TurnOfCycle(const std::vector<SharedEffect>& effects, double cycle_hz);

// ln of the Jacobian.
double LogJacobian(const RecordSpectra& record, const std::vector<SharedEffect>& effects);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_FORMS_SHARED_EFFECT_H_

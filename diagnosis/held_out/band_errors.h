// How far predictions of p and q fall short of what is possible, band by band.
//
// What a free smooth transfer from the other signal takes off a prediction's error could have been
// predicted. It is estimated in the neighbourhood of each bin, the bin itself left out, and what
// then remains is the ceiling, of which structures that are compared have one in common
// (common_ceiling.h).
#ifndef HOWL_DIAGNOSIS_HELD_OUT_BAND_ERRORS_H_
#define HOWL_DIAGNOSIS_HELD_OUT_BAND_ERRORS_H_

#include <Eigen/Core>
#include <complex>
#include <vector>

namespace howl {

// In a band of a record and one signal: sums of |e|^2 / S, S being the signal's own smoothed power.
struct BandErrors {
  double low_hz = 0.0;
  double high_hz = 0.0;
  double error = 0.0;
  double ceiling = 0.0;
  double spread = 0.0;  // what errors of the structure's parameters add to `error`, on average
};

// One record's bins, a row each.
struct PredictedSignals {
  double cycle_hz = 0.0;
  double bin_hz = 0.0;
  Eigen::VectorXd frequency_hz;
  Eigen::VectorXd share;  // what a bin counts for; nothing where it is masked
  Eigen::VectorXcd pressure;
  Eigen::VectorXcd heat_release;
  Eigen::VectorXd pressure_power;  // smoothed
  Eigen::VectorXd heat_release_power;
  Eigen::VectorXcd pressure_error;  // of the prediction from the other signal
  Eigen::VectorXcd heat_release_error;
};

// The errors of a bin's predictions from its residuals E = (E_A, E_B), W = Sigma^-1, and how these
// change with either of the recorded signals:
//
//   e_p = P - E[P | Q] = u^H W E / (u^H W u),   u = dE / dP;    e_q = Q - E[Q | P], u = dE / dQ
void SetPredictionErrors(const Eigen::Vector2cd& residuals, const Eigen::Matrix2cd& w,
                         const Eigen::Vector2cd& by_pressure,
                         const Eigen::Vector2cd& by_heat_release, Eigen::Index bin,
                         PredictedSignals* signals);

// The bands of p, then those of q. Their spread is nothing yet.
std::vector<BandErrors> ErrorsOverBands(const PredictedSignals& signals);

// Of errors of p, one column a draw: their mean power as far as a free transfer from q foretells
// it.
Eigen::VectorXd ForetoldPower(const Eigen::MatrixXcd& errors, const PredictedSignals& signals);

// Adds |moved - signals|^2 / S of the predictions' errors, times `weight`, to the bands' spread.
void AddSpread(const PredictedSignals& signals, const PredictedSignals& moved, double weight,
               std::vector<BandErrors>* bands);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_HELD_OUT_BAND_ERRORS_H_

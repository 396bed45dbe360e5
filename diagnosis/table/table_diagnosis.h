// The lag of the q sensor that published characteristics alone allow, without a record.
//
// A sensor that makes recorded q lag true q by lambda at the cycle f makes p seem to lead by as
// much, and q too small if it is a first-order low-pass. With Delta and g as published (the
// paper, table 2):
//
//   arg G(f) = Delta - lambda,    |G(f)| = g cos lambda
//   tau = (270 deg + Delta - lambda) / (360 deg f)                                   (3)
//   arg G(f2) = 90 deg + 360 deg tau f2  (mod 360 deg)         (1a) at a non-harmonic line f2
//
// lambda is admitted if for each experiment with a line some model within the limits fulfils all
// three, f2 being free within `line_sigmas` standard deviations of the line. The sensor is the same
// for all: tan(lambda) goes with f, lag_deg being that at the mean of the cycles' frequencies;
// negative where a compensation went too far.
//
// A two-mode G with positive coefficients is passive, |arg G| <= 90 degrees, so that in closed form
// lambda <= 270 deg + Delta - 900 deg f / f2 (for a line between 3 f and 4 f or so).
#ifndef HOWL_DIAGNOSIS_TABLE_TABLE_DIAGNOSIS_H_
#define HOWL_DIAGNOSIS_TABLE_TABLE_DIAGNOSIS_H_

#include <limits>
#include <string>
#include <vector>

#include "diagnosis/verdict/diagnosis_result.h"
#include "estimation/analysis/loop/experiment.h"
#include "estimation/analysis/spectra/statistics.h"
#include "model/loop/acoustics.h"

namespace howl {

struct TableLimits {
  int modes = 2;
  double harmonic_ratio = kPaperHarmonicRatio;
  double omega_min_hz = 0.0;
  double xi_min = 1e-3;
  double xi_max = 1.0;
  double M_max = std::numeric_limits<double>::infinity();
  double M_over_N_max = std::numeric_limits<double>::infinity();
  double line_sigmas = kNormal95;
};

struct LagInterval {
  bool any = false;  // false: the facts agree at no lag between -60 and 60 degrees
  double low_deg = 0.0;
  double high_deg = 0.0;
};

struct TableExperiment {
  std::string name;
  LagInterval lag;         // by this experiment alone, at the mean frequency
  double tau_s = 0.0;      // by (3), without a lag
  double tau_low_s = 0.0;  // over the lags that all admit
  double tau_high_s = 0.0;
};

struct TableDiagnosis {
  LagInterval lag;
  double mean_frequency_hz = 0.0;
  double cutoff_min_hz = 0.0;  // of a first-order sensor with the largest lag; infinite: none lags
  std::vector<TableExperiment> experiments;  // those with lines
  Diagnosis diagnosis;                       // verdict: unknown
};

// lag_deg: the lag of this experiment at its own cycle.
double DelayAtLag(const Experiment& experiment, double lag_deg);
bool AgreesAtLag(const Experiment& experiment, double lag_deg, const TableLimits& limits);

// At least one experiment must have a line.
TableDiagnosis DiagnoseTable(const std::vector<Experiment>& experiments, const TableLimits& limits);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_TABLE_TABLE_DIAGNOSIS_H_

// What several figures draw: frequency grids, decibels, phases, the flame that a slope belongs to.
#ifndef HOWL_IO_REPORT_FIGURES_CURVES_H_
#define HOWL_IO_REPORT_FIGURES_CURVES_H_

#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "io/report/report_input.h"

namespace howl {

std::vector<double> LinearGrid(double low, double high, int count);
std::vector<double> LogarithmicGrid(double low, double high, int count);

double Decibels(double ratio);  // 20 log10
double PhaseDeg(std::complex<double> value);

std::complex<double> AcousticsAt(const LoopModel& model, double frequency_hz);  // G(j 2 pi f)
std::complex<double> RateAt(const LoopModel& model, double frequency_hz);       // j 2 pi f G

// Half width of the 95 % interval; NaN where the error is not known.
double HalfWidth95(const Estimate& estimate);

// The record that shows the reference experiment: the measured one, or where there is none the
// simulated one.
struct ShownRecord {
  const NamedRecord* record = nullptr;
  bool simulated = false;
};
std::optional<ShownRecord> ReferenceRecord(const ReportInput& input);

// Flame slope of the reference: measured; simulate raises it where the loop gain would be below the
// config's least, since a cycle was observed.
double SimulatedSlope(const ReportInput& input, const MeasuredPoint& point, const LoopModel& model);

// Highest frequency of figures about the reference: beyond its third harmonic and the second mode.
double ShownFrequencyMax(double fundamental_hz);

}  // namespace howl

#endif  // HOWL_IO_REPORT_FIGURES_CURVES_H_

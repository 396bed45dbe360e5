// Curves that several figures draw: frequency grids, decibels, phases, and the flame of a slope.
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

// The record that shows the reference experiment: the measured one, or where there is none the
// simulated one.
struct ShownRecord {
  const NamedRecord* record = nullptr;
  bool simulated = false;
};
std::optional<ShownRecord> ReferenceRecord(const ReportInput& input);

// Phi'(0) that goes with the model at one experiment: as measured, whatever loop gain that makes.
// Where it was not measured, the slope that closes the loop at the measured frequency with gain
// one, as the flame's describing function does on a limit cycle.
double DrawnSlope(const MeasuredPoint& point, const LoopModel& model);

// Sentences, with a space before them, on the loop that howl simulate ran for an experiment; they
// are for captions of what is drawn from its record.
std::string SimulationRemark(const ReportInput& input, const std::string& experiment);

// Highest frequency of figures about the reference: beyond its third harmonic and the second mode.
double ShownFrequencyMax(double fundamental_hz);

}  // namespace howl

#endif  // HOWL_IO_REPORT_FIGURES_CURVES_H_

// A record made ready for the likelihood of its loop (whittle.h): both signals on one band of bins,
// and what the flame is driven by.
//
//   v = dp/dt, p or the integral of p (FlameInput), of recorded p up to twice the band's upper end
//   q(t) = sum_k c_k b_k(v(t - tau)) + noise
//
// Of p a flame does not see its sensor's noise, which a curve would mix into all frequencies, and
// foretell of q what is not there. So b_k are of v less that noise (DrivenWithout) as a loop that
// was fitted tells it (pressure_noise.h), and before one was without all that lies above the band.
// Beside them stands what they leave out of v, times the mean of d b_k / d v: about the cycle the
// answer to all of recorded p is F P, as the likelihood has it (whittle.h).
//
// b_k are cubic splines of v (flame_basis.h), combined so that over the band their spectra are
// orthogonal and as large as recorded q's. The band reaches from 0.15 to 6.4 of the cycle's
// frequency: below, slow flow rules the signals; above, the flame's harmonics are lost in noise.
//
// A residual is taken under the sine taper sin(pi n / N), which is zero at the record's ends: the
// difference of neighbouring bins of its transform, so that no filter's transient at the ends is
// left in it. Bin i stands in the middle of two of the transform's; under the taper neighbours are
// correlated by -1/2, so that each counts for 1 / 1.5 of an independent one: two thirds of all that
// the record holds, and as much less as samples of it were lost.
//
// Everything is without a unit: p and q over their root mean squares, frequencies over the cycle's.
#ifndef HOWL_ESTIMATION_RECORD_FIT_SPECTRA_RECORD_SPECTRA_H_
#define HOWL_ESTIMATION_RECORD_FIT_SPECTRA_RECORD_SPECTRA_H_

#include <Eigen/Core>
#include <cmath>
#include <complex>
#include <cstdint>
#include <functional>
#include <memory>
#include <numbers>

#include "estimation/analysis/spectra/record.h"
#include "estimation/record_fit/spectra/flame_functions.h"
#include "estimation/record_fit/spectra/slow_changes.h"
#include "model/numerics/smooth_length.h"

namespace howl {

inline constexpr double kSineTaperShare = 1.0 / 1.5;

enum class FlameInput : std::uint8_t { kPressureRate, kPressure, kVelocity };

// v's transfer from p at s = j f over the cycle's frequency: s, 1 or 1 / s.
std::complex<double> FlameInputResponse(FlameInput input, std::complex<double> s);

// Of s = j f over the cycle's frequency. Empty: 1.
using TransferFunction = std::function<std::complex<double>(std::complex<double> s)>;
inline std::complex<double> ValueAt(const TransferFunction& function, std::complex<double> s) {
  return function ? function(s) : 1.0;
}
TransferFunction Product(const TransferFunction& first, const TransferFunction& second);

// What stands beside a flame's curve: v is filtered by `before`, what the curve makes of it by
// `after`.
struct FlameFilters {
  TransferFunction before, after;

  std::complex<double> At(std::complex<double> s) const {
    return ValueAt(before, s) * ValueAt(after, s);
  }
};
FlameFilters Product(const FlameFilters& first, const FlameFilters& second);

// The units, and the flame's functions, that records of one operating point have in common.
struct RecordScale {
  static constexpr double kLowestOfCycle = 0.15;  // where the band begins

  double cycle_hz = 0.0;
  double pressure = 1.0;
  double heat_release = 1.0;
  double input_range = 0.0;  // largest |v|
  // Of the splines, one column each, and the deviation of each one's coefficient before the record
  // is seen (flame_functions.h).
  Eigen::MatrixXd functions;
  Eigen::VectorXd flame_deviation;

  // Of the cycle: delays without a unit over it are seconds.
  double AngularFrequency() const { return 2.0 * std::numbers::pi * cycle_hz; }
};

struct RecordSpectra {
  RecordScale scale;
  FlameInput flame_input = FlameInput::kPressureRate;
  FlameFilters filters;
  double sampling_hz = 0.0;
  double bin_hz = 0.0;
  Eigen::VectorXcd s;        // j f over the cycle's frequency
  Eigen::VectorXcd input;    // V: v's transfer from p, with the filters
  Eigen::VectorXd position;  // -1 .. 1 over the band, in log f
  // Of the transform, one more than there are bins: j f, P, Q, and b_k without delay, one column
  // each.
  Eigen::VectorXcd edge_s;
  Eigen::VectorXcd below;  // P from 0 to the band's lower end
  Eigen::VectorXcd pressure;
  Eigen::VectorXcd above;  // P from the band's upper end as far as the flame's input reaches
  Eigen::VectorXcd heat_release;
  Eigen::VectorXcd driving;  // of p, from 0 on, what the flame's curve is driven by
  Eigen::MatrixXcd flame;
  Eigen::VectorXd slopes;       // mean of d b_k / d v over the record
  Eigen::VectorXd rest_slopes;  // d b_k / d v at v = 0
  Eigen::VectorXd share;        // what each bin counts for
  // Power of the errors of samples that stand in the place of lost ones of p (draw_clipped.h),
  // under the taper, by bin; empty where none was lost.
  Eigen::VectorXd lost_pressure;
  // That were taken out of the record: noise that came in behind them was divided by them.
  TransferFunction pressure_instrument, heat_release_instrument;
  // The same of instruments that were known before, and are no part of the record.
  TransferFunction known_pressure_instrument, known_heat_release_instrument;
  SlowSignals slow;  // where they have been set
  // How the cycle's harmonics follow what drives the flame's curve (curve_exponents.h); empty where
  // no loop has told: as the answer itself does.
  Eigen::VectorXd curve_exponents;
  // A part that is enough to compare starts (middle_part.h); of a short record none.
  std::shared_ptr<const RecordSpectra> middle;

  Eigen::Index bins() const { return s.size(); }
  std::complex<double> InputAt(std::complex<double> at) const {
    return FlameInputResponse(flame_input, at) * filters.At(at);
  }
  Eigen::Index Samples() const { return std::lround(sampling_hz / bin_hz); }
  // Over the record's time, evenly: where its flame's functions are taken, however finely it was
  // sampled. Of what a curve makes only that is taken for the band's which lies beyond twice the
  // input's highest frequency. A Fourier transform of this length is fast.
  Eigen::Index Instants() const {
    return SmoothLengthFrom(2 * (driving.size() - 1) + below.size() + bins());
  }
  // What a state of one unit, that begins with the record, has in its spectrum but for 1 / s.
  double OneSample() const {
    const double samples = sampling_hz / bin_hz;
    return sampling_hz / scale.AngularFrequency() / std::sqrt(samples);
  }
};

// The record has both signals.
RecordSpectra MakeRecordSpectra(const Record& record, double cycle_hz, FlameInput input,
                                const FlamePrior& flame = {});
// The same record, or another part of it, in the units and with the flame's functions of `like`.
RecordSpectra MakeRecordSpectra(const Record& record, const RecordSpectra& like);

// The spectra of `of`'s draws of errors of p at the bins of `record`, which is made of it, under
// the taper, one column each.
Eigen::MatrixXcd PressureErrors(const Record& of, const RecordSpectra& record);

// With the flame's functions of p less this noise, over p's unit, one value a sample.
RecordSpectra DrivenWithout(RecordSpectra record, const Eigen::VectorXd& noise);

// With a flame that has these filters beside those of the record. One without a middle stays so.
RecordSpectra WithFilters(RecordSpectra record, const FlameFilters& filters);

// The same, where p was recorded through this instrument.
RecordSpectra WithoutPressureInstrument(RecordSpectra record, const TransferFunction& instrument,
                                        const FlameFilters& filters);

// A spectrum of the transform's bins under the taper.
inline Eigen::VectorXcd Tapered(const Eigen::VectorXcd& x) {
  return x.head(x.size() - 1) - x.tail(x.size() - 1);
}

// |x|^2, smoothed over `reach` bins to either side.
Eigen::VectorXd SmoothPower(const Eigen::VectorXcd& x, Eigen::Index reach);

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_SPECTRA_RECORD_SPECTRA_H_

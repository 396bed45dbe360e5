#include "estimation/record_fit/slow/slow_signals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "estimation/record_fit/loop/loop_residuals.h"
#include "estimation/record_fit/slow/modal_parts.h"
#include "estimation/record_fit/spectra/amplitude_about.h"
#include "estimation/record_fit/spectra/middle_part.h"
#include "estimation/record_fit/spectra/unitary_transform.h"

namespace howl {
namespace {

using C = std::complex<double>;

// About the cycle, over its frequency: what the amplitude is taken from.
constexpr double kNearCycle = 0.5;
// And as far as the cycle's lines rule both signals.
constexpr double kNearLine = 0.1;

bool IsNearCycle(C s, double reach) { return std::abs(s.imag() - 1.0) < reach; }

constexpr auto kPlain = [](C) { return 1.0; };
constexpr auto kRate = [](C s) { return s; };

constexpr std::array kMemories = {1.0, 2.5, 6.0};  // of the lags, in cycles

C LagAt(C s, double memory_cycles) {
  return 1.0 / (1.0 + 2.0 * std::numbers::pi * memory_cycles * s);
}

// Signals at the record's instants (record_spectra.h), from spectra on the edges of its bins.
class Instants {
 public:
  explicit Instants(const RecordSpectra& record)
      : record_(record),
        count_(record.Instants()),
        scale_(std::sqrt(static_cast<double>(count_) * record.bin_hz / record.sampling_hz)) {}

  template <typename Response>
  Eigen::VectorXd SignalOf(const Eigen::VectorXcd& edges, const Response& response) const {
    Eigen::VectorXcd spectrum = Eigen::VectorXcd::Zero(count_ / 2 + 1);
    for (Eigen::Index i = 0; i < edges.size(); ++i) {
      spectrum[record_.below.size() + i] = scale_ * edges[i] * C(response(record_.edge_s[i]));
    }
    return UnitarySignal(std::move(spectrum), count_);
  }
  Eigen::VectorXcd SpectrumOf(const Eigen::VectorXd& signal) const {
    return UnitarySpectrum(signal).segment(record_.below.size(), record_.edge_s.size()) / scale_;
  }
  Eigen::VectorXd Time(const DriftRange& drift) const {
    return Eigen::VectorXd::LinSpaced(count_, drift.from, drift.to);
  }
  // m of an amplitude, or of its square.
  Eigen::VectorXd LaggedAboutMean(const Eigen::VectorXd& of, double memory_cycles) const {
    Eigen::VectorXcd spectrum = UnitarySpectrum(of / of.mean());
    spectrum[0] = 0.0;
    const double bin = record_.bin_hz / record_.scale.cycle_hz;
    for (Eigen::Index k = 1; k < spectrum.size(); ++k) {
      spectrum[k] *= LagAt(C(0.0, bin * static_cast<double>(k)), memory_cycles);
    }
    return UnitarySignal(std::move(spectrum), count_);
  }

 private:
  const RecordSpectra& record_;
  Eigen::Index count_;
  double scale_;
};

C RatioAtCycle(const RecordSpectra& record) {
  C product = 0.0;
  double square = 0.0;
  for (Eigen::Index i = 0; i < record.edge_s.size(); ++i) {
    if (!IsNearCycle(record.edge_s[i], kNearLine)) continue;
    product += record.heat_release[i] * std::conj(record.pressure[i]);
    square += std::norm(record.pressure[i]);
  }
  return square > 0.0 ? product / square : 0.0;
}

// `rate`: a_1 x_1' over p, and `ratio` q over p, at the cycle.
Eigen::MatrixXcd OverPressure(const Eigen::VectorXcd& s, C rate, C ratio) {
  Eigen::MatrixXcd out = Eigen::MatrixXcd::Zero(s.size(), kSlowColumns);
  for (Eigen::Index i = 0; i < s.size(); ++i) {
    if (!IsNearCycle(s[i], kNearCycle)) continue;
    for (std::size_t j = 0; j < kMemories.size(); ++j) {
      const auto column = static_cast<Eigen::Index>(j);
      const C lag = LagAt(s[i] - C(0.0, 1.0), kMemories[j]);
      out(i, ColumnsOf(SlowChange::kDamping).first + column) = lag * rate;
      out(i, ColumnsOf(SlowChange::kDelay).first + column) = 0.5 * lag * s[i] * ratio;
      out(i, ColumnsOf(SlowChange::kGain).first + column) = -0.5 * lag * ratio;
    }
  }
  return out;
}

// q without the flame's noise, as far as it is known.
Eigen::VectorXcd GivenOut(const RecordSpectra& record, const LoopPoint* fitted) {
  if (fitted && fitted->flame.size() == record.flame.cols()) {
    return AnswerOfFlame(record, *fitted);
  }
  Eigen::VectorXcd out = record.heat_release;
  for (Eigen::Index i = 0; i < out.size(); ++i) {
    const double x = record.edge_s[i].imag();
    if (std::abs(x - std::max(std::round(x), 1.0)) > kNearLine) out[i] = 0.0;
  }
  return out;
}

C RateOverPressure(const LoopMode& mode) {
  const C s(0.0, 1.0);
  return std::hypot(mode.a, mode.b) * s / (mode.a * s + mode.b * mode.omega);
}

void SetAcousticSignals(const PointStructure& structure, const std::vector<LoopMode>& modes,
                        const DriftRange& drift, const Instants& instants,
                        const Eigen::VectorXd& square, RecordSpectra* record) {
  if (structure.AcousticChanges() == 0) return;
  Eigen::MatrixXcd& signals = record->slow.signals;
  std::vector<Eigen::VectorXd> of_square;
  if (structure.damping_follows_amplitude) {
    for (const double memory : kMemories) {
      of_square.push_back(instants.LaggedAboutMean(square, memory));
    }
  }
  for (const ModalPart& part : PartsOf(*record, modes)) {
    const auto add = [&](Eigen::Index column, double by, const Eigen::VectorXd& product) {
      signals.col(column) += by * part.share.cwiseProduct(instants.SpectrumOf(product));
    };
    const Eigen::VectorXd x_rate = instants.SignalOf(part.x, kRate);
    Eigen::Index column = ColumnsOf(SlowChange::kDamping).first;
    for (const Eigen::VectorXd& m : of_square) add(column++, part.omega, m.cwiseProduct(x_rate));
    if (!structure.frequency_drifts) continue;
    const Eigen::VectorXd turned = instants.SignalOf(part.x, kPlain) + part.lean * x_rate;
    add(ColumnsOf(SlowChange::kFrequency).first, part.omega * part.omega,
        instants.Time(drift).cwiseProduct(turned));
  }
}

void SetFlameSignals(const PointStructure& structure, const LoopPoint* fitted,
                     const Instants& instants, const Eigen::VectorXd& square,
                     RecordSpectra* record) {
  if (structure.FlameChanges() == 0) return;
  const Eigen::VectorXd amplitude = square.cwiseSqrt();
  const Eigen::VectorXcd given_out = GivenOut(*record, fitted);
  const Eigen::VectorXd heat_release = instants.SignalOf(given_out, kPlain);
  const Eigen::VectorXd heat_release_rate = instants.SignalOf(given_out, kRate);
  for (std::size_t j = 0; j < kMemories.size(); ++j) {
    const Eigen::VectorXd m = instants.LaggedAboutMean(amplitude, kMemories[j]);
    const auto set = [&](SlowChange change, const Eigen::VectorXd& product) {
      record->slow.signals.col(ColumnsOf(change).first + static_cast<Eigen::Index>(j)) =
          instants.SpectrumOf(product);
    };
    if (structure.delay_follows_amplitude) {
      set(SlowChange::kDelay, m.cwiseProduct(heat_release_rate));
    }
    if (structure.gain_follows_amplitude) set(SlowChange::kGain, -m.cwiseProduct(heat_release));
  }
}

}  // namespace

void SetSlowSignals(const PointStructure& structure, const LoopPoint* fitted,
                    const DriftRange& drift, RecordSpectra* record) {
  const std::vector<LoopMode> modes = fitted ? fitted->modes : std::vector<LoopMode>();
  record->slow.signals.setZero(record->edge_s.size(), kSlowColumns);
  const Instants instants(*record);
  const bool follow = structure.damping_follows_amplitude || structure.FlameChanges() > 0;
  const Eigen::VectorXd square =
      follow ? SquaredAmplitudeAbout(1.0, kNearCycle, record->pressure, *record)
             : Eigen::VectorXd();
  SetAcousticSignals(structure, modes, drift, instants, square, record);
  SetFlameSignals(structure, fitted, instants, square, record);
  const C ratio = RatioAtCycle(*record);
  const C of_mode = modes.empty() ? 1.0 : RateOverPressure(ModeOfCycle(modes));
  record->slow.of_pressure = OverPressure(record->s, of_mode, ratio);
  if (!record->middle) return;
  RecordSpectra middle = *record->middle;
  middle.slow.signals = ColumnsOfMiddle(*record, record->slow.signals);
  middle.slow.of_pressure = OverPressure(middle.s, of_mode, ratio);
  record->middle = std::make_shared<const RecordSpectra>(std::move(middle));
}

}  // namespace howl

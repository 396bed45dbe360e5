#include "estimation/record_fit/spectra/middle_part.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "estimation/record_fit/spectra/unitary_transform.h"
#include "model/numerics/smooth_length.h"

namespace howl {
namespace {

using C = std::complex<double>;

// Of the part's bins, at either end of the band, that are left out.
constexpr Eigen::Index kBesideBand = 2;
constexpr double kCycles = 100.0;
constexpr double kShare = 0.2;

class Middle {
 public:
  Middle(const RecordSpectra& record, Eigen::Index instants)
      : whole_(record.Instants()),
        instants_(instants),
        first_whole_(record.below.size()),
        bins_of_part_(static_cast<double>(whole_) / static_cast<double>(instants)) {
    const auto first = static_cast<double>(first_whole_) / bins_of_part_;
    const auto last = static_cast<double>(first_whole_ + record.bins()) / bins_of_part_;
    first_ = static_cast<Eigen::Index>(std::ceil(first)) + kBesideBand;
    edges_ = static_cast<Eigen::Index>(last) - kBesideBand - first_ + 1;
  }

  Eigen::Index first() const { return first_; }
  Eigen::Index bins() const { return edges_ - 1; }
  double bin_hz(const RecordSpectra& record) const { return record.bin_hz * bins_of_part_; }

  Eigen::MatrixXcd ColumnsOf(const Eigen::MatrixXcd& edges) const {
    Eigen::MatrixXcd out(edges_, edges.cols());
    for (Eigen::Index k = 0; k < edges.cols(); ++k) out.col(k) = Of(edges.col(k));
    return out;
  }
  Eigen::VectorXcd Of(const Eigen::Ref<const Eigen::VectorXcd>& edges) const {
    Eigen::VectorXcd spectrum = Eigen::VectorXcd::Zero(whole_ / 2 + 1);
    spectrum.segment(first_whole_, edges.size()) = edges;
    const Eigen::VectorXd signal = UnitarySignal(std::move(spectrum), whole_);
    return UnitarySpectrum(signal.segment((whole_ - instants_) / 2, instants_))
        .segment(first_, edges_);
  }

  // The whole record's at the bins that lie nearest to the part's.
  Eigen::VectorXd NearestOf(const Eigen::VectorXd& bins_of_whole) const {
    Eigen::VectorXd out(bins());
    for (Eigen::Index i = 0; i < bins(); ++i) {
      const double at = (static_cast<double>(first_ + i) + 0.5) * bins_of_part_ - 0.5;
      out[i] = bins_of_whole[std::clamp<Eigen::Index>(std::lround(at) - first_whole_, 0,
                                                      bins_of_whole.size() - 1)];
    }
    return out;
  }

 private:
  Eigen::Index whole_, instants_, first_whole_;
  double bins_of_part_;
  Eigen::Index first_ = 0;
  Eigen::Index edges_ = 0;
};

Eigen::Index InstantsOfMiddle(const RecordSpectra& record) {
  const double cycles = record.scale.cycle_hz / record.bin_hz;
  return SmoothLength(static_cast<Eigen::Index>(std::max(kCycles / cycles, kShare) *
                                                static_cast<double>(record.Instants())));
}

}  // namespace

Eigen::MatrixXcd ColumnsOfMiddle(const RecordSpectra& record, const Eigen::MatrixXcd& edges) {
  return Middle(record, InstantsOfMiddle(record)).ColumnsOf(edges);
}

void SetMiddle(RecordSpectra* of) {
  const RecordSpectra& record = *of;
  const Eigen::Index instants = InstantsOfMiddle(record);
  of->middle = nullptr;
  if (2 * instants > record.Instants()) return;
  const Middle middle(record, instants);
  RecordSpectra out;
  out.scale = record.scale;
  out.flame_input = record.flame_input;
  out.filters = record.filters;
  out.sampling_hz = record.sampling_hz;
  out.bin_hz = middle.bin_hz(record);
  out.pressure = middle.Of(record.pressure);
  out.heat_release = middle.Of(record.heat_release);
  out.flame = middle.ColumnsOf(record.flame);
  const double bin = out.bin_hz / out.scale.cycle_hz;
  const auto first = static_cast<double>(middle.first());
  const auto bins = static_cast<double>(middle.bins());
  out.edge_s = C(0.0, bin) * Eigen::VectorXd::LinSpaced(middle.bins() + 1, first, first + bins);
  out.s = out.edge_s.head(middle.bins()).array() + C(0.0, 0.5 * bin);
  out.input = out.s.unaryExpr([&](C s) { return out.InputAt(s); });
  // As the whole record has it, so that spectra keep their shape.
  const double low = record.s[0].imag();
  const double high = record.s[record.bins() - 1].imag();
  out.position = 2.0 * (out.s.imag().array() / low).log() / std::log(high / low) - 1.0;
  out.slopes = record.slopes;
  out.rest_slopes = record.rest_slopes;
  out.share = Eigen::VectorXd::Constant(middle.bins(), record.share[0]);
  if (record.lost_pressure.size() > 0) out.lost_pressure = middle.NearestOf(record.lost_pressure);
  out.pressure_instrument = record.pressure_instrument;
  out.heat_release_instrument = record.heat_release_instrument;
  out.known_pressure_instrument = record.known_pressure_instrument;
  out.known_heat_release_instrument = record.known_heat_release_instrument;
  of->middle = std::make_shared<const RecordSpectra>(std::move(out));
}

}  // namespace howl

#include "estimation/record_fit/loop/kept_loop.h"

#include <glog/logging.h>

#include <algorithm>
#include <complex>

#include "estimation/record_fit/loop/loop_lanes.h"
#include "estimation/record_fit/loop/slow_parts.h"
#include "estimation/record_fit/whittle/noise_shape.h"

namespace howl {
namespace {

using C = std::complex<double>;

void Leave(const Eigen::VectorXcd& signal, const Eigen::VectorXcd& answer, const C* factors,
           Eigen::VectorXcd* out) {
  out->resize(signal.size() - 1);
  SetLeft(signal.data(), answer.data(), factors, signal.size(), out->data());
}

}  // namespace

KeptLoop::KeptLoop(const RecordSpectra& record, const PointStructure& structure)
    : record_(record),
      structure_(structure),
      x_(record.s.imag()),
      edge_x_(record.edge_s.imag()),
      lines_(record.edge_s, std::max(structure.acoustic_lines, structure.flame_lines)),
      band_lines_(record.s, std::max(structure.acoustic_lines, structure.flame_lines)),
      flame_real_(record.flame.real()),
      flame_imag_(record.flame.imag()),
      modes_(static_cast<std::size_t>(structure.modes)),
      acoustic_heat_release_(record.heat_release),
      flame_heat_release_(record.heat_release) {
  CHECK(!structure.HasChanges() || record.slow.signals.cols() == kSlowColumns);
  for (const NoiseTerm& term : structure.noise) {
    noise_columns_.push_back(LogSpectrumColumns(term, record));
    noise_shapes_.push_back(NoiseShape(term, record));
    lost_power_.push_back(LostPower(term, record));
  }
  residuals_.spectra.resize(record.bins(), static_cast<Eigen::Index>(structure.noise.size()));
}

bool KeptLoop::Moved(const Eigen::VectorXd& parameters, Eigen::Index begin,
                     Eigen::Index count) const {
  return parameters_.size() == 0 ||
         parameters.segment(begin, count) != parameters_.segment(begin, count);
}

bool KeptLoop::MoveTo(const Eigen::VectorXd& parameters) {
  const Eigen::Index flame = record_.flame.cols();
  const bool modes = Moved(parameters, 0, structure_.Transfer());
  const bool late = Moved(parameters, structure_.FlameChange(flame), structure_.FlameChanges());
  const bool changes =
      late || Moved(parameters, structure_.AcousticChange(), structure_.AcousticChanges());
  const bool answer =
      modes || changes || Moved(parameters, structure_.Transfer(), structure_.Transients());
  const bool acoustic_lines =
      Moved(parameters, structure_.AcousticLine(), structure_.AcousticLines());
  const bool path = Moved(parameters, structure_.Delay(), structure_.Delays());
  const bool burning = Moved(parameters, structure_.Flame(), flame);
  const bool flame_lines = Moved(parameters, structure_.FlameLine(flame), structure_.FlameLines());
  point_ = ToPoint(structure_, flame, parameters);
  if (modes) MoveModes();
  if (changes && structure_.HasChanges()) MoveChanges();
  if (answer) MoveAnswer();
  if (acoustic_lines) {
    lines_.Factors(point_.acoustic_lines, &acoustic_factors_);
    band_lines_.Factors(point_.acoustic_lines, &band_acoustic_factors_);
  }
  if (answer || acoustic_lines) {
    Leave(record_.pressure, answer_, AcousticFactors(), &residuals_.acoustic);
  }
  if (path) SetPath(record_, structure_, point_, &path_);
  if (burning) {
    burning_.resize(record_.edge_s.size());
    burning_.real() = flame_real_ * point_.flame;
    burning_.imag() = flame_imag_ * point_.flame;
  }
  if (path || burning) {
    residuals_.f = record_.slopes.dot(point_.flame) * path_.at;
    arriving_.resize(burning_.size());
    SetProducts(path_.edge_at.data(), burning_.data(), burning_.size(), arriving_.data());
  }
  if (flame_lines) {
    lines_.Factors(point_.flame_lines, &flame_factors_);
    band_lines_.Factors(point_.flame_lines, &band_flame_factors_);
  }
  if (HasLines() && (acoustic_lines || flame_lines)) {
    residuals_.line_factors.resize(record_.bins());
    SetProducts(band_acoustic_factors_.data(), band_flame_factors_.data(), record_.bins(),
                residuals_.line_factors.data());
  }
  if (path || burning || flame_lines || late) {
    Leave(flame_heat_release_, arriving_, FlameFactors(), &residuals_.flame);
  }
  Eigen::Index next = structure_.Noise(flame);
  for (std::size_t j = 0; j < structure_.noise.size(); ++j) {
    const Eigen::Index coefficients = structure_.noise[j].coefficients;
    if (Moved(parameters, next, coefficients)) {
      auto spectrum = residuals_.spectra.col(static_cast<Eigen::Index>(j));
      spectrum = (noise_columns_[j] * point_.noise[j]).array().exp() * noise_shapes_[j].array();
      if (lost_power_[j].size() > 0) spectrum += lost_power_[j];
    }
    next += coefficients;
  }
  residuals_.background_ratio = point_.background_ratio;
  parameters_ = parameters;
  return modes || path || burning;
}

void KeptLoop::MoveModes() {
  residuals_.r.setZero(record_.bins());
  for (std::size_t k = 0; k < modes_.size(); ++k) {
    const LoopMode& mode = point_.modes[k];
    ModeGrids& grids = modes_[k];
    grids.over.resize(x_.size());
    grids.edge_over.resize(edge_x_.size());
    SetResonance(mode, x_.data(), x_.size(), grids.over.data());
    SetResonance(mode, edge_x_.data(), edge_x_.size(), grids.edge_over.data());
    AddTransfer(mode, x_.data(), grids.over.data(), x_.size(), residuals_.r.data());
  }
}

void KeptLoop::MoveChanges() {
  acoustic_heat_release_ = HeatReleaseOfAcoustics(record_, point_);
  flame_heat_release_ = HeatReleaseOfFlame(record_, point_);
  residuals_.slow = SlowFeedback(record_, point_);
}

void KeptLoop::MoveAnswer() {
  answer_.setZero(record_.edge_s.size());
  for (std::size_t k = 0; k < modes_.size(); ++k) {
    AddAnswer(point_.modes[k], edge_x_.data(), acoustic_heat_release_.data(),
              modes_[k].edge_over.data(), answer_.size(), answer_.data());
  }
}

}  // namespace howl

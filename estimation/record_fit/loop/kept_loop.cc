#include "estimation/record_fit/loop/kept_loop.h"

#include <glog/logging.h>

#include <algorithm>
#include <complex>

#include "estimation/record_fit/loop/mode_sums.h"
#include "estimation/record_fit/loop/slow_parts.h"
#include "estimation/record_fit/whittle/noise_shape.h"
#include "model/numerics/complex_products.h"

namespace howl {
namespace {

using C = std::complex<double>;

// The taper's differences of a signal less an answer times its lines' factors.
void Leave(const Eigen::VectorXcd& signal, const Eigen::VectorXcd& answer,
           const Eigen::VectorXcd& factors, Eigen::VectorXcd* out) {
  out->resize(signal.size() - 1);
  C before = signal[0] - Times(answer[0], factors[0]);
  for (Eigen::Index i = 0; i < out->size(); ++i) {
    const C next = signal[i + 1] - Times(answer[i + 1], factors[i + 1]);
    (*out)[i] = before - next;
    before = next;
  }
}

}  // namespace

KeptLoop::KeptLoop(const RecordSpectra& record, const PointStructure& structure)
    : record_(record),
      structure_(structure),
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
    Leave(record_.pressure, answer_, acoustic_factors_, &residuals_.acoustic);
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
    for (Eigen::Index i = 0; i < burning_.size(); ++i) {
      arriving_[i] = Times(path_.edge_at[i], burning_[i]);
    }
  }
  if (flame_lines) {
    lines_.Factors(point_.flame_lines, &flame_factors_);
    band_lines_.Factors(point_.flame_lines, &band_flame_factors_);
  }
  if (HasLines() && (acoustic_lines || flame_lines)) {
    residuals_.line_factors.resize(record_.bins());
    for (Eigen::Index i = 0; i < record_.bins(); ++i) {
      residuals_.line_factors[i] = Times(band_acoustic_factors_[i], band_flame_factors_[i]);
    }
  }
  if (path || burning || flame_lines || late) {
    Leave(flame_heat_release_, arriving_, flame_factors_, &residuals_.flame);
  }
  Eigen::Index next = structure_.Noise(flame);
  for (std::size_t j = 0; j < structure_.noise.size(); ++j) {
    const Eigen::Index coefficients = structure_.noise[j].coefficients;
    if (Moved(parameters, next, coefficients)) {
      residuals_.spectra.col(static_cast<Eigen::Index>(j)) =
          (noise_columns_[j] * point_.noise[j]).array().exp() * noise_shapes_[j].array();
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
    SetResonance(mode, record_.s, &modes_[k].over);
    SetResonance(mode, record_.edge_s, &modes_[k].edge_over);
    for (Eigen::Index i = 0; i < record_.bins(); ++i) {
      residuals_.r[i] +=
          Times(C(mode.b * mode.omega, mode.a * record_.s[i].imag()), modes_[k].over[i]);
    }
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
    const LoopMode& mode = point_.modes[k];
    for (Eigen::Index i = 0; i < answer_.size(); ++i) {
      const double x = record_.edge_s[i].imag();
      answer_[i] += Times(Times(C(mode.b * mode.omega, mode.a * x), acoustic_heat_release_[i]) +
                              C(mode.h * mode.omega, mode.g * x),
                          modes_[k].edge_over[i]);
    }
  }
}

}  // namespace howl

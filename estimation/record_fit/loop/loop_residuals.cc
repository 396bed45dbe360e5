#include "estimation/record_fit/loop/loop_residuals.h"

#include <complex>
#include <cstddef>
#include <utility>

#include "estimation/record_fit/loop/line_shapes.h"
#include "estimation/record_fit/loop/mode_slopes.h"
#include "estimation/record_fit/loop/slow_parts.h"
#include "estimation/record_fit/whittle/noise_shape.h"
#include "model/numerics/complex_products.h"

namespace howl {
namespace {

using C = std::complex<double>;

// Of edges: as many turns one after the other err by a hundred roundings.
constexpr Eigen::Index kAnchors = 64;

Eigen::VectorXcd Transfer(const LoopPoint& point, const Eigen::VectorXcd& s) {
  return s.unaryExpr([&](C each) { return AcousticTransfer(point, each); });
}

Eigen::MatrixXcd TaperedColumns(const Eigen::MatrixXcd& x) {
  return x.topRows(x.rows() - 1) - x.bottomRows(x.rows() - 1);
}

Eigen::VectorXcd LineFactors(const Eigen::VectorXcd& s, const Eigen::VectorXcd& errors) {
  Eigen::VectorXcd out;
  LineShapes(s, errors.size()).Factors(errors, &out);
  return out;
}

// R Q and what the record's ends leave, before the taper.
Eigen::VectorXcd AnswerOfAcoustics(const RecordSpectra& record, const LoopPoint& point) {
  LoopPoint ends = point;
  for (LoopMode& mode : ends.modes) {
    mode.a = mode.g;
    mode.b = mode.h;
  }
  return Transfer(point, record.edge_s).cwiseProduct(HeatReleaseOfAcoustics(record, point)) +
         Transfer(ends, record.edge_s);
}

Eigen::MatrixXcd TransferColumns(const PointStructure& structure, const LoopPoint& point,
                                 const Eigen::VectorXcd& s) {
  Eigen::MatrixXcd out = Eigen::MatrixXcd::Zero(s.size(), structure.Acoustics());
  for (Eigen::Index k = 0; k < structure.modes; ++k) {
    for (Eigen::Index i = 0; i < s.size(); ++i) {
      ForEachSlope(structure, point, k, s[i],
                   [&](Eigen::Index j, C of_r, C) { out(i, j) += of_r; });
    }
  }
  return out;
}

// Of R Q + T.
Eigen::MatrixXcd PressureColumns(const PointStructure& structure, const LoopPoint& point,
                                 const Eigen::VectorXcd& s, const Eigen::VectorXcd& heat_release) {
  Eigen::MatrixXcd out = Eigen::MatrixXcd::Zero(s.size(), structure.Acoustics());
  for (Eigen::Index k = 0; k < structure.modes; ++k) {
    for (Eigen::Index i = 0; i < s.size(); ++i) {
      ForEachSlope(structure, point, k, s[i], [&](Eigen::Index j, C of_r, C of_t) {
        out(i, j) += Times(of_r, heat_release[i]) + of_t;
      });
    }
  }
  return out;
}

void SetSlowColumns(const RecordSpectra& record, const PointStructure& structure,
                    const LoopPoint& point, Eigen::MatrixXcd* of_pressure) {
  const Eigen::VectorXcd r = Transfer(point, record.edge_s);
  Eigen::Index next = structure.AcousticChange();
  ForEachColumn(structure, kAcousticChanges, [&](Eigen::Index column) {
    of_pressure->col(next++) = -r.cwiseProduct(record.slow.signals.col(column));
  });
}

}  // namespace

Eigen::VectorXcd AnswerOfFlame(const RecordSpectra& record, const LoopPoint& point) {
  return point.path.At(record.edge_s).cwiseProduct(record.flame * point.flame);
}

LoopResiduals TransfersOf(const RecordSpectra& record, const LoopPoint& point) {
  LoopResiduals out;
  out.r = Transfer(point, record.s);
  const double slope = record.slopes.dot(point.flame);
  out.f = slope * point.path.At(record.s).cwiseProduct(record.input);
  if (point.acoustic_lines.size() + point.flame_lines.size() > 0) {
    out.line_factors = LineFactors(record.s, point.acoustic_lines)
                           .cwiseProduct(LineFactors(record.s, point.flame_lines));
  }
  if (!point.changes.isZero(0.0)) out.slow = SlowFeedback(record, point);
  return out;
}

LoopResiduals ResidualsOf(const RecordSpectra& record, const PointStructure& structure,
                          const LoopPoint& point) {
  LoopResiduals out = TransfersOf(record, point);
  out.acoustic = Tapered(record.pressure -
                         AnswerOfAcoustics(record, point)
                             .cwiseProduct(LineFactors(record.edge_s, point.acoustic_lines)));
  out.flame = Tapered(
      HeatReleaseOfFlame(record, point) -
      AnswerOfFlame(record, point).cwiseProduct(LineFactors(record.edge_s, point.flame_lines)));
  out.spectra.resize(record.bins(), static_cast<Eigen::Index>(structure.noise.size()));
  for (std::size_t j = 0; j < structure.noise.size(); ++j) {
    auto spectrum = out.spectra.col(static_cast<Eigen::Index>(j));
    spectrum = NoiseSpectrum(structure.noise[j], record, point.noise[j]);
    const Eigen::VectorXd lost = LostPower(structure.noise[j], record);
    if (lost.size() > 0) spectrum += lost;
  }
  out.background_ratio = point.background_ratio;
  return out;
}

void SetPath(const RecordSpectra& record, const PointStructure& structure, const LoopPoint& point,
             PathOnGrids* out) {
  const auto parameters = static_cast<std::size_t>(structure.Delays());
  const auto set = [&](const PathSlopes& slopes, Eigen::Index i, Eigen::VectorXcd* at, auto* by) {
    (*at)[i] = slopes.at;
    for (std::size_t k = 0; k < parameters; ++k) (*by)[k][i] = slopes.by[k];
  };
  const Eigen::Index bins = record.bins();
  out->at.resize(bins);
  out->edge_at.resize(bins + 1);
  for (std::size_t k = 0; k < parameters; ++k) {
    out->by[k].resize(bins);
    out->edge_by[k].resize(bins + 1);
  }
  // Bins stand between the edges, all at one distance.
  const FlamePath& path = point.path;
  const PathTurns half = path.TurnsAt(record.s[0] - record.edge_s[0]);
  PathTurns turns;
  for (Eigen::Index i = 0; i <= bins; ++i) {
    turns = i % kAnchors == 0 ? path.TurnsAt(record.edge_s[i]) : turns * half;
    set(path.WithSlopes(record.edge_s[i], turns), i, &out->edge_at, &out->edge_by);
    if (i == bins) break;
    turns = turns * half;
    PathSlopes driven = path.WithSlopes(record.s[i], turns);
    driven.at = Times(driven.at, record.input[i]);
    set(driven, i, &out->at, &out->by);
  }
}

LoopDerivatives DerivativesOf(const RecordSpectra& record, const PointStructure& structure,
                              const LoopPoint& point) {
  PathOnGrids path;
  SetPath(record, structure, point, &path);
  return DerivativesOf(record, structure, point, path);
}

LoopDerivatives DerivativesOf(const RecordSpectra& record, const PointStructure& structure,
                              const LoopPoint& point, const PathOnGrids& path) {
  LoopDerivatives out;
  out.r = TransferColumns(structure, point, record.s);
  Eigen::MatrixXcd of_pressure =
      PressureColumns(structure, point, record.edge_s, HeatReleaseOfAcoustics(record, point));
  if (structure.HasChanges()) SetSlowColumns(record, structure, point, &of_pressure);
  if (structure.acoustic_lines > 0) {
    of_pressure = LineFactors(record.edge_s, point.acoustic_lines).asDiagonal() * of_pressure;
    of_pressure.middleCols(structure.AcousticLine(), structure.AcousticLines()) =
        LineShapes(record.edge_s, structure.acoustic_lines)
            .Columns(AnswerOfAcoustics(record, point));
  }
  out.acoustic = -TaperedColumns(of_pressure);
  const Eigen::Index flame = point.flame.size();
  const Eigen::Index delays = structure.Delays();
  const Eigen::Index of_flame = delays + flame + structure.FlameLines() + structure.FlameChanges();
  out.f.setZero(record.bins(), of_flame);
  const double slope = record.slopes.dot(point.flame);
  for (Eigen::Index k = 0; k < delays; ++k) {
    out.f.col(k) = slope * path.at.cwiseProduct(path.by[static_cast<std::size_t>(k)]);
  }
  out.f.middleCols(delays, flame) = path.at * record.slopes.transpose();
  const Eigen::VectorXcd factors = LineFactors(record.edge_s, point.flame_lines);
  const Eigen::MatrixXcd delayed = path.edge_at.cwiseProduct(factors).asDiagonal() * record.flame;
  const Eigen::VectorXcd answer = delayed * point.flame;
  out.flame.resize(record.bins(), of_flame);
  for (Eigen::Index k = 0; k < delays; ++k) {
    out.flame.col(k) =
        -TaperedColumns(answer.cwiseProduct(path.edge_by[static_cast<std::size_t>(k)]));
  }
  out.flame.middleCols(delays, flame) = -TaperedColumns(delayed);
  out.flame.middleCols(delays + flame, structure.FlameLines()) = -TaperedColumns(
      LineShapes(record.edge_s, structure.flame_lines).Columns(answer.cwiseQuotient(factors)));
  Eigen::Index next = of_flame - structure.FlameChanges();
  ForEachColumn(structure, kFlameChanges, [&](Eigen::Index column) {
    out.flame.col(next++) = TaperedColumns(record.slow.signals.col(column));
  });
  for (std::size_t j = 0; j < structure.noise.size(); ++j) {
    const NoiseTerm& term = structure.noise[j];
    Eigen::MatrixXd columns = LogSpectrumColumns(term, record);
    const Eigen::VectorXd lost = LostPower(term, record);
    if (lost.size() > 0) {
      const Eigen::ArrayXd known = NoiseSpectrum(term, record, point.noise[j]).array();
      columns.array().colwise() *= known / (known + lost.array());
    }
    out.log_spectra.push_back(std::move(columns));
  }
  return out;
}

}  // namespace howl

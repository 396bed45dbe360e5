// A known flame's curve in the functions of a record's likelihood (record_spectra.h).
#ifndef HOWL_TESTS_ESTIMATION_JOINT_RECORDS_KNOWN_FLAME_H_
#define HOWL_TESTS_ESTIMATION_JOINT_RECORDS_KNOWN_FLAME_H_

#include <Eigen/Core>
#include <Eigen/QR>
#include <cmath>
#include <functional>
#include <numbers>

#include "estimation/record_fit/spectra/flame_basis.h"
#include "estimation/record_fit/spectra/record_spectra.h"

namespace howl {

// The coefficients nearest to q = curve(v), in units of the rig, over the range of v that the
// record reached; no constant in q counts.
inline Eigen::VectorXd KnownFlame(const RecordSpectra& record,
                                  const std::function<double(double)>& curve) {
  const double turn = 2.0 * std::numbers::pi * record.scale.cycle_hz;
  double unit = record.scale.pressure;  // of v
  if (record.flame_input == FlameInput::kPressureRate) unit *= turn;
  if (record.flame_input == FlameInput::kVelocity) unit /= turn;
  const Eigen::VectorXd v =
      Eigen::VectorXd::LinSpaced(201, -record.scale.input_range, record.scale.input_range);
  const Eigen::MatrixXd functions =
      FlameBasis(record.scale.input_range).Columns(v) * record.scale.functions;
  Eigen::MatrixXd columns(v.size(), functions.cols() + 1);
  columns << functions, Eigen::VectorXd::Ones(v.size());
  const Eigen::VectorXd q =
      v.unaryExpr([&](double x) { return curve(unit * x) / record.scale.heat_release; });
  const Eigen::VectorXd solved = columns.colPivHouseholderQr().solve(q);
  return solved.head(functions.cols());
}

}  // namespace howl

#endif  // HOWL_TESTS_ESTIMATION_JOINT_RECORDS_KNOWN_FLAME_H_

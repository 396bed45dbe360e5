// The shapes that the errors at the cycle's multiples have on a record's frequencies
// (loop_point.h), which depend on the record alone:
//
//   W_h = (s Re d_h - h Im d_h) o_h,   o_h = 2 r / (s^2 + 2 r s + h^2),   s = j x
#ifndef HOWL_ESTIMATION_RECORD_FIT_LOOP_LINE_SHAPES_H_
#define HOWL_ESTIMATION_RECORD_FIT_LOOP_LINE_SHAPES_H_

#include <Eigen/Core>

namespace howl {

class LineShapes {
 public:
  LineShapes(const Eigen::VectorXcd& s, Eigen::Index lines);

  // 1 + the errors of all lines.
  void Factors(const Eigen::VectorXcd& errors, Eigen::VectorXcd* out) const;
  // What real and then imaginary parts of the errors add to an answer.
  Eigen::MatrixXcd Columns(const Eigen::VectorXcd& answer) const;
  // The slopes by real and then imaginary parts of `lines` errors of a sum over frequencies of the
  // real part of weight times factor.
  Eigen::VectorXd Slope(const Eigen::VectorXcd& weights, Eigen::Index lines) const;

 private:
  Eigen::VectorXd x_;
  Eigen::MatrixXd real_, imag_;  // of o_h, one column a line
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_LOOP_LINE_SHAPES_H_

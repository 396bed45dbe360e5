// Eigenvalues, singular values and linear systems of dense real matrices, by Eigen. Its solvers are
// templates of many thousand lines: here each is compiled once, and not in every file that asks for
// one. Matrices are of any size, and no argument may hold a NaN.
#ifndef HOWL_MODEL_NUMERICS_DENSE_ALGEBRA_H_
#define HOWL_MODEL_NUMERICS_DENSE_ALGEBRA_H_

#include <Eigen/Core>

namespace howl {

// All n eigenvalues of an n x n matrix, by the QR algorithm.
Eigen::VectorXcd Eigenvalues(const Eigen::MatrixXd& a);

// x with a x = b, by LU with partial pivoting. Not finite where a is singular.
Eigen::VectorXd SolveByLu(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

// x with a x = b for a symmetric a, of which the lower half is read, by L D L^T with pivoting.
Eigen::MatrixXd SolveSymmetric(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

// Whether all eigenvalues of a symmetric a, of which the lower half is read, are above `least`, as
// far as rounding lets Cholesky's factors tell.
bool HasEigenvaluesAbove(double least, Eigen::MatrixXd a);

struct SymmetricEigen {
  Eigen::VectorXd values;   // ascending
  Eigen::MatrixXd vectors;  // one a column
};

// a x = value x for a symmetric a, of which the lower half is read; vectors have length one.
SymmetricEigen EigenOfSymmetric(const Eigen::MatrixXd& a);

// a x = value b x for symmetric a and positive definite b; x^T b x = 1.
SymmetricEigen GeneralizedEigen(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

struct SingularValues {
  Eigen::VectorXd values;  // descending
  Eigen::MatrixXd u;       // m x min(m, n)
  Eigen::MatrixXd v;       // n x n
};

// a = u diag(values) v^T for an m x n matrix, by one-sided Jacobi rotations, which keep small
// singular values accurate.
SingularValues DecomposeSingular(const Eigen::MatrixXd& a);

// An orthonormal basis of the columns of a full-rank matrix with no fewer rows than columns, by
// Householder's reflections.
Eigen::MatrixXd OrthonormalColumns(const Eigen::MatrixXd& a);

}  // namespace howl

#endif  // HOWL_MODEL_NUMERICS_DENSE_ALGEBRA_H_

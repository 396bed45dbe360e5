// Symmetric positive definite systems of a few hundred unknowns.
#ifndef HOWL_RIG_DENSE_H_
#define HOWL_RIG_DENSE_H_

#include <cstddef>
#include <vector>

namespace rig {

// Row-major square matrix.
class Square {
 public:
  explicit Square(std::size_t size) : size_(size), values_(size * size, 0.0) {}
  std::size_t size() const { return size_; }
  double& operator()(std::size_t i, std::size_t j) { return values_[i * size_ + j]; }
  double operator()(std::size_t i, std::size_t j) const { return values_[i * size_ + j]; }
  double* row(std::size_t i) { return values_.data() + i * size_; }

 private:
  std::size_t size_;
  std::vector<double> values_;
};

// x with matrix x = right, by Cholesky; only the lower triangle is read. Throws std::runtime_error
// where the matrix is not positive definite.
std::vector<double> SolveSymmetric(Square matrix, std::vector<double> right);

}  // namespace rig

#endif  // HOWL_RIG_DENSE_H_

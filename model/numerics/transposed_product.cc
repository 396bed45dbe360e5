#include "model/numerics/transposed_product.h"

#include <glog/logging.h>

#include <algorithm>
#include <cstddef>

#include "model/numerics/complex_lanes.h"

namespace howl {
namespace {

// Columns of a and of b that are taken at once: their sums stay in registers.
constexpr std::ptrdiff_t kOfA = 4;
constexpr std::ptrdiff_t kOfB = 2;

struct Columns {
  const double* first = nullptr;
  std::ptrdiff_t stride = 0;
  std::ptrdiff_t count = 0;

  // Beyond the last column, the last: what comes of it is not used.
  HOWL_IN_CLONES const double* At(std::ptrdiff_t column) const {
    return first + stride * (column < count ? column : count - 1);
  }
};

static_assert(kOfA * kOfB == kLanes);

// Sums over the lanes of each of eight, in its lane.
HOWL_IN_CLONES EightLanes SumsOf(const EightLanes (&of)[kLanes]) {
  EightLanes halves[4];
  for (std::ptrdiff_t k = 0; k < 4; ++k) {
    halves[k] = __builtin_shufflevector(of[2 * k], of[2 * k + 1], 0, 1, 2, 3, 8, 9, 10, 11) +
                __builtin_shufflevector(of[2 * k], of[2 * k + 1], 4, 5, 6, 7, 12, 13, 14, 15);
  }
  EightLanes quarters[2];
  for (std::ptrdiff_t k = 0; k < 2; ++k) {
    quarters[k] =
        __builtin_shufflevector(halves[2 * k], halves[2 * k + 1], 0, 1, 4, 5, 8, 9, 12, 13) +
        __builtin_shufflevector(halves[2 * k], halves[2 * k + 1], 2, 3, 6, 7, 10, 11, 14, 15);
  }
  return __builtin_shufflevector(quarters[0], quarters[1], 0, 2, 4, 6, 8, 10, 12, 14) +
         __builtin_shufflevector(quarters[0], quarters[1], 1, 3, 5, 7, 9, 11, 13, 15);
}

HOWL_IN_CLONES void Block(const Columns& a, std::ptrdiff_t i, const Columns& b, std::ptrdiff_t j,
                          std::ptrdiff_t rows, double (&sums)[kOfA][kOfB]) {
  const double* const of_a[kOfA] = {a.At(i), a.At(i + 1), a.At(i + 2), a.At(i + 3)};
  const double* const of_b[kOfB] = {b.At(j), b.At(j + 1)};
  EightLanes lanes[kLanes] = {};
  std::ptrdiff_t row = 0;
  for (; row + kLanes <= rows; row += kLanes) {
    const EightLanes b0 = Lanes<EightLanes>::Load(of_b[0] + row);
    const EightLanes b1 = Lanes<EightLanes>::Load(of_b[1] + row);
    for (std::ptrdiff_t k = 0; k < kOfA; ++k) {
      const EightLanes each = Lanes<EightLanes>::Load(of_a[k] + row);
      lanes[kOfB * k] += each * b0;
      lanes[kOfB * k + 1] += each * b1;
    }
  }
  Lanes<EightLanes>::Store(SumsOf(lanes), &sums[0][0]);
  for (std::ptrdiff_t k = 0; k < kOfA; ++k) {
    for (std::ptrdiff_t l = 0; l < kOfB; ++l) {
      for (std::ptrdiff_t left = row; left < rows; ++left) {
        sums[k][l] += of_a[k][left] * of_b[l][left];
      }
    }
  }
}

HOWL_VECTOR_CLONES
void AddProducts(const Columns& a, const Columns& b, std::ptrdiff_t rows, bool upper, double* c,
                 std::ptrdiff_t stride) {
  for (std::ptrdiff_t j = 0; j < b.count; j += kOfB) {
    for (std::ptrdiff_t i = 0; i < a.count; i += kOfA) {
      if (upper && i >= j + kOfB) break;
      double sums[kOfA][kOfB];
      Block(a, i, b, j, rows, sums);
      for (std::ptrdiff_t l = 0; l < kOfB && j + l < b.count; ++l) {
        for (std::ptrdiff_t k = 0; k < kOfA && i + k < a.count; ++k) {
          if (!upper || i + k <= j + l) c[i + k + stride * (j + l)] += sums[k][l];
        }
      }
    }
  }
}

Columns ColumnsOf(const Eigen::Ref<const Eigen::MatrixXd>& of) {
  return {of.data(), of.outerStride(), of.cols()};
}

void Add(const Eigen::Ref<const Eigen::MatrixXd>& a, const Eigen::Ref<const Eigen::MatrixXd>& b,
         bool upper, Eigen::Ref<Eigen::MatrixXd>& c) {
  CHECK_EQ(a.rows(), b.rows());
  CHECK_EQ(c.rows(), a.cols());
  CHECK_EQ(c.cols(), b.cols());
  AddProducts(ColumnsOf(a), ColumnsOf(b), a.rows(), upper, c.data(), c.outerStride());
}

}  // namespace

void AddTransposedProduct(const Eigen::Ref<const Eigen::MatrixXd>& a,
                          const Eigen::Ref<const Eigen::MatrixXd>& b,
                          Eigen::Ref<Eigen::MatrixXd> c) {
  Add(a, b, false, c);
}

void AddUpperOfTransposedProduct(const Eigen::Ref<const Eigen::MatrixXd>& a,
                                 const Eigen::Ref<const Eigen::MatrixXd>& b,
                                 Eigen::Ref<Eigen::MatrixXd> c) {
  CHECK_EQ(c.rows(), c.cols());
  Add(a, b, true, c);
}

}  // namespace howl

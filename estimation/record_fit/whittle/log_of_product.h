// A sum of w ln x over many positive x: factors that have one weight are multiplied before a
// logarithm is taken, as long as their product is well within the range of a double.
#ifndef HOWL_ESTIMATION_RECORD_FIT_WHITTLE_LOG_OF_PRODUCT_H_
#define HOWL_ESTIMATION_RECORD_FIT_WHITTLE_LOG_OF_PRODUCT_H_

#include <cmath>

namespace howl {

class LogOfProduct {
 public:
  void Multiply(double x, double weight) {
    if (weight != weight_) {
      Take();
      weight_ = weight;
    }
    // A factor may itself be far beyond the range in which the product stays.
    if (!(x > kLeast && x < 1.0 / kLeast)) {
      sum_ += weight * std::log(x);
      return;
    }
    product_ *= x;
    if (product_ < kLeast || product_ > 1.0 / kLeast) Take();
  }

  double Sum() {
    Take();
    return sum_;
  }

 private:
  static constexpr double kLeast = 1e-140;

  void Take() {
    sum_ += weight_ * std::log(product_);
    product_ = 1.0;
  }

  double sum_ = 0.0;
  double weight_ = 0.0;
  double product_ = 1.0;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_WHITTLE_LOG_OF_PRODUCT_H_

#include "model/loop/flame_table.h"

#include <glog/logging.h>

#include <algorithm>
#include <utility>

namespace howl {

FlameTable::FlameTable(std::vector<double> u, std::vector<double> q)
    : u_(std::move(u)), q_(std::move(q)), slope_(u_.size(), 0.0) {
  CHECK_GE(u_.size(), 2u);
  CHECK_EQ(u_.size(), q_.size());
  for (std::size_t i = 0; i + 1 < u_.size(); ++i) {
    CHECK_LT(u_[i], u_[i + 1]);
    CHECK_LE(q_[i], q_[i + 1]);
  }
  // At both ends the slope is zero, as beyond them.
  for (std::size_t i = 1; i + 1 < u_.size(); ++i) {
    const double before = u_[i] - u_[i - 1], after = u_[i + 1] - u_[i];
    const double rise_before = (q_[i] - q_[i - 1]) / before;
    const double rise_after = (q_[i + 1] - q_[i]) / after;
    if (!(rise_before > 0.0 && rise_after > 0.0)) continue;
    const double weight = (before + 2.0 * after) / (3.0 * (before + after));
    slope_[i] = rise_before * rise_after / (weight * rise_after + (1.0 - weight) * rise_before);
  }
}

std::size_t FlameTable::IntervalOf(double u) const {
  const auto next = std::upper_bound(u_.begin() + 1, u_.end() - 1, u);
  return static_cast<std::size_t>(next - u_.begin()) - 1;
}

double FlameTable::Value(double u) const {
  if (u <= u_.front()) return q_.front();
  if (u >= u_.back()) return q_.back();
  const std::size_t i = IntervalOf(u);
  const double h = u_[i + 1] - u_[i];
  const double t = (u - u_[i]) / h, r = 1.0 - t;
  return r * r * (1.0 + 2.0 * t) * q_[i] + t * t * (1.0 + 2.0 * r) * q_[i + 1] +
         h * t * r * (r * slope_[i] - t * slope_[i + 1]);
}

double FlameTable::Slope(double u) const {
  if (u <= u_.front() || u >= u_.back()) return 0.0;
  const std::size_t i = IntervalOf(u);
  const double h = u_[i + 1] - u_[i];
  const double t = (u - u_[i]) / h, r = 1.0 - t;
  return 6.0 * t * r * (q_[i + 1] - q_[i]) / h + r * (1.0 - 3.0 * t) * slope_[i] +
         t * (1.0 - 3.0 * r) * slope_[i + 1];
}

namespace {

class TableEffect final : public LoopEffect {
 public:
  explicit TableEffect(FlameTable table) : table_(std::move(table)) {}
  std::unique_ptr<LoopEffect> Clone() const override {
    return std::make_unique<TableEffect>(table_);
  }
  void FlameOut(const LoopContext& /*at*/, std::span<double> heat_release) override {
    for (double& q : heat_release) q = table_.Value(q);
  }

 private:
  FlameTable table_;
};

}  // namespace

std::shared_ptr<const LoopEffect> MakeTableEffect(FlameTable table) {
  return std::make_shared<TableEffect>(std::move(table));
}

}  // namespace howl

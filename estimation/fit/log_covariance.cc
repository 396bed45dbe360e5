#include "estimation/fit/log_covariance.h"

#include <glog/logging.h>

#include <utility>

namespace howl {
namespace {

// The columns of a Jacobian's block that are in one block of a set.
struct Part {
  int block = 0;
  std::vector<Eigen::Index> here;    // columns of the Jacobian's block
  std::vector<Eigen::Index> within;  // their places in the set's
};

Part& PartOf(std::vector<Part>& parts, int block) {
  for (Part& part : parts) {
    if (part.block == block) return part;
  }
  return parts.emplace_back(Part{block, {}, {}});
}

}  // namespace

LogCovariance::LogCovariance(int size) : places_(static_cast<std::size_t>(size)) {}

void LogCovariance::Add(Set set) {
  int row = 0;
  for (std::size_t block = 0; block < set.blocks.size(); ++block) {
    int within = 0;
    for (const int column : set.blocks[block]) {
      Place& place = places_.at(static_cast<std::size_t>(column));
      CHECK_EQ(place.set, -1) << "column " << column << " is in two sets";
      place = {static_cast<int>(sets_.size()), static_cast<int>(block), within++, row++};
    }
    CHECK_EQ(set.diagonal[block].rows(), within);
  }
  CHECK_EQ(set.factor.rows(), row);
  CHECK_EQ(set.factor.cols(), set.middle.rows());
  sets_.push_back(std::move(set));
}

double LogCovariance::operator()(int row, int column) const {
  const Place& a = places_.at(static_cast<std::size_t>(row));
  const Place& b = places_.at(static_cast<std::size_t>(column));
  if (a.set != b.set || a.set < 0) return 0.0;
  const Set& set = sets_[static_cast<std::size_t>(a.set)];
  double value = 0.0;
  if (a.block == b.block)
    value = set.diagonal[static_cast<std::size_t>(a.block)](a.within, b.within);
  if (set.factor.cols() > 0) {
    value += set.factor.row(a.row) * set.middle * set.factor.row(b.row).transpose();
  }
  return value;
}

Eigen::MatrixXd LogCovariance::Of(std::span<const int> columns) const {
  const auto n = static_cast<Eigen::Index>(columns.size());
  Eigen::MatrixXd part(n, n);
  for (Eigen::Index a = 0; a < n; ++a) {
    for (Eigen::Index b = 0; b <= a; ++b) {
      part(a, b) = part(b, a) =
          (*this)(columns[static_cast<std::size_t>(a)], columns[static_cast<std::size_t>(b)]);
    }
  }
  return part;
}

// With S = sum J^T J, G = D S F and T = F^T S F,
//
//   C S C = D S D + [F G] [M T M, M; M, 0] [F G]^T,
//
// and D S D is block diagonal because no row of J has columns in two blocks but for those whose D
// is zero, which stand in F alone.
LogCovariance LogCovariance::Scattered(const std::vector<JacobianBlock>& blocks) const {
  std::vector<Set> sets;
  std::vector<Eigen::MatrixXd> inner;  // T of each set
  for (const Set& set : sets_) {
    const Eigen::Index m = set.factor.cols();
    Set& scattered = sets.emplace_back();
    scattered.blocks = set.blocks;
    for (const Eigen::MatrixXd& diagonal : set.diagonal) {
      scattered.diagonal.push_back(Eigen::MatrixXd::Zero(diagonal.rows(), diagonal.cols()));
    }
    scattered.factor = Eigen::MatrixXd::Zero(set.factor.rows(), 2 * m);
    scattered.factor.leftCols(m) = set.factor;
    inner.push_back(Eigen::MatrixXd::Zero(m, m));
  }
  std::vector<std::vector<Part>> parts(sets_.size());
  for (const JacobianBlock& jacobian : blocks) {
    std::vector<std::size_t> touched;
    for (std::size_t k = 0; k < jacobian.columns.size(); ++k) {
      const Place& place = places_.at(static_cast<std::size_t>(jacobian.columns[k]));
      if (place.set < 0) continue;
      const auto s = static_cast<std::size_t>(place.set);
      if (parts[s].empty()) touched.push_back(s);
      Part& part = PartOf(parts[s], place.block);
      part.here.push_back(static_cast<Eigen::Index>(k));
      part.within.push_back(place.within);
    }
    for (const std::size_t s : touched) {
      const Set& set = sets_[s];
      const Eigen::Index m = set.factor.cols();
      Eigen::MatrixXd along = Eigen::MatrixXd::Zero(jacobian.values.rows(), m);  // J F
      std::vector<Eigen::MatrixXd> shifts;                                       // J D
      for (const Part& part : parts[s]) {
        const Eigen::MatrixXd rows = jacobian.values(Eigen::all, part.here);
        const Eigen::MatrixXd& diagonal = set.diagonal[static_cast<std::size_t>(part.block)];
        shifts.emplace_back(rows * diagonal(part.within, Eigen::all));
        if (m == 0) continue;
        const std::vector<int>& columns = set.blocks[static_cast<std::size_t>(part.block)];
        const Eigen::Index first = places_[static_cast<std::size_t>(columns.front())].row;
        for (std::size_t k = 0; k < part.here.size(); ++k) {
          along += rows.col(static_cast<Eigen::Index>(k)) * set.factor.row(first + part.within[k]);
        }
      }
      for (std::size_t k = 0; k < parts[s].size(); ++k) {
        const auto block = static_cast<std::size_t>(parts[s][k].block);
        sets[s].diagonal[block] += shifts[k].transpose() * shifts[k];
        if (m == 0) continue;
        const Eigen::Index first = places_[static_cast<std::size_t>(set.blocks[block].front())].row;
        sets[s].factor.block(first, m, shifts[k].cols(), m) += shifts[k].transpose() * along;
      }
      inner[s] += along.transpose() * along;
      parts[s].clear();
    }
  }
  LogCovariance result(size());
  for (std::size_t s = 0; s < sets.size(); ++s) {
    const Eigen::MatrixXd& middle = sets_[s].middle;
    const Eigen::Index m = middle.rows();
    sets[s].middle = Eigen::MatrixXd::Zero(2 * m, 2 * m);
    sets[s].middle.topLeftCorner(m, m) = middle * inner[s] * middle;
    sets[s].middle.topRightCorner(m, m) = middle;
    sets[s].middle.bottomLeftCorner(m, m) = middle;
    result.Add(std::move(sets[s]));
  }
  return result;
}

}  // namespace howl

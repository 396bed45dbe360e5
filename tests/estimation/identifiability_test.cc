// Identifiability by block elimination against the textbook: singular value decomposition and
// pseudo-inverse of the whole Jacobian.
#include "estimation/fit/identifiability.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <random>

namespace howl::identifiability_test {
namespace {

constexpr int kOwn = 3;     // parameters of an experiment
constexpr int kShared = 2;  // of all; they come last

struct Drawn {
  std::vector<JacobianBlock> blocks;
  Eigen::MatrixXd whole;
  std::vector<std::string> names;
  std::vector<bool> shared;
};

// `free_own`: the experiments whose third parameter does what the second one does; `free_shared`:
// the shared parameters differ by what every experiment's first one can make up for.
Drawn Draw(int experiments, const std::vector<int>& free_own, bool free_shared) {
  Drawn drawn;
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  constexpr int kRows = 5;
  const int n = kOwn * experiments + kShared;
  drawn.whole = Eigen::MatrixXd::Zero(kRows * experiments + 1, n);
  for (int i = 0; i < experiments; ++i) {
    JacobianBlock& block = drawn.blocks.emplace_back();
    for (int k = 0; k < kOwn; ++k) {
      block.columns.push_back(kOwn * i + k);
      drawn.names.push_back("exp" + std::to_string(i + 1) + "." + std::string(1, char('a' + k)));
      drawn.shared.push_back(false);
    }
    block.columns.insert(block.columns.end(), {n - 2, n - 1});
    block.values =
        Eigen::MatrixXd::NullaryExpr(kRows, kOwn + kShared, [&] { return 3.0 * normal(random); });
    if (std::ranges::find(free_own, i) != free_own.end()) {
      block.values.col(2) = 2.0 * block.values.col(1);
    }
    if (free_shared) {
      block.values.col(kOwn + 1) = block.values.col(kOwn) + (1.0 + i) * block.values.col(0);
    }
    for (std::size_t k = 0; k < block.columns.size(); ++k) {
      drawn.whole.col(block.columns[k]).segment(Eigen::Index{kRows} * i, kRows) =
          block.values.col(static_cast<Eigen::Index>(k));
    }
  }
  // A row of what is shared alone, which notices the sum of the two.
  JacobianBlock& prior = drawn.blocks.emplace_back();
  prior.columns = {n - 2, n - 1};
  prior.values = Eigen::MatrixXd::Constant(1, 2, free_shared ? 0.0 : 0.5);
  drawn.whole.row(drawn.whole.rows() - 1).tail(2) = prior.values.row(0);
  drawn.names.insert(drawn.names.end(), {"tau_s", "M"});
  drawn.shared.insert(drawn.shared.end(), {true, true});
  return drawn;
}

// The pseudo-inverse of J^T J, and the rank.
Eigen::MatrixXd PseudoInverse(const Eigen::MatrixXd& jacobian, int* rank) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(jacobian, Eigen::ComputeFullV);
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(jacobian.cols(), jacobian.cols());
  *rank = 0;
  for (Eigen::Index k = 0; k < svd.singularValues().size(); ++k) {
    const double value = svd.singularValues()(k);
    if (value < 1e-9 * jacobian.norm()) continue;
    ++*rank;
    inverse += svd.matrixV().col(k) * svd.matrixV().col(k).transpose() / (value * value);
  }
  return inverse;
}

Eigen::MatrixXd Dense(const LogCovariance& covariance) {
  std::vector<int> columns;
  for (int k = 0; k < covariance.size(); ++k) columns.push_back(k);
  return covariance.Of(columns);
}

struct Case {
  std::vector<int> free_own;
  bool free_shared;
};

class Elimination : public testing::TestWithParam<Case> {};

TEST_P(Elimination, IsThePseudoInverse) {
  constexpr int kExperiments = 7;
  const Drawn drawn = Draw(kExperiments, GetParam().free_own, GetParam().free_shared);
  const Identifiability what =
      ComputeIdentifiability(drawn.blocks, drawn.names, drawn.shared, /*widest=*/4);
  int rank = 0;
  const Eigen::MatrixXd expected = PseudoInverse(drawn.whole, &rank);
  EXPECT_EQ(what.rank, rank);
  const std::size_t free = GetParam().free_own.size() + (GetParam().free_shared ? 1 : 0);
  EXPECT_EQ(rank, drawn.whole.cols() - static_cast<int>(free));
  EXPECT_LT((Dense(what.covariance) - expected).norm(), 1e-9 * expected.norm());
  // The free directions: as many, no residual notices them, and those of one experiment are its
  // own.
  std::size_t found = 0;
  for (const UndeterminedDirection& each : what.undetermined) {
    if (std::isfinite(each.log_std)) continue;
    const Eigen::VectorXd direction(each.direction);
    EXPECT_NEAR(direction.norm(), 1.0, 1e-12);
    EXPECT_LT((drawn.whole * direction).norm(), 1e-12 * drawn.whole.norm());
    if (found < GetParam().free_own.size()) {
      const std::string owner = "exp" + std::to_string(GetParam().free_own[found] + 1);
      EXPECT_THAT(each.text, testing::StartsWith("b and c of " + owner + " trade off"));
    }
    ++found;
  }
  EXPECT_EQ(found, free);
  for (std::size_t i = 0; i < drawn.names.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    if (std::isinf(what.log_std[i])) continue;
    EXPECT_NEAR(what.log_std[i], std::sqrt(expected(at, at)), 1e-9 * what.log_std[i]);
  }
}

TEST_P(Elimination, ScattersAsTheProductOfWholeMatrices) {
  Drawn drawn = Draw(7, GetParam().free_own, GetParam().free_shared);
  const LogCovariance covariance =
      ComputeIdentifiability(drawn.blocks, drawn.names, drawn.shared, /*widest=*/4).covariance;
  Eigen::MatrixXd scatter = Eigen::MatrixXd::Zero(drawn.whole.cols(), drawn.whole.cols());
  double weight = 1.0;
  for (JacobianBlock& block : drawn.blocks) {
    block.values *= weight += 0.3;
    const Eigen::MatrixXd squares = block.values.transpose() * block.values;
    for (std::size_t a = 0; a < block.columns.size(); ++a) {
      for (std::size_t b = 0; b < block.columns.size(); ++b) {
        scatter(block.columns[a], block.columns[b]) +=
            squares(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
      }
    }
  }
  const Eigen::MatrixXd dense = Dense(covariance);
  const Eigen::MatrixXd expected = dense * scatter * dense;
  EXPECT_LT((Dense(covariance.Scattered(drawn.blocks)) - expected).norm(), 1e-9 * expected.norm());
}

INSTANTIATE_TEST_SUITE_P(Ranks, Elimination,
                         testing::Values(Case{{}, false}, Case{{1, 4}, false}, Case{{}, true},
                                         Case{{0, 1, 2, 3, 4, 5, 6}, false}, Case{{2, 6}, true}));

// The same of a set that is narrow enough to be decomposed as a whole.
TEST(Identifiability, WholeSetsAndEliminationAgree) {
  const Drawn drawn = Draw(6, {3}, false);
  const Identifiability whole = ComputeIdentifiability(drawn.blocks, drawn.names, drawn.shared);
  const Identifiability parts =
      ComputeIdentifiability(drawn.blocks, drawn.names, drawn.shared, /*widest=*/4);
  EXPECT_EQ(whole.rank, parts.rank);
  EXPECT_LT((Dense(whole.covariance) - Dense(parts.covariance)).norm(),
            1e-9 * Dense(whole.covariance).norm());
  for (std::size_t i = 0; i < drawn.names.size(); ++i) {
    if (std::isinf(whole.log_std[i])) {
      EXPECT_TRUE(std::isinf(parts.log_std[i])) << drawn.names[i];
    } else {
      EXPECT_NEAR(whole.log_std[i], parts.log_std[i], 1e-9 * whole.log_std[i]) << drawn.names[i];
    }
  }
}

TEST(Identifiability, AParameterThatNoResidualTouchesIsFree) {
  JacobianBlock block;
  block.columns = {0};
  block.values = Eigen::MatrixXd::Constant(1, 1, 2.0);
  const Identifiability what = ComputeIdentifiability({block}, {"a", "b"}, {false, false});
  EXPECT_EQ(what.rank, 1);
  EXPECT_DOUBLE_EQ(what.log_std[0], 0.5);
  EXPECT_TRUE(std::isinf(what.log_std[1]));
  ASSERT_EQ(what.undetermined.size(), 1u);
  EXPECT_EQ(what.undetermined[0].text, "b is free");
}

}  // namespace
}  // namespace howl::identifiability_test

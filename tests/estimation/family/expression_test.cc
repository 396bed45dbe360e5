#include "estimation/family/bounds/expression.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "estimation/family/bounds/enclose.h"
#include "estimation/family/members/enumerate.h"
#include "tests/r228.h"

namespace howl::expression_test {
namespace {

double Value(const std::string& text) {
  ExpressionError error;
  const std::vector<Experiment> experiments = R228();
  std::vector<LoopModel> models(6);
  for (std::size_t i = 0; i < 6; ++i) {
    models[i] = {200.0 + double(i), 0.1, 5000.0, 100.0, 0.0035, 3.0};
  }
  const auto expression = Expression::Parse(text, experiments, error);
  EXPECT_TRUE(expression.has_value()) << text << ": " << error.message;
  return expression ? expression->Evaluate(experiments, models, 1) : std::nan("");
}

TEST(ExpressionTest, ArithmeticAndPrecedence) {
  EXPECT_EQ(Value("1 + 2 * 3 - 4 / 8"), 6.5);
  EXPECT_EQ(Value("-2^2"), -4.0);
  EXPECT_EQ(Value("2^3^2"), 512.0);
  EXPECT_EQ(Value("2^-1"), 0.5);
  EXPECT_EQ(Value("8 - 3 - 2"), 3.0);
  EXPECT_EQ(Value("(1+2)*3"), 9.0);
  EXPECT_EQ(Value("- - 3"), 3.0);
  EXPECT_NEAR(Value("sqrt(16) + exp(log(3)) + abs(-2) + sin(pi/2) + cos(0)"), 11.0, 1e-14);
  EXPECT_EQ(Value("1.5e-3"), 1.5e-3);
}

TEST(ExpressionTest, NamesOfThisAndOfOtherExperiments) {
  EXPECT_EQ(Value("omega_hz"), 201.0);
  EXPECT_EQ(Value("exp6.omega_hz - exp1.omega_hz"), 5.0);
  EXPECT_EQ(Value("frequency_hz"), 209.1);
  EXPECT_EQ(Value("M / N"), 0.02);
  EXPECT_EQ(Value("exp4.phi"), 0.49);
}

TEST(ExpressionTest, ErrorsSayWhereAndWhat) {
  const std::vector<Experiment> experiments = R228();
  const std::pair<const char*, std::size_t> cases[] = {
      {"", 0},   {"1 +", 3}, {"xi *", 4},   {"omga", 0},   {"exp9.xi", 0}, {"exp1.foo", 0},
      {"(1", 2}, {"1 2", 2}, {"sqrt 3", 5}, {"1..2.3", 2}, {"$", 0}};
  for (const auto& [text, position] : cases) {
    ExpressionError error;
    EXPECT_FALSE(Expression::Parse(text, experiments, error).has_value()) << text;
    EXPECT_EQ(error.position, position) << text << ": " << error.message;
    EXPECT_FALSE(error.message.empty());
  }
  ExpressionError error;
  EXPECT_FALSE(Expression::Parse(std::string(100000, '('), experiments, error).has_value());
}

// The interval over a cell holds the value at every point of the cell.
TEST(ExpressionTest, IntervalHoldsEveryPoint) {
  const std::vector<Experiment> experiments = R228();
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform;
  for (const char* text :
       {"omega_hz * xi / (N - M) + tau_s^2", "sqrt(xi) * exp(-omega_hz / 100) + log(N / M)",
        "sin(6.28 * omega_hz * tau_s) + cos(xi)", "abs(xi - 0.2) ^ 1.5", "xi^3 - xi^-2",
        "exp1.omega_hz / exp6.omega_hz - 1"}) {
    ExpressionError error;
    const auto expression = Expression::Parse(text, experiments, error);
    ASSERT_TRUE(expression.has_value()) << text;
    for (int box = 0; box < 50; ++box) {
      Cell cell;
      cell.boxes.resize(6);
      for (ExperimentBox& b : cell.boxes) {
        const auto set = [&](CellVariable v, double lo, double hi) {
          const double a = lo + (hi - lo) * uniform(random), c = lo + (hi - lo) * uniform(random);
          b[v] = Interval(std::min(a, c), std::max(a, c));
        };
        set(kCellOmega, 150, 220);
        set(kCellXi, 0.05, 0.3);
        set(kCellN, 3000, 9000);
        set(kCellM, 10, 2000);
        set(kCellTau, 0.003, 0.004);
      }
      Interval range;
      {
        const RoundingGuard guard;
        range = expression->Evaluate(experiments, cell, 3.0, 1);
      }
      for (int point = 0; point < 20; ++point) {
        std::vector<LoopModel> models;
        for (const ExperimentBox& b : cell.boxes) {
          const auto at = [&](CellVariable v) {
            return b[v].lower() + (b[v].upper() - b[v].lower()) * uniform(random);
          };
          models.push_back({at(kCellOmega), at(kCellXi), at(kCellN), at(kCellM), at(kCellTau), 3});
        }
        const double value = expression->Evaluate(experiments, models, 1);
        ASSERT_GE(value, range.lower() - 1e-12 * std::abs(value)) << text;
        ASSERT_LE(value, range.upper() + 1e-12 * std::abs(value)) << text;
      }
    }
  }
}

// The spread of omega between exp1 and exp6 is bounded by the test itself, 0.25, and reaches it.
// The limit cycle's angle over one delay is 270 degrees plus phase less loop phase error, exactly.
TEST(ExpressionTest, GuaranteedBoundsOfAnExpression) {
  FamilyProblem problem{.experiments = R228()};
  ExpressionError error;
  const auto spread =
      Expression::Parse("exp1.omega_hz / exp6.omega_hz - 1", problem.experiments, error);
  const auto turned = Expression::Parse("360 * frequency_hz * tau_s", problem.experiments, error);
  ASSERT_TRUE(spread && turned);
  Enclosure enclosure(problem, {.width = 0.02,
                                .max_cells = 20000,
                                .threads = 2,
                                .parameters = false,
                                .expressions = {{*spread, 0}, {*turned, 2}}});
  ASSERT_TRUE(enclosure.Run());
  const EnclosedBound a = enclosure.BoundOfExpression(0);
  EXPECT_TRUE(a.closed);
  EXPECT_GE(a.outer.hi, 0.25);
  EXPECT_LE(a.outer.hi, 0.25 * 1.02);
  EXPECT_LE(a.Excess(), 0.02);
  const EnclosedBound b = enclosure.BoundOfExpression(1);
  EXPECT_TRUE(b.closed);
  EXPECT_NEAR(b.outer.lo, 270 - 14.35 - 0.5 - 1.0, 1e-3);
  EXPECT_NEAR(b.outer.hi, 270 - 14.35 + 0.5 + 1.0, 1e-3);
  for (const Member& member : EnumerateMembers(problem, 2000, 1, 1).members) {
    const double value = spread->Evaluate(problem.experiments, member, 0);
    ASSERT_GE(value, a.outer.lo);
    ASSERT_LE(value, a.outer.hi);
  }
}

}  // namespace
}  // namespace howl::expression_test

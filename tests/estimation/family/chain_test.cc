// What is done along the chain of xi in steps that grow as the number of experiments does, against
// the definition: all pairs of experiments.
#include "estimation/family/members/drawer/chain.h"

#include <gtest/gtest.h>

#include <random>

#include "estimation/family/members/drawer/chain_front.h"
#include "estimation/family/members/drawer/window.h"
#include "estimation/family/members/enumerate.h"
#include "tests/known_loops.h"
#include "tests/r228.h"

namespace howl::chain_test {
namespace {

// In no order, and with experiments of equal phi.
std::vector<ExperimentTarget> Targets(std::mt19937_64& random, int count) {
  std::uniform_int_distribution<int> place(0, count / 2);
  std::vector<ExperimentTarget> targets(static_cast<std::size_t>(count));
  for (ExperimentTarget& target : targets) target.phi = 0.4 + 0.01 * place(random);
  return targets;
}

bool PropagatePairs(const std::vector<ExperimentTarget>& targets, std::vector<Range>& xi) {
  for (std::size_t i = 0; i < xi.size(); ++i) {
    for (std::size_t j = 0; j < xi.size(); ++j) {
      if (targets[j].phi < targets[i].phi) xi[i].lo = std::max(xi[i].lo, xi[j].lo);
      if (targets[j].phi > targets[i].phi) xi[i].hi = std::min(xi[i].hi, xi[j].hi);
    }
  }
  return std::ranges::all_of(xi, [](const Range& range) { return range.lo <= range.hi; });
}

TEST(XiChain, PropagatesAsAllPairsDo) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  int empty = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const std::vector<ExperimentTarget> targets = Targets(random, 2 + trial % 11);
    const XiChain chain(targets, true);
    std::vector<Range> xi;
    for (const ExperimentTarget& target : targets) {
      const double middle = target.phi + 0.1 * uniform(random);
      xi.push_back({middle - 0.1 * uniform(random), middle + 0.1 * uniform(random)});
    }
    std::vector<Range> expected = xi;
    const bool holds = chain.Propagate(xi);
    ASSERT_EQ(holds, PropagatePairs(targets, expected));
    empty += holds ? 0 : 1;
    for (std::size_t i = 0; i < xi.size(); ++i) {
      EXPECT_EQ(xi[i].lo, expected[i].lo);
      EXPECT_EQ(xi[i].hi, expected[i].hi);
    }
  }
  EXPECT_GT(empty, 20);
  EXPECT_LT(empty, 280);
}

TEST(XiChain, ValuesThatAreFixedNarrowTheOthers) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int trial = 0; trial < 100; ++trial) {
    const std::vector<ExperimentTarget> targets = Targets(random, 3 + trial % 9);
    const XiChain chain(targets, true);
    FixedInChain fixed;
    fixed.Reset(chain);
    std::vector<Range> expected(targets.size(), Range{0.0, 1.0});
    std::vector<std::size_t> order(targets.size());
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
    std::ranges::shuffle(order, random);
    for (const std::size_t i : order) {
      const Range here = fixed.Narrowed(i, {0.0, 1.0});
      ASSERT_EQ(here.lo, expected[i].lo);
      ASSERT_EQ(here.hi, expected[i].hi);
      const double value = here.lo + (here.hi - here.lo) * uniform(random);
      fixed.Fix(i, value);
      for (std::size_t j = 0; j < targets.size(); ++j) {
        if (targets[j].phi > targets[i].phi) expected[j].lo = std::max(expected[j].lo, value);
        if (targets[j].phi < targets[i].phi) expected[j].hi = std::min(expected[j].hi, value);
      }
    }
  }
}

TEST(XiChain, NothingIsOrderedWithoutTheCondition) {
  std::mt19937_64 random(5);
  const std::vector<ExperimentTarget> targets = Targets(random, 6);
  const XiChain chain(targets, false);
  FixedInChain fixed;
  fixed.Reset(chain);
  fixed.Fix(0, 0.5);
  EXPECT_EQ(fixed.Narrowed(1, {0.1, 0.9}).lo, 0.1);
  EXPECT_EQ(fixed.Narrowed(1, {0.1, 0.9}).hi, 0.9);
}

TEST(Falsify, OrderOfXiIsThatOfAllPairs) {
  MembershipTest test;
  std::mt19937_64 random(6);
  std::uniform_int_distribution<int> step(0, 4);
  int rejected = 0;
  for (int trial = 0; trial < 400; ++trial) {
    std::vector<Experiment> experiments = R228();
    std::vector<LoopModel> models(experiments.size(), LoopModel{200.0, 0.1, 1e3, 0.0, 3e-3});
    for (std::size_t i = 0; i < experiments.size(); ++i) {
      experiments[i].phi = 0.5 + 0.01 * step(random);
      models[i].xi = 0.1 + 0.01 * (trial % 2 == 0 ? step(random) : 0.0) +
                     (trial % 2 == 0 ? 0.0 : experiments[i].phi - 0.5);
    }
    if (trial % 3 == 0) std::ranges::sort(experiments, {}, &Experiment::phi);
    if (trial % 3 == 1) std::ranges::sort(experiments, std::ranges::greater{}, &Experiment::phi);
    bool falls = false;
    for (std::size_t i = 0; i < experiments.size(); ++i) {
      for (std::size_t j = 0; j < experiments.size(); ++j) {
        falls |= experiments[j].phi < experiments[i].phi && models[j].xi > models[i].xi;
      }
    }
    rejected += falls ? 1 : 0;
    EXPECT_EQ(Falsify(experiments, models, test).Contains(Condition::kXiIncreasing), falls);
  }
  EXPECT_GT(rejected, 100);
  EXPECT_LT(rejected, 399);
}

// The front of a chain leaves what all its experiments leave, and is short.
TEST(ChainFronts, BoundXiAsAllExperimentsDo) {
  FamilyProblem problem;
  problem.experiments = DrawKnownLoops(200, 1, 0.003, 0.15).experiments;
  const WindowProblem window = MakeWindowProblem(problem);
  const XiChain chain(window.targets, true);
  const std::optional<Range> feasible = FeasibleWindows(window);
  ASSERT_TRUE(feasible);
  const Range windows_hz = *feasible;
  const ChainFronts fronts(window, chain, windows_hz);
  std::size_t longest = 0;
  for (int k = 0; k < 20; ++k) {  // at the very ends xi may have to vanish
    const double v = windows_hz.lo + (windows_hz.hi - windows_hz.lo) * (k + 0.5) / 20.0;
    std::vector<Range> all;
    for (const ExperimentTarget& target : window.targets) {
      all.push_back(XiInWindow(target, {v, v * window.factor}, {1e-5, 10.0}));
    }
    double lo = 1e-5;
    for (std::size_t i = 0; i < all.size(); ++i) {  // phi rises with the number
      double front = 1e-5;
      for (const std::size_t j : fronts.Below(chain.LinkOf(i))) front = std::max(front, all[j].lo);
      EXPECT_EQ(front, lo) << i;
      lo = std::max(lo, all[i].lo);
      longest = std::max(longest, fronts.Below(chain.LinkOf(i)).size());
    }
    double hi = 10.0;
    for (std::size_t i = all.size(); i-- > 0;) {
      double front = 10.0;
      for (const std::size_t j : fronts.Above(chain.LinkOf(i))) front = std::min(front, all[j].hi);
      EXPECT_EQ(front, hi) << i;
      hi = std::min(hi, all[i].hi);
      longest = std::max(longest, fronts.Above(chain.LinkOf(i)).size());
    }
  }
  EXPECT_LT(longest, 40u);
}

// A preview tells what the draw of the whole member would be, to the last bit and random number.
void ComparePreviews(const FamilyProblem& problem, int least_compared) {
  const MemberDrawer drawer(problem);
  const std::optional<Range> windows = FeasibleWindows(MakeWindowProblem(problem));
  ASSERT_TRUE(windows);
  UnitRandom random(7, 1);
  const double ends[] = {0.0, 1.0, 0.5};
  int compared = 0, failed = 0;
  for (int draw = 0; draw < 20000; ++draw) {
    DrawFocus focus;
    focus.experiment = random.Index(6);
    for (double* end : {&focus.xi_end, &focus.phase_end, &focus.gain_end, &focus.loop_phase_end}) {
      *end = ends[random.Index(3)];
    }
    if (draw % 3 == 1) focus.window_hz = {0.9 * windows->lo, 1.1 * windows->hi};
    if (draw % 3 == 2) focus.xi = {0.05, 0.1};
    const std::optional<Preview> preview = drawer.PreviewFocused(random, focus);
    Member member;
    DrawGlobals globals;
    const bool drawn = drawer.DrawFocused(random, focus, member, globals);
    if (!preview) continue;
    if (!preview->model) {
      EXPECT_FALSE(drawn);
      ++failed;
    } else if (drawn) {
      const LoopModel& model = member[focus.experiment];
      EXPECT_EQ(preview->model->omega_hz, model.omega_hz);
      EXPECT_EQ(preview->model->xi, model.xi);
      EXPECT_EQ(preview->model->N, model.N);
      EXPECT_EQ(preview->model->tau_s, model.tau_s);
      ++compared;
    }
    ASSERT_EQ(preview->state, random.State());
  }
  EXPECT_GT(compared, least_compared);
  EXPECT_GT(failed, 100);
}

TEST(MemberDrawer, PreviewsWhatItDraws) {
  FamilyProblem problem;
  problem.experiments = R228();
  ComparePreviews(problem, 8000);
  // A window that ends where xi of an experiment vanishes, below the floor that draws have.
  problem.test.omega_spread_max = 0.01;
  problem.test.xi_max = 3.0;
  ComparePreviews(problem, 8000);
}

}  // namespace
}  // namespace howl::chain_test

// Units of a fit that are kept, and what is not believed.
#include "estimation/joint_records/fit_units.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>

namespace howl::fit_units_test {
namespace {

class Kept final : public FitUnits {
 public:
  std::optional<std::string> Recall(const std::string& key) override {
    const auto at = units.find(key);
    return at == units.end() ? std::nullopt : std::optional(at->second);
  }
  void Keep(const std::string& key, const std::string& bytes) override { units[key] = bytes; }

  std::map<std::string, std::string> units;
};

PointFit SomeFit() {
  PointFit fit;
  fit.parameters = Eigen::Vector3d(0.1, -2.0, 1.0 / 3.0);
  fit.information = Eigen::Matrix3d::Identity() / 7.0;
  fit.information(0, 2) = fit.information(2, 0) = 1.0 / 11.0;
  fit.information(1, 2) = fit.information(2, 1) = -0.3;
  fit.log_likelihood = -12.5;
  fit.log_posterior = -13.5;
  fit.log_evidence = 1.0 / 9.0;
  fit.iterations = 17;
  fit.converged = true;
  return fit;
}

TEST(FitUnits, AreKeptToTheBit) {
  Kept units;
  int fits = 0;
  const auto fit = [&] {
    ++fits;
    return SomeFit();
  };
  KeptFit(&units, "a/1", fit);
  const PointFit again = KeptFit(&units, "a/1", fit);
  EXPECT_EQ(fits, 1);
  const PointFit truth = SomeFit();
  EXPECT_EQ(again.parameters, truth.parameters);
  EXPECT_EQ(again.information, truth.information);
  EXPECT_EQ(again.log_likelihood, truth.log_likelihood);
  EXPECT_EQ(again.log_posterior, truth.log_posterior);
  EXPECT_EQ(again.log_evidence, truth.log_evidence);
  EXPECT_EQ(again.iterations, truth.iterations);
  EXPECT_TRUE(again.converged);
  KeptFit(&units, "a/2", fit);
  KeptFit(nullptr, "a/1", fit);
  EXPECT_EQ(fits, 3);
}

TEST(FitUnits, WhatIsNoFitIsDoneAnew) {
  const std::string whole = PointFitBytes(SomeFit());
  for (const std::string& bytes :
       {std::string(), whole.substr(0, 20), whole.substr(0, whole.size() - 1), whole + "x",
        std::string(whole.size(), '\xff')}) {
    EXPECT_FALSE(PointFitOf(bytes)) << bytes.size();
    Kept units;
    units.units["a"] = bytes;
    EXPECT_EQ(KeptFit(&units, "a", SomeFit).iterations, 17);
    EXPECT_EQ(units.units["a"], whole);
  }
}

TEST(FitUnits, CountsAreWholeNumbers) {
  PointFit fit = SomeFit();
  fit.iterations = -1;
  EXPECT_FALSE(PointFitOf(PointFitBytes(fit)));
  // Its first three numbers, then the iterations and whether it converged.
  for (const std::size_t place : {3U, 4U}) {
    for (const double value : {0.5, 1e300, std::nan("")}) {
      std::string bytes = PointFitBytes(SomeFit());
      std::memcpy(bytes.data() + place * sizeof value, &value, sizeof value);
      EXPECT_FALSE(PointFitOf(bytes)) << place << " " << value;
    }
  }
}

}  // namespace
}  // namespace howl::fit_units_test

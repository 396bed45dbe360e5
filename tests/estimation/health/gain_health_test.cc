// One experiment whose pressure or heat release is in another unit than the others'.
#include "estimation/health/gain_health.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/r228.h"

namespace howl::gain_health_test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(GainHealth, NothingIsFoundInThePapersTable) { EXPECT_THAT(CheckGains(R228()), IsEmpty()); }

TEST(GainHealth, OneRowInKilopascalsIsNamed) {
  std::vector<Experiment> table = R228();
  table[2].gain /= 1000.0;
  EXPECT_THAT(CheckGains(table), ElementsAre(AllOf(Field(&Finding::experiment, table[2].name),
                                                   Field(&Finding::kind, FindingKind::kMistake))));
}

TEST(GainHealth, TheFewAreNamedAndNotTheMany) {
  const Health health =
      CheckGains(std::vector<NamedGain>{{"a", 11.0}, {"b", 14e3}, {"c", 13.0}, {"d", 18.0}});
  EXPECT_THAT(health,
              ElementsAre(AllOf(Field(&Finding::experiment, "b"),
                                Field(&Finding::text, HasSubstr("is 777.8 times that of d")))));
}

TEST(GainHealth, AGainThatGrowsAlongTheOperatingRangeIsNoOtherUnit) {
  EXPECT_THAT(CheckGains(std::vector<NamedGain>{{"a", 1.0}, {"b", 30.0}, {"c", 900.0}}), IsEmpty());
}

TEST(GainHealth, OneGainAloneSaysNothing) {
  EXPECT_THAT(CheckGains(std::vector<NamedGain>{{"a", 1.0}, {"b", 0.0}, {"c", std::nan("")}}),
              IsEmpty());
}

}  // namespace
}  // namespace howl::gain_health_test

#include "io/results/family/family_csv.h"

#include <gtest/gtest.h>

#include <string>

#include "io/user_error.h"
#include "tests/io/record_files.h"

namespace howl::family_csv_test {
namespace {

constexpr const char* kHeader =
    "member,experiment,phi,omega_hz,xi,N,M,tau_s,loop_gain,gain_error,phase_error_deg,"
    "loop_phase_error_deg\n";
constexpr const char* kNumbers = ",0.5,200,0.1,5000,0,0.0034,1,0,0,0\n";

TEST(FamilyCsv, AMemberIsAWholeNumber) {
  const TemporaryFolder folder;
  for (const std::string member : {"", "0", "-2", "1.5", "nan", "1e300", "99999999999"}) {
    const auto path = folder.Write(
        "family.csv", kHeader + std::string("1,exp1") + kNumbers + member + ",exp1" + kNumbers);
    try {
      ReadFamilyCsv(path);
      FAIL() << member;
    } catch (const UserError& error) {
      EXPECT_EQ(error.what(), path.string() + ":3: member: \"" + member +
                                  "\", expected a whole number from 1 on");
    }
  }
}

}  // namespace
}  // namespace howl::family_csv_test

// Files of results that nest values more deeply than a stack reaches.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "io/json_text.h"
#include "io/report/run_file.h"
#include "io/results/reference_file.h"
#include "io/user_error.h"
#include "tests/faults/faults.h"

namespace howl::deep_json_test {
namespace {

using Json = nlohmann::ordered_json;

std::string Nested(std::size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); }

TEST(DeepJson, IsTakenAsFarAsAnyFileOfHowlGoes) {
  EXPECT_EQ(ParseJson<Json>(Nested(kDeepestJson)).dump(), Nested(kDeepestJson));
  EXPECT_THROW(ParseJson<Json>(Nested(kDeepestJson + 2)), JsonTooDeep);
  EXPECT_TRUE(ParseJsonOrNone<Json>(Nested(kDeepestJson + 2)).is_discarded());
  EXPECT_TRUE(ParseJsonOrNone<Json>(std::string("{")).is_discarded());
}

class DeepResults : public Faults {};

TEST_F(DeepResults, AreRefused) {
  const std::string deep = Nested(1'000'000);
  const auto stored =
      folder_.Write("reference.json",
                    "{\"schema\": \"" + std::string(kReferenceSchema) + "\", \"a\": " + deep + "}");
  try {
    const Json reference = ReadReference(stored);
    CompareReference(stored, reference, reference, 1e-6);
    ADD_FAILURE() << "it was read";
  } catch (const UserError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("values within one another, expected fewer"));
  }
  folder_.Write("run.json", "{\"schema\": \"howl.run/1\", \"commands\": " + deep + "}");
  EXPECT_THROW(ReadRunFile(folder_.path()), std::runtime_error);
}

}  // namespace
}  // namespace howl::deep_json_test

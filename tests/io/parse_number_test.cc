#include "io/records/text/parse_number.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>

namespace howl::parse_number_test {
namespace {

std::optional<double> Fast(const std::string& text) {
  const std::string line = text + "\n";
  double value = 0.0;
  const char* stop = ParseNumber(line.data(), line.data() + line.size(), &value);
  if (stop == nullptr) return std::nullopt;
  EXPECT_EQ(stop, line.data() + text.size()) << text;
  return value;
}

std::uint64_t Bits(double value) { return std::bit_cast<std::uint64_t>(value); }

void ExpectAsStrtod(const std::string& text) {
  const double expected = std::strtod(text.c_str(), nullptr);
  const std::optional<double> fast = Fast(text);
  if (fast) {
    ASSERT_EQ(Bits(*fast), Bits(expected)) << text;
  }
  const std::optional<double> field = ParseField(text);
  ASSERT_TRUE(field) << text;
  ASSERT_EQ(Bits(*field), Bits(expected)) << text;
  // Only what a double cannot hold may leave the fast path.
  if (std::isnormal(expected)) {
    ASSERT_TRUE(fast) << text;
  }
}

std::string Digits(std::mt19937_64& random, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += static_cast<char>('0' + random() % 10);
  return text;
}

TEST(ParseNumber, RoundsAsStrtodOnAMillionRandomTexts) {
  std::mt19937_64 random(20261121);
  char text[400];
  for (int i = 0; i < 1000000; ++i) {
    std::string number;
    switch (i % 5) {
      case 0:  // any double, in few or many digits
        std::snprintf(text, sizeof(text), "%.*e", static_cast<int>(random() % 20),
                      std::bit_cast<double>(random()));
        number = text;
        if (number.find_first_of("nf") != std::string::npos) continue;
        break;
      case 1:  // what a converter prints
        std::snprintf(text, sizeof(text), "%.*f", static_cast<int>(random() % 12),
                      static_cast<double>(static_cast<std::int64_t>(random())) * 1e-15);
        number = text;
        break;
      case 2:  // any text of the form
        number = (random() % 2 == 0 ? "-" : "") +
                 Digits(random, 1 + static_cast<int>(random() % 25)) + "." +
                 Digits(random, static_cast<int>(random() % 25)) + "e" +
                 std::to_string(static_cast<int>(random() % 80) - 40);
        break;
      case 3:  // around the limits of the exact path
        number = std::to_string((std::uint64_t{1} << 53) - 50 + random() % 100) + "e" +
                 std::to_string(static_cast<int>(random() % 50) - 25);
        break;
      default: {  // half-way between two doubles, or a hair beside
        const double a =
            std::ldexp(static_cast<double>((std::uint64_t{1} << 52) + (random() >> 12)),
                       static_cast<int>(random() % 60) - 55);
        const double b = std::nextafter(a, HUGE_VAL);
        const long double middle = (static_cast<long double>(a) + static_cast<long double>(b)) / 2;
        std::snprintf(text, sizeof(text), "%.*Lf", 60, middle);
        number = text;
        if (i % 2 == 0) number += "1";
      }
    }
    ExpectAsStrtod(number);
    if (HasFatalFailure()) return;
  }
}

TEST(ParseNumber, TakesEveryFormThatLoggersWrite) {
  EXPECT_EQ(Fast("1e-3"), 1e-3);
  EXPECT_EQ(Fast("+1"), 1.0);
  EXPECT_EQ(Fast(".5"), 0.5);
  EXPECT_EQ(Fast("5."), 5.0);
  EXPECT_EQ(Fast("-.25E+01"), -2.5);
  EXPECT_EQ(Fast("3.50650562671041920E+9"), 3.50650562671041920E+9);
  EXPECT_EQ(Fast("0.000000000000000000000000012345678901234567890123"),
            0.000000000000000000000000012345678901234567890123);
  EXPECT_TRUE(std::signbit(*Fast("-0")));
  EXPECT_EQ(ParseField(" \"1.5\" "), 1.5);
  EXPECT_EQ(ParseField("1.5D+03"), 1500.0);
  EXPECT_EQ(ParseField("1e400"), HUGE_VAL);
  EXPECT_EQ(ParseField("-1e400"), -HUGE_VAL);
  EXPECT_EQ(ParseField("1e-400"), 0.0);
  EXPECT_EQ(ParseField("4.9e-324"), 4.9e-324);
  EXPECT_EQ(ParseField("-Inf"), -HUGE_VAL);
  for (const char* nan : {"nan", "NaN", "-nan", "-nan(ind)"}) {
    ASSERT_TRUE(ParseField(nan)) << nan;
    EXPECT_TRUE(std::isnan(*ParseField(nan))) << nan;
  }
}

TEST(ParseNumber, RefusesWhatIsNoNumber) {
  for (const char* text : {"", "abc", "1,5", "1.2.3", "--1", "+-1", "1e", "1e+", "e5", ".", "-",
                           "0x10", "1_000", "12abc", "NA", "null", "1 2"}) {
    EXPECT_FALSE(ParseField(text)) << text;
  }
}

}  // namespace
}  // namespace howl::parse_number_test

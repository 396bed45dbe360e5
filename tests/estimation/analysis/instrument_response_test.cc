// Formulas against std::complex, tables against the response that they were taken from.
#include "estimation/analysis/instruments/instrument_response.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <functional>
#include <string>

namespace howl::instrument_response_test {
namespace {

using Complex = std::complex<double>;

InstrumentResponse Formula(const std::string& text) {
  FormulaError error;
  const auto response = InstrumentResponse::Parse(text, error);
  EXPECT_TRUE(response.has_value()) << text << ": " << error.position << ": " << error.message;
  return response.value_or(InstrumentResponse::OfTable({0.0, 1.0}, {1.0, 1.0}, {0.0, 0.0}));
}

std::string Mistake(const std::string& text) {
  FormulaError error;
  if (InstrumentResponse::Parse(text, error)) return "";
  return std::to_string(error.position) + ": " + error.message;
}

TEST(InstrumentResponseFormula, IsComplexArithmetic) {
  struct Case {
    std::string text;
    std::function<Complex(Complex)> expected;
  };
  const Complex j(0.0, 1.0);
  const double pi = M_PI;
  const std::vector<Case> cases = {
      {"1 / (1 + s / (2 pi 400))", [&](Complex s) { return 1.0 / (1.0 + s / (2.0 * pi * 400.0)); }},
      {"1/(1+s/(2*pi*400))", [&](Complex s) { return 1.0 / (1.0 + s / (2.0 * pi * 400.0)); }},
      {"s / (s + 2 pi 5)", [&](Complex s) { return s / (s + 2.0 * pi * 5.0); }},
      {"1 / (1 + 0.1 s/(2 pi 600) + (s/(2 pi 600))^2)",
       [&](Complex s) {
         const Complex u = s / (2.0 * pi * 600.0);
         return 1.0 / (1.0 + 0.1 * u + u * u);
       }},
      {"exp(-0.0007 s)", [&](Complex s) { return std::exp(-0.0007 * s); }},
      {"sqrt(1 + s / 1000)", [&](Complex s) { return std::sqrt(1.0 + s / 1000.0); }},
      {"(1 + s / 1000)^-0.5", [&](Complex s) { return std::pow(1.0 + s / 1000.0, -0.5); }},
      {"-s^2 + 3 s(1 - s) - 2", [&](Complex s) { return -s * s + 3.0 * s * (1.0 - s) - 2.0; }},
      {"2 exp(-s / 900) (1 + j f_hz / 300)",
       [&](Complex s) {
         return 2.0 * std::exp(-s / 900.0) * (1.0 + j * (s.imag() / (2.0 * pi)) / 300.0);
       }},
      {"1 - 2 - 3 * 4 / 5 * 6", [](Complex) { return Complex(1.0 - 2.0 - 3.0 * 4.0 / 5.0 * 6.0); }},
      {"2^3^0.5 * 4 pi",
       [&](Complex) { return Complex(std::pow(2.0, std::sqrt(3.0))) * 4.0 * pi; }},
      {"2", [](Complex) { return Complex(2.0); }}};
  for (const Case& each : cases) {
    const InstrumentResponse response = Formula(each.text);
    EXPECT_FALSE(response.TableBand().has_value());
    for (const double f : {0.5, 30.0, 211.0, 600.0, 4000.0}) {
      const Complex expected = each.expected(2.0 * pi * f * j);
      EXPECT_LT(std::abs(response.At(f) - expected), 1e-13 * std::abs(expected))
          << each.text << " " << f;
    }
  }
}

TEST(InstrumentResponseFormula, MistakesAreNamedWhereTheyStand) {
  EXPECT_EQ(Mistake("1 / (1 + x)"), "9: unknown name x, expected s, f_hz, j, pi or a function");
  EXPECT_EQ(Mistake("1 / (1 + s"), "10: expected ')'");
  EXPECT_EQ(Mistake("1 / "), "4: ends too early, expected a number, a name or '('");
  EXPECT_EQ(Mistake("s / 2 pi"),
            "6: a product without * after / can be read in two ways, expected * or ( )");
  EXPECT_EQ(Mistake("2 000 s"), "2: unexpected '0', expected an operator or the end");
  EXPECT_EQ(Mistake("1 + s)"), "5: unexpected ')', expected an operator or the end");
  EXPECT_EQ(Mistake(""), "0: ends too early, expected a number, a name or '('");
  EXPECT_EQ(Mistake("exp s"), "4: expected '(' after exp");
  EXPECT_NE(Mistake(std::string(5000, '(')), "");
}

TEST(InstrumentResponseFormula, WithoutAValueIsNotFinite) {
  EXPECT_FALSE(std::isfinite(std::abs(Formula("1 / (s - s)").At(100.0))));
  EXPECT_EQ(Formula("s").At(0.0), Complex(0.0));
}

// A delay is linear in phase and an exponential of the frequency in magnitude: the table is then
// exact between its rows, and its phase, given within half a turn, is unwrapped.
TEST(InstrumentResponseTable, IsExactForDelayAndExponential) {
  const double delay_s = 0.0021;
  const auto truth = [&](double f) {
    return std::polar(3.0 * std::exp(-f / 800.0), -2.0 * M_PI * f * delay_s);
  };
  std::vector<double> f, magnitude, phase_deg;
  for (double at = 10.0; at <= 2000.0; at *= 1.07) {
    f.push_back(at);
    magnitude.push_back(std::abs(truth(at)));
    phase_deg.push_back(std::arg(truth(at)) * 180.0 / M_PI);
  }
  const InstrumentResponse table = InstrumentResponse::OfTable(f, magnitude, phase_deg);
  for (double at = f.front(); at <= f.back(); at += 3.7) {
    EXPECT_LT(std::abs(table.At(at) - truth(at)), 1e-11 * std::abs(truth(at))) << at;
  }
  ASSERT_TRUE(table.TableBand().has_value());
  EXPECT_EQ(table.TableBand()->low_hz, f.front());
  EXPECT_EQ(table.TableBand()->high_hz, f.back());
}

TEST(InstrumentResponseTable, HoldsBeyondItsEnds) {
  const InstrumentResponse table =
      InstrumentResponse::OfTable({100.0, 200.0}, {2.0, 0.5}, {10.0, -30.0});
  const auto expected = [](double magnitude, double phase_deg) {
    return std::polar(magnitude, phase_deg * M_PI / 180.0);
  };
  EXPECT_LT(std::abs(table.At(1.0) - expected(2.0, 10.0)), 1e-15);
  EXPECT_LT(std::abs(table.At(5000.0) - expected(0.5, -30.0)), 1e-15);
  EXPECT_LT(std::abs(table.At(200.0) - expected(0.5, -30.0)), 1e-15);
  EXPECT_LT(std::abs(table.At(150.0) - expected(1.0, -10.0)), 1e-15);
}

}  // namespace
}  // namespace howl::instrument_response_test

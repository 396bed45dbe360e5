#include "diagnosis/budget/step_memory.h"

#include <cstdlib>
#include <ios>
#include <sstream>

namespace howl {

std::string ToText(const FinishedStep& step) {
  std::ostringstream out;
  out << std::hexfloat << (step.added ? static_cast<long long>(*step.added) : -1LL) << ' '
      << step.equals.size();
  for (const std::string& id : step.equals) out << ' ' << id;
  out << ' ' << step.fitted.size();
  for (const FinishedStep::Fitted& fitted : step.fitted) {
    out << ' ' << fitted.item << ' ' << fitted.form << ' ' << fitted.values.size();
    for (const double value : fitted.values) out << ' ' << value;
  }
  return out.str();
}

std::optional<FinishedStep> StepFromText(const std::string& text, std::size_t items) {
  std::istringstream in(text);
  FinishedStep out;
  long long added = 0;
  std::size_t count = 0;
  if (!(in >> added >> count) || added < -1 || added >= static_cast<long long>(items) ||
      count > items) {
    return std::nullopt;
  }
  if (added >= 0) out.added = static_cast<std::size_t>(added);
  out.equals.resize(count);
  for (std::string& id : out.equals) in >> id;
  if (!(in >> count) || count > items) return std::nullopt;
  out.fitted.resize(count);
  for (FinishedStep::Fitted& fitted : out.fitted) {
    constexpr std::size_t kMostValues = 64;
    std::size_t values = 0;
    if (!(in >> fitted.item >> fitted.form >> values) || fitted.item >= items ||
        values > kMostValues) {
      return std::nullopt;
    }
    for (std::size_t i = 0; i < values; ++i) {
      std::string word;  // streams do not read hexadecimal floating-point numbers
      in >> word;
      fitted.values.push_back(std::strtod(word.c_str(), nullptr));
    }
  }
  if (!in) return std::nullopt;
  return out;
}

}  // namespace howl

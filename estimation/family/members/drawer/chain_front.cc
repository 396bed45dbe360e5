#include "estimation/family/members/drawer/chain_front.h"

#include <algorithm>
#include <cmath>

namespace howl {
namespace {

// Of the sizes of what is compared: far above the rounding of a bound, and too little to keep many.
constexpr double kMargin = 1e-9;

// A term 2 v bound at both ends of the windows, and how far rounding may move it.
struct Term {
  std::size_t experiment = 0;
  double at_lo = 0.0, at_hi = 0.0;
  double margin = 0.0;
};

// As lower bounds: `a` is less than `b` wherever the window stands.
bool IsBelow(const Term& a, const Term& b) {
  const double margin = a.margin + b.margin;
  return a.at_lo < b.at_lo - margin && a.at_hi < b.at_hi - margin;
}

void AddToFront(std::vector<Term>& front, const Term& term) {
  if (std::ranges::any_of(front, [&](const Term& other) { return IsBelow(term, other); })) return;
  std::erase_if(front, [&](const Term& other) { return IsBelow(other, term); });
  front.push_back(term);
}

std::vector<std::size_t> ExperimentsOf(const std::vector<Term>& front) {
  std::vector<std::size_t> experiments;
  for (const Term& term : front) experiments.push_back(term.experiment);
  std::ranges::sort(experiments);
  experiments.erase(std::unique(experiments.begin(), experiments.end()), experiments.end());
  return experiments;
}

// sign = -1: an upper bound as the lower bound of -xi.
std::vector<Term> TermsOf(std::size_t experiment, const std::vector<XiBound>& bounds, double sign,
                          const Range& windows_hz) {
  std::vector<Term> terms;
  for (const XiBound& bound : bounds) {
    const auto at = [&](double v) { return sign * (bound.constant - bound.slope * v * v); };
    const double size =
        std::abs(bound.constant) + std::abs(bound.slope) * windows_hz.hi * windows_hz.hi;
    terms.push_back({experiment, at(windows_hz.lo), at(windows_hz.hi), kMargin * size});
  }
  return terms;
}

}  // namespace

ChainFronts::ChainFronts(const WindowProblem& problem, const XiChain& chain,
                         const Range& windows_hz)
    : below_(chain.Links()), above_(chain.Links()) {
  if (!chain.IsIncreasing() || !std::isfinite(problem.factor)) return;
  const auto add = [&](std::size_t link, double sign, std::vector<Term>& front) {
    for (const std::size_t i : chain.Experiments(link)) {
      const XiBounds bounds = XiBoundsOf(problem.targets[i], problem.factor);
      for (const Term& term :
           TermsOf(i, sign > 0.0 ? bounds.lower : bounds.upper, sign, windows_hz)) {
        AddToFront(front, term);
      }
    }
  };
  std::vector<Term> front;
  for (std::size_t link = 0; link < chain.Links(); ++link) {
    below_[link] = ExperimentsOf(front);
    add(link, 1.0, front);
  }
  front.clear();
  for (std::size_t link = chain.Links(); link-- > 0;) {
    above_[link] = ExperimentsOf(front);
    add(link, -1.0, front);
  }
}

}  // namespace howl

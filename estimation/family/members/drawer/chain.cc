#include "estimation/family/members/drawer/chain.h"

#include <algorithm>
#include <numeric>

#include "model/numerics/constants.h"

namespace howl {
namespace {

constexpr std::size_t LowestBit(std::size_t k) { return k & (~k + 1); }

}  // namespace

XiChain::XiChain(std::span<const ExperimentTarget> targets, bool increasing)
    : increasing_(increasing), link_of_(targets.size()) {
  std::vector<std::size_t> order(targets.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return targets[i].phi; });
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (k == 0 || targets[order[k - 1]].phi < targets[order[k]].phi) links_.emplace_back();
    links_.back().push_back(order[k]);
    link_of_[order[k]] = links_.size() - 1;
  }
}

bool XiChain::Propagate(std::span<Range> xi) const {
  if (increasing_) {
    double largest = -kInfinity;  // of the links below
    for (const std::vector<std::size_t>& link : links_) {
      double here = largest;
      for (const std::size_t i : link) {
        xi[i].lo = std::max(xi[i].lo, largest);
        here = std::max(here, xi[i].lo);
      }
      largest = here;
    }
    double smallest = kInfinity;  // of the links above
    for (std::size_t k = links_.size(); k-- > 0;) {
      double here = smallest;
      for (const std::size_t i : links_[k]) {
        xi[i].hi = std::min(xi[i].hi, smallest);
        here = std::min(here, xi[i].hi);
      }
      smallest = here;
    }
  }
  return std::ranges::all_of(xi, [](const Range& range) { return range.lo <= range.hi; });
}

void FixedInChain::Reset(const XiChain& chain) {
  chain_ = &chain;
  if (!chain.IsIncreasing()) return;
  largest_.assign(chain.Links() + 1, -kInfinity);
  smallest_.assign(chain.Links() + 1, kInfinity);
}

void FixedInChain::Fix(std::size_t experiment, double value) {
  if (!chain_->IsIncreasing()) return;
  const std::size_t links = chain_->Links();
  const std::size_t link = chain_->LinkOf(experiment);
  for (std::size_t k = link + 1; k <= links; k += LowestBit(k)) {
    largest_[k] = std::max(largest_[k], value);
  }
  for (std::size_t k = links - link; k <= links; k += LowestBit(k)) {
    smallest_[k] = std::min(smallest_[k], value);
  }
}

Range FixedInChain::Narrowed(std::size_t experiment, const Range& xi) const {
  if (!chain_->IsIncreasing()) return xi;
  Range range = xi;
  const std::size_t link = chain_->LinkOf(experiment);
  for (std::size_t k = link; k > 0; k -= LowestBit(k)) range.lo = std::max(range.lo, largest_[k]);
  for (std::size_t k = chain_->Links() - 1 - link; k > 0; k -= LowestBit(k)) {
    range.hi = std::min(range.hi, smallest_[k]);
  }
  return range;
}

}  // namespace howl

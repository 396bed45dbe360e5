// xi does not fall as phi grows: a chain of order relations between the experiments. On intervals
// the chain is solved exactly by two running bounds: after Propagate every value that is left in
// one interval has partners in all the others. Experiments of equal phi are not ordered among
// themselves: they are one link.
#ifndef HOWL_ESTIMATION_FAMILY_MEMBERS_DRAWER_CHAIN_H_
#define HOWL_ESTIMATION_FAMILY_MEMBERS_DRAWER_CHAIN_H_

#include <cstddef>
#include <span>
#include <vector>

#include "estimation/family/problem/problem.h"
#include "estimation/family/problem/targets.h"

namespace howl {

class XiChain {
 public:
  // Where `increasing` is false, nothing is ordered.
  XiChain(std::span<const ExperimentTarget> targets, bool increasing);

  // False when the chain is empty. The work grows as the number of experiments does.
  bool Propagate(std::span<Range> xi) const;

  bool IsIncreasing() const { return increasing_; }
  // Links in the order of phi.
  std::size_t Links() const { return links_.size(); }
  std::size_t LinkOf(std::size_t experiment) const { return link_of_[experiment]; }
  const std::vector<std::size_t>& Experiments(std::size_t link) const { return links_[link]; }

 private:
  bool increasing_;
  std::vector<std::vector<std::size_t>> links_;
  std::vector<std::size_t> link_of_;
};

// The intervals that values fixed in a chain, in any order, leave to the others: between the
// largest of the links below and the smallest of those above, from two binary indexed trees
// (Fenwick 1994), so that each value costs the logarithm of the number of links.
class FixedInChain {
 public:
  void Reset(const XiChain& chain);
  void Fix(std::size_t experiment, double value);
  Range Narrowed(std::size_t experiment, const Range& xi) const;

 private:
  const XiChain* chain_ = nullptr;
  std::vector<double> largest_;   // of links up to one, as the tree has them
  std::vector<double> smallest_;  // the same from the last link down
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_MEMBERS_DRAWER_CHAIN_H_

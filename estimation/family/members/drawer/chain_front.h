// Which experiments can bound xi of another one through the chain, one mode. By
// estimation/family/members/drawer/window.h the window [v, S v] bounds xi of each experiment by
// terms
//
//   (constant - slope q) / (2 v),   q = v^2,
//
// and what the chain leaves to an experiment is the largest of the lower bounds of the links below,
// and the smallest upper bound of those above. Of two terms that are linear in q the one that is
// less at both ends of an interval is less within: it never counts while the other is there. What
// is left of the terms below each link is a short list, so that xi of one experiment is bounded
// without a look at all of them.
#ifndef HOWL_ESTIMATION_FAMILY_MEMBERS_DRAWER_CHAIN_FRONT_H_
#define HOWL_ESTIMATION_FAMILY_MEMBERS_DRAWER_CHAIN_FRONT_H_

#include <cstddef>
#include <vector>

#include "estimation/family/members/drawer/chain.h"
#include "estimation/family/members/drawer/window.h"

namespace howl {

class ChainFronts {
 public:
  // For windows whose low end lies within `windows_hz`.
  ChainFronts(const WindowProblem& problem, const XiChain& chain, const Range& windows_hz);

  // Experiments of the links below (above) the link that may bound xi from below (above).
  const std::vector<std::size_t>& Below(std::size_t link) const { return below_[link]; }
  const std::vector<std::size_t>& Above(std::size_t link) const { return above_[link]; }

 private:
  std::vector<std::vector<std::size_t>> below_, above_;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_MEMBERS_DRAWER_CHAIN_FRONT_H_

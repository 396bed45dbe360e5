// A smooth quantity of a member, and the experiments that it depends on.
#ifndef HOWL_ESTIMATION_FAMILY_PROBLEM_MEMBER_QUANTITY_H_
#define HOWL_ESTIMATION_FAMILY_PROBLEM_MEMBER_QUANTITY_H_

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "estimation/parameters.h"

namespace howl {

struct MemberQuantity {
  std::function<double(std::span<const LoopModel>)> value;
  std::vector<std::size_t> experiments;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_PROBLEM_MEMBER_QUANTITY_H_

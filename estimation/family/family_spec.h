// How much of the family of unfalsified models is listed, and what a member has to pass.
#ifndef HOWL_ESTIMATION_FAMILY_FAMILY_SPEC_H_
#define HOWL_ESTIMATION_FAMILY_FAMILY_SPEC_H_

#include "estimation/family/membership.h"

namespace howl {

struct FamilySpec {
  int members = 1000;   // listed, spread over the whole set
  double width = 0.01;  // relative precision at which the search for guaranteed bounds stops
  MembershipTest test;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_FAMILY_SPEC_H_

// Members drawn, built and tested; the pilot search that a drawer makes first is not measured.
#include <memory>

#include "bench/limits/measured.h"
#include "bench/r228_family.h"
#include "estimation/family/members/enumerate.h"

namespace howl::limits {
namespace {

std::function<double()> Prepare(int modes, std::size_t count) {
  struct State {
    explicit State(int modes) : problem(R228Family(modes)), drawer(problem) {}
    FamilyProblem problem;
    MemberDrawer drawer;
  };
  auto state = std::make_shared<const State>(modes);
  return [state, count] {
    const Enumeration found = EnumerateMembers(state->problem, state->drawer, count, 1, 1);
    return static_cast<double>(found.members.size());
  };
}

}  // namespace

std::vector<Measured> EnumerateLoads() {
  return {{"enumerate, one mode", "member", [] { return Prepare(1, 4096); }},
          {"enumerate, two modes", "member", [] { return Prepare(2, 512); }}};
}

}  // namespace howl::limits

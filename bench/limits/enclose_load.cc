// Guaranteed bounds of every parameter. The unit is a bound, one end of one parameter: members
// drawn and led towards it, and boxes split and contracted until none reaches farther. One box:
// contract_load.cc.
#include <memory>

#include "bench/limits/measured.h"
#include "bench/r228_family.h"
#include "estimation/family/bounds/enclose.h"

namespace howl::limits {
namespace {

std::function<double()> Prepare(int modes) {
  EncloseOptions options;
  options.width = 0.01;
  options.threads = 1;
  // With two modes a twelfth of the bounds: they take seconds together, and are alike.
  const std::size_t every = modes == 1 ? 1 : 12;
  auto enclosure = std::make_shared<Enclosure>(R228Family(modes), options);
  return [enclosure, every] {
    enclosure->Run(nullptr, [every](std::size_t k) { return k % every == 0; });
    const std::size_t bounds = (enclosure->Searches() + every - 1) / every;
    return static_cast<double>(bounds);
  };
}

}  // namespace

std::vector<Measured> EncloseLoads() {
  return {{"enclose, one mode", "bound", [] { return Prepare(1); }},
          {"enclose, two modes", "bound", [] { return Prepare(2); }}};
}

}  // namespace howl::limits

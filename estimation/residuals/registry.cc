#include "estimation/residuals/registry.h"

#include <array>

namespace howl {

const ResidualDefinition& DefinitionOf(ResidualKind kind) {
#define HOWL_RESIDUAL_CALL(identifier, name) identifier##Definition(),
  static const std::array<ResidualDefinition, kNumResidualKinds> definitions = {
      HOWL_RESIDUALS(HOWL_RESIDUAL_CALL)};
#undef HOWL_RESIDUAL_CALL
  return definitions[static_cast<std::size_t>(kind)];
}

ResidualSet DefaultResidualSet() {
  ResidualSet set;
  for (const ResidualKind kind : kResidualKinds) {
    set[kind].std = DefinitionOf(kind).std.value;
    set[kind].center = DefinitionOf(kind).center.value;
  }
  return set;
}

}  // namespace howl

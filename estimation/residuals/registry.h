// What there is to say of a residual, in one place: the joint problem, the config's keys, defaults
// and schema, `howl help residuals` and the test of the Jacobians all take it from here. Each file
// of this folder defines one residual or a few alike; HOWL_RESIDUALS (residual_spec.h) lists them.
#ifndef HOWL_ESTIMATION_RESIDUALS_REGISTRY_H_
#define HOWL_ESTIMATION_RESIDUALS_REGISTRY_H_

#include <string_view>
#include <vector>

#include "estimation/residual_spec.h"

namespace howl {

class ResidualAdder;

// A positive number that a config can set.
struct ResidualNumber {
  std::string_view key;  // carries the unit
  double value = 0.0;    // the default
  std::string_view text;
};

struct ResidualDefinition {
  std::string_view text;      // what is asked for
  std::string_view equation;  // and where the paper has it
  // The standard deviation of the residual's error: std_relative, std_deg, or std where it is in
  // the residual's own unit.
  ResidualNumber std;
  // A second number, ResidualSpec::center; without a key there is none.
  ResidualNumber center = {};
  bool has_form = false;  // the config may ask for (5a) or (5c)
  bool needs_two_modes = false;
  // Acts on reliable experiments alone unless the config names others: the flame slope of an
  // unreliable record is not to be trusted.
  bool reliable_only = false;
  // One of these two: what adds the blocks of an experiment on which the residual acts, or those
  // that connect all such experiments. The former come first, experiment by experiment.
  void (*add_to)(ResidualAdder& problem, int experiment) = nullptr;
  void (*add_across)(ResidualAdder& problem, const std::vector<int>& experiments) = nullptr;
};

#define HOWL_RESIDUAL_DEFINITION(identifier, name) ResidualDefinition identifier##Definition();
HOWL_RESIDUALS(HOWL_RESIDUAL_DEFINITION)
#undef HOWL_RESIDUAL_DEFINITION

const ResidualDefinition& DefinitionOf(ResidualKind kind);

}  // namespace howl

#endif  // HOWL_ESTIMATION_RESIDUALS_REGISTRY_H_

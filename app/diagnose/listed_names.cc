#include "app/diagnose/listed_names.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <sstream>

#include "app/command_line/command.h"
#include "diagnosis/loop_budget/forms/loop_item.h"
#include "diagnosis/loop_budget/sample_facts.h"
#include "io/config/schema/nearest_key.h"
#include "model/effects/catalogue.h"

namespace howl {

std::vector<std::string> ListedNames(const Options& options, const std::string& option,
                                     const std::vector<std::string>& known,
                                     const std::string& none_of_them) {
  std::vector<std::string> out;
  std::istringstream list(options.Text(option).value_or(""));
  for (std::string id; std::getline(list, id, ',');) {
    if (std::ranges::find(known, id) == known.end()) {
      const std::optional<std::string> nearest = NearestKey(id, known);
      throw UsageError(option + ": " + id + " is " + none_of_them +
                       (nearest ? ", did you mean " + *nearest + "?" : ""));
    }
    out.push_back(id);
  }
  return out;
}

std::vector<std::string> Withheld(const Options& options) {
  std::vector<std::string> known = LoopItemIds();
  for (const EffectPointer& effect : Catalogue()) known.emplace_back(effect->id());
  std::ranges::copy(SampleFactIds(), std::back_inserter(known));
  return ListedNames(options, "--without", known,
                     "no effect of the catalogue and no item of a budget");
}

}  // namespace howl

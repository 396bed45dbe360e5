#include "app/diagnose/listed_names.h"

#include <algorithm>
#include <iterator>
#include <sstream>

#include "app/command_line/known_name.h"
#include "diagnosis/loop_budget/forms/loop_item.h"
#include "diagnosis/loop_budget/sample_facts.h"
#include "model/effects/catalogue.h"

namespace howl {

std::vector<std::string> ListedNames(const Options& options, const std::string& option,
                                     const std::vector<std::string>& known,
                                     const std::string& none_of_them) {
  std::vector<std::string> out;
  std::istringstream list(options.Text(option).value_or(""));
  for (std::string id; std::getline(list, id, ',');) {
    RequireKnown(option, id, known, none_of_them);
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

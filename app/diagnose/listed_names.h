// What an option names in a list: --without a,b.
#ifndef HOWL_APP_DIAGNOSE_LISTED_NAMES_H_
#define HOWL_APP_DIAGNOSE_LISTED_NAMES_H_

#include <string>
#include <vector>

#include "app/command_line/options.h"

namespace howl {

// Throws UsageError where one of the names is not known: it is `none_of_them`, and may be meant for
// another.
std::vector<std::string> ListedNames(const Options& options, const std::string& option,
                                     const std::vector<std::string>& known,
                                     const std::string& none_of_them);

// --without a,b: of the catalogue, of the items of a budget, and of what samples show.
std::vector<std::string> Withheld(const Options& options);

}  // namespace howl

#endif  // HOWL_APP_DIAGNOSE_LISTED_NAMES_H_

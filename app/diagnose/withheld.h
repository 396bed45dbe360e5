// What --without a,b leaves out.
#ifndef HOWL_APP_DIAGNOSE_WITHHELD_H_
#define HOWL_APP_DIAGNOSE_WITHHELD_H_

#include <string>
#include <vector>

#include "app/command_line/options.h"

namespace howl {

// Throws UsageError where one of the ids is not known: it is `none_of_them`, and may be meant for
// another.
std::vector<std::string> WithheldOf(const Options& options, const std::vector<std::string>& known,
                                    const std::string& none_of_them);

}  // namespace howl

#endif  // HOWL_APP_DIAGNOSE_WITHHELD_H_

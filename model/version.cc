#include "model/version.h"

namespace howl {

std::string_view Version() { return HOWL_VERSION; }

}  // namespace howl

// The version of the library, as in CMakeLists.txt.
#ifndef HOWL_MODEL_VERSION_H_
#define HOWL_MODEL_VERSION_H_

#include <string_view>

namespace howl {

std::string_view Version();

}  // namespace howl

#endif  // HOWL_MODEL_VERSION_H_

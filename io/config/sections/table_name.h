// Whether a text that may be a formula is the name of a table.
#ifndef HOWL_IO_CONFIG_SECTIONS_TABLE_NAME_H_
#define HOWL_IO_CONFIG_SECTIONS_TABLE_NAME_H_

#include <algorithm>
#include <iterator>
#include <string_view>

namespace howl {

// A formula has no name with an owner, and so never ends like this.
inline bool IsTableName(std::string_view text) {
  constexpr std::string_view kEndings[] = {".csv", ".tsv", ".txt", ".dat",
                                           ".gz",  ".mat", ".h5",  ".hdf5"};
  return std::any_of(std::begin(kEndings), std::end(kEndings),
                     [&](std::string_view ending) { return text.ends_with(ending); });
}

}  // namespace howl

#endif  // HOWL_IO_CONFIG_SECTIONS_TABLE_NAME_H_

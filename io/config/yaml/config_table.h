// Recognises a record that was given in the place of a config.
#ifndef HOWL_IO_CONFIG_YAML_CONFIG_TABLE_H_
#define HOWL_IO_CONFIG_YAML_CONFIG_TABLE_H_

#include <string>
#include <string_view>

namespace howl {

// Says what the file is, and which config was expected; empty where `text`, the beginning of the
// file, is no table of numbers and no file of MATLAB, HDF5 or gzip. `file`: its path.
std::string DescribeRecordAsConfig(const std::string& file, std::string_view text);

}  // namespace howl

#endif  // HOWL_IO_CONFIG_YAML_CONFIG_TABLE_H_

// Columns of a file that holds named arrays (.mat, .h5): a vector by its name, a channel of a
// matrix as NAME:K, or K alone where the file has one matrix. A matrix's channels lie along its
// shorter side, so 30000 x 2 and 2 x 30000 read alike.
#ifndef HOWL_IO_RECORDS_BINARY_ARRAY_COLUMNS_H_
#define HOWL_IO_RECORDS_BINARY_ARRAY_COLUMNS_H_

#include <cstddef>
#include <string>
#include <vector>

#include "io/records/columns/table_source.h"

namespace howl {

struct ArrayInfo {
  std::string name;
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::string problem;  // why it is no column ("complex", "text"); empty when it may be one

  std::size_t samples() const { return rows > columns ? rows : columns; }
  std::size_t channels() const { return rows > columns ? columns : rows; }
  bool along_rows() const { return rows >= columns; }  // samples follow each other along the rows
};

struct ArrayChannel {
  std::size_t array = 0;
  std::size_t channel = 0;  // from 0
};

// Every vector, and every channel of a matrix.
std::vector<ColumnInfo> ListChannels(const std::vector<ArrayInfo>& arrays);

// All of one length and all different. Throws UserError that lists what there is.
std::vector<ArrayChannel> FindChannels(const std::string& file,
                                       const std::vector<ArrayInfo>& arrays,
                                       const std::vector<ColumnName>& names);

}  // namespace howl

#endif  // HOWL_IO_RECORDS_BINARY_ARRAY_COLUMNS_H_

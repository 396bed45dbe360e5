// A file as a table of columns. One format a file: text_table, mat_table, hdf5_table; the next
// format is one more subclass and one more branch in OpenTable (io/records/open_table.cc).
#ifndef HOWL_IO_RECORDS_COLUMNS_TABLE_SOURCE_H_
#define HOWL_IO_RECORDS_COLUMNS_TABLE_SOURCE_H_

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "io/record_spec.h"

namespace howl {

using Columns = std::vector<std::vector<double>>;

// A column that a file has.
struct ColumnInfo {
  ColumnName name;          // what Read takes: the shortest that means this column alone
  std::string label;        // the file's own words for it, its unit included: "time [ms]"; or empty
  std::string problem;      // why it cannot be read ("text", "complex"); empty where it can
  std::size_t samples = 0;  // 0: known once it is read
};

class TableSource {
 public:
  TableSource() = default;
  TableSource(const TableSource&) = delete;
  TableSource& operator=(const TableSource&) = delete;
  virtual ~TableSource() = default;

  // The columns in the order asked for, all of one length; called once. nan and inf are let
  // through: the caller knows which rows matter. Throws UserError for everything else.
  virtual Columns Read(const std::vector<ColumnName>& names) = 0;

  // All columns, in the file's order.
  virtual std::vector<ColumnInfo> List() const = 0;

  // What the file is, for a reader: "text parted by tabs, no header".
  virtual std::string Format() const = 0;

  // The rate that the file's header states, if it does.
  virtual std::optional<double> StatedRateHz() const { return std::nullopt; }

  // What the file itself calls the column: of a number, the header's name. Empty where it has none.
  // The unit of a units row follows in brackets: "time [ms]".
  virtual std::string NameOf(const ColumnName& name) const;

  // The line of a row (both from 0 and 1 respectively), or 0 where the format has no lines.
  virtual int LineOf(std::size_t /*row*/) const { return 0; }
};

// "column 2" for a number, the name itself otherwise: the key of an error.
std::string DisplayName(const ColumnName& name);

// K of a column given as a number, or 0.
std::size_t ColumnNumber(const std::string& name);

// "a, b, c, ..." : the names that there are, cut when they are many.
std::string ListNames(const std::vector<std::string>& names);

}  // namespace howl

#endif  // HOWL_IO_RECORDS_COLUMNS_TABLE_SOURCE_H_

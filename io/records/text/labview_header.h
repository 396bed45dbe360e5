// LabVIEW's text files (.lvm, "LabVIEW Measurement") open with lines of a key and a value:
//
//   LabVIEW Measurement
//   Separator       Tab
//   Decimal_Separator       ,
//   X_Columns       No
//   ***End_of_Header***
//   Channels        2
//   Delta_X 1.000000E-4     1.000000E-4
//   ***End_of_Header***
//   X_Value Pressure        PMT     Comment
//
// and then the table. X_Columns is No (X_Value is there but empty), One or Multi. (National
// Instruments, "Specification for the LabVIEW Measurement File".)
#ifndef HOWL_IO_RECORDS_TEXT_LABVIEW_HEADER_H_
#define HOWL_IO_RECORDS_TEXT_LABVIEW_HEADER_H_

#include <optional>
#include <string_view>

namespace howl {

struct LabviewHeader {
  int lines = 0;  // up to the last ***End_of_Header*** and with it
  char separator = '\t';
  bool decimal_comma = false;
  std::optional<double> step_s;  // Delta_X of the first channel, in units of X: seconds
};

// `start`: the file's first lines. No value where none of them ends a header.
std::optional<LabviewHeader> ReadLabviewHeader(std::string_view start);

}  // namespace howl

#endif  // HOWL_IO_RECORDS_TEXT_LABVIEW_HEADER_H_

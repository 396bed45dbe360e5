// UTF-16 text (Windows' "Unicode", as LabVIEW and Excel export it) as UTF-8.
#ifndef HOWL_IO_RECORDS_TEXT_UTF16_BYTES_H_
#define HOWL_IO_RECORDS_TEXT_UTF16_BYTES_H_

#include <memory>

#include "io/records/text/byte_source.h"

namespace howl {

// The same bytes, or their UTF-8 where they are UTF-16: they begin with its mark, or are ASCII with
// every other byte zero.
std::unique_ptr<ByteSource> AsUtf8(std::unique_ptr<ByteSource> bytes);

}  // namespace howl

#endif  // HOWL_IO_RECORDS_TEXT_UTF16_BYTES_H_

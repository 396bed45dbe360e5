// A file's bytes in order, decompressed when it is gzip (recognised by content). Streamed: no more
// than a block is held.
#ifndef HOWL_IO_RECORDS_TEXT_BYTE_SOURCE_H_
#define HOWL_IO_RECORDS_TEXT_BYTE_SOURCE_H_

#include <cstddef>
#include <filesystem>
#include <memory>
#include <stdexcept>

namespace howl {

// A fault in the bytes; the caller adds the file and the line.
class ByteError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class ByteSource {
 public:
  ByteSource() = default;
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;
  virtual ~ByteSource() = default;

  // Up to `size` bytes; fewer only at the end. Throws ByteError.
  virtual std::size_t Read(char* to, std::size_t size) = 0;

  // The share of the file that has been read, 0 to 1, which tells how many rows to reserve.
  virtual double FractionRead() const = 0;
};

std::unique_ptr<ByteSource> OpenBytes(const std::filesystem::path& file);

}  // namespace howl

#endif  // HOWL_IO_RECORDS_TEXT_BYTE_SOURCE_H_

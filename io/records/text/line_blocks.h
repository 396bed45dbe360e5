// A text file in blocks of whole lines: memory stays at one block whatever the file's size.
#ifndef HOWL_IO_RECORDS_TEXT_LINE_BLOCKS_H_
#define HOWL_IO_RECORDS_TEXT_LINE_BLOCKS_H_

#include <cstddef>
#include <memory>
#include <vector>

#include "io/records/text/byte_source.h"

namespace howl {

class LineBlocks {
 public:
  explicit LineBlocks(std::unique_ptr<ByteSource> bytes);

  // The next block: [begin(), end()), the last character always a line's end (one is added to a
  // last line without). False at the end of the file. Throws ByteError; the lines that came before
  // the damage have been handed out by then.
  bool Next();

  const char* begin() const { return buffer_.data(); }
  const char* end() const { return buffer_.data() + whole_; }
  // Replaces a character in the rest of the block, from `from` on.
  void Replace(const char* from, char old_character, char new_character);
  double FractionRead() const { return bytes_->FractionRead(); }

 private:
  std::unique_ptr<ByteSource> bytes_;
  std::vector<char> buffer_;
  std::size_t filled_ = 0;  // bytes in the buffer
  std::size_t whole_ = 0;   // of them, those of whole lines
  bool at_end_ = false;
};

}  // namespace howl

#endif  // HOWL_IO_RECORDS_TEXT_LINE_BLOCKS_H_

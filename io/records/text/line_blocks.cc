#include "io/records/text/line_blocks.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace howl {
namespace {

constexpr std::size_t kBlockBytes = std::size_t{1} << 18;   // stays in the second-level cache
constexpr std::size_t kLongestLine = std::size_t{1} << 20;  // of thousands of columns

}  // namespace

LineBlocks::LineBlocks(std::unique_ptr<ByteSource> bytes)
    : bytes_(std::move(bytes)), buffer_(kBlockBytes + 1) {}

bool LineBlocks::Next() {
  std::memmove(buffer_.data(), buffer_.data() + whole_, filled_ - whole_);
  filled_ -= whole_;
  whole_ = 0;
  while (!at_end_) {
    if (filled_ + 1 >= buffer_.size()) {
      if (buffer_.size() > kLongestLine)
        throw ByteError("a line of more than 1 MiB, expected a row for each sample");
      buffer_.resize(2 * buffer_.size());
    }
    const std::size_t room = buffer_.size() - 1 - filled_;  // one kept for an added line's end
    const std::size_t got = bytes_->Read(buffer_.data() + filled_, room);
    filled_ += got;
    at_end_ = got < room;
    if (at_end_) break;
    const void* last = memrchr(buffer_.data(), '\n', filled_);
    if (last != nullptr) {
      whole_ = static_cast<std::size_t>(static_cast<const char*>(last) - buffer_.data()) + 1;
      return true;
    }
  }
  if (filled_ == 0) return false;
  if (buffer_[filled_ - 1] != '\n') buffer_[filled_++] = '\n';
  whole_ = filled_;
  return true;
}

void LineBlocks::Replace(const char* from, char old_character, char new_character) {
  const auto first = buffer_.begin() + (from - buffer_.data());
  std::replace(first, buffer_.begin() + static_cast<std::ptrdiff_t>(whole_), old_character,
               new_character);
}

}  // namespace howl

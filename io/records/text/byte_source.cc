#include "io/records/text/byte_source.h"

#include <fcntl.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "io/records/columns/packed_size.h"

namespace howl {
namespace {

class PlainBytes final : public ByteSource {
 public:
  explicit PlainBytes(const std::filesystem::path& file)
      : descriptor_(open(file.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (descriptor_ < 0) throw ByteError(std::string("cannot open: ") + strerror(errno));
    std::error_code ignored;
    const auto size = std::filesystem::file_size(file, ignored);
    size_ = ignored ? 0.0 : static_cast<double>(size);
  }
  ~PlainBytes() override { close(descriptor_); }

  // The first bytes, which Read gives again: a pipe cannot be read twice.
  std::string_view Peek(std::size_t size) {
    peeked_.resize(size);
    peeked_.resize(Take(peeked_.data(), size));
    return peeked_;
  }

  std::size_t Read(char* to, std::size_t size) override {
    std::size_t done = std::min(size, peeked_.size() - given_);
    std::copy_n(peeked_.data() + given_, done, to);
    given_ += done;
    done += Take(to + done, size - done);
    taken_ += static_cast<double>(done);
    return done;
  }

  double FractionRead() const override { return size_ > 0.0 ? taken_ / size_ : 0.0; }

 private:
  std::size_t Take(char* to, std::size_t size) {
    std::size_t done = 0;
    while (done < size) {
      const ssize_t got = read(descriptor_, to + done, size - done);
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) throw ByteError(std::string("cannot read: ") + strerror(errno));
      if (got == 0) break;
      done += static_cast<std::size_t>(got);
    }
    return done;
  }

  int descriptor_;
  std::string peeked_;
  std::size_t given_ = 0;  // of them
  double size_ = 0.0;
  double taken_ = 0.0;
};

// inflate() itself and not gzread(), which passes what follows a damaged header on as plain text.
class GzipBytes final : public ByteSource {
 public:
  explicit GzipBytes(std::unique_ptr<ByteSource> packed)
      : packed_(std::move(packed)), input_(kInputBytes) {
    if (inflateInit2(&stream_, kGzipOnly) != Z_OK) throw ByteError("zlib does not start");
  }
  ~GzipBytes() override { inflateEnd(&stream_); }

  std::size_t Read(char* to, std::size_t size) override {
    std::size_t done = 0;
    while (done < size && !at_end_) {
      if (stream_.avail_in == 0) Refill();
      if (at_end_) break;
      const std::size_t want = std::min<std::size_t>(size - done, kInputBytes * 16);
      stream_.next_out = reinterpret_cast<Bytef*>(to + done);
      stream_.avail_out = static_cast<uInt>(want);
      const int status = inflate(&stream_, Z_NO_FLUSH);
      done += want - stream_.avail_out;
      unpacked_ += static_cast<double>(want - stream_.avail_out);
      if (IsBomb(packed_bytes_, unpacked_)) throw ByteError(kBombWords);
      inside_member_ = status != Z_STREAM_END;
      if (status == Z_STREAM_END) {
        StartNextMember();
      } else if (status != Z_OK && status != Z_BUF_ERROR) {
        throw ByteError(std::string("damaged gzip data") +
                        (stream_.msg != nullptr ? std::string(" (") + stream_.msg + ")" : ""));
      }
    }
    return done;
  }

  double FractionRead() const override { return packed_->FractionRead(); }

 private:
  static constexpr std::size_t kInputBytes = std::size_t{1} << 16;
  static constexpr int kGzipOnly = 15 + 16;

  void Refill() {
    const std::size_t got = packed_->Read(reinterpret_cast<char*>(input_.data()), input_.size());
    stream_.next_in = input_.data();
    stream_.avail_in = static_cast<uInt>(got);
    packed_bytes_ += static_cast<double>(got);
    if (got > 0) return;
    if (inside_member_) throw ByteError("truncated gzip, expected its end");
    at_end_ = true;
  }

  // A gzip file may be several ones in a row; zeros after the last are padding.
  void StartNextMember() {
    if (stream_.avail_in == 0) Refill();
    if (at_end_) return;
    if (*stream_.next_in == 0) {
      at_end_ = true;
      return;
    }
    inflateReset(&stream_);
    inside_member_ = true;
  }

  std::unique_ptr<ByteSource> packed_;
  std::vector<Bytef> input_;
  double packed_bytes_ = 0.0;  // read so far
  double unpacked_ = 0.0;
  z_stream stream_{};
  bool inside_member_ = true;
  bool at_end_ = false;
};

}  // namespace

std::unique_ptr<ByteSource> OpenBytes(const std::filesystem::path& file) {
  auto plain = std::make_unique<PlainBytes>(file);
  if (plain->Peek(2) != "\x1f\x8b") return plain;
  return std::make_unique<GzipBytes>(std::move(plain));
}

}  // namespace howl

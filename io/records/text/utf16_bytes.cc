#include "io/records/text/utf16_bytes.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

namespace howl {
namespace {

constexpr std::size_t kLooked = 64;
constexpr std::size_t kDecodedBytes = std::size_t{1} << 16;

enum class Encoding : std::uint8_t { kOther, kLittleEndian, kBigEndian };

Encoding EncodingOf(const std::string& start) {
  if (start.starts_with("\xff\xfe")) return Encoding::kLittleEndian;
  if (start.starts_with("\xfe\xff")) return Encoding::kBigEndian;
  if (start.size() < 8) return Encoding::kOther;
  bool zero[2] = {true, true};
  bool text[2] = {true, true};
  for (std::size_t i = 0; i < start.size(); ++i) {
    zero[i % 2] = zero[i % 2] && start[i] == '\0';
    text[i % 2] = text[i % 2] && start[i] != '\0';
  }
  if (zero[1] && text[0]) return Encoding::kLittleEndian;
  return zero[0] && text[1] ? Encoding::kBigEndian : Encoding::kOther;
}

// Gives the first bytes, which were inspected already, and then the rest.
class Restored final : public ByteSource {
 public:
  Restored(std::string start, std::unique_ptr<ByteSource> rest)
      : start_(std::move(start)), rest_(std::move(rest)) {}

  std::size_t Read(char* to, std::size_t size) override {
    const std::size_t done = std::min(size, start_.size() - given_);
    std::copy_n(start_.data() + given_, done, to);
    given_ += done;
    return done < size ? done + rest_->Read(to + done, size - done) : done;
  }
  double FractionRead() const override { return rest_->FractionRead(); }

 private:
  std::string start_;
  std::size_t given_ = 0;
  std::unique_ptr<ByteSource> rest_;
};

// Damage that shows at once is reported where the lines are read.
class Damaged final : public ByteSource {
 public:
  // NOLINTNEXTLINE(bugprone-throw-keyword-missing): it is kept for Read, which throws it.
  explicit Damaged(ByteError error) : error_(std::move(error)) {}
  std::size_t Read(char* /*to*/, std::size_t /*size*/) override { throw error_; }
  double FractionRead() const override { return 0.0; }

 private:
  ByteError error_;
};

class Utf16Bytes final : public ByteSource {
 public:
  Utf16Bytes(std::unique_ptr<ByteSource> bytes, bool little_endian)
      : bytes_(std::move(bytes)), little_endian_(little_endian) {}

  std::size_t Read(char* to, std::size_t size) override {
    while (ready_.size() - given_ < size && !at_end_) Convert();
    const std::size_t done = std::min(size, ready_.size() - given_);
    std::copy_n(ready_.data() + given_, done, to);
    given_ += done;
    return done;
  }
  double FractionRead() const override { return bytes_->FractionRead(); }

 private:
  void Convert() {
    ready_.erase(0, given_);
    given_ = 0;
    std::string block(kDecodedBytes, '\0');
    block.resize(bytes_->Read(block.data(), block.size()));
    at_end_ = block.size() < kDecodedBytes;
    if (block.size() % 2 != 0) throw ByteError("UTF-16 text that ends within a character");
    for (std::size_t i = 0; i < block.size(); i += 2) {
      const auto first = static_cast<unsigned char>(block[i]);
      const auto second = static_cast<unsigned char>(block[i + 1]);
      Append(little_endian_ ? first | second << 8U : second | first << 8U);
    }
  }

  void Append(std::uint32_t unit) {
    if (unit >= 0xd800 && unit < 0xdc00) {  // the first half of a pair
      high_ = unit;
      return;
    }
    std::uint32_t code = unit;
    if (unit >= 0xdc00 && unit < 0xe000) code = 0x10000 + ((high_ - 0xd800) << 10U) + unit - 0xdc00;
    const auto put = [&](std::uint32_t byte) { ready_ += static_cast<char>(byte); };
    if (code < 0x80) {
      put(code);
    } else if (code < 0x800) {
      put(0xc0 | code >> 6U);
      put(0x80 | (code & 0x3fU));
    } else if (code < 0x10000) {
      put(0xe0 | code >> 12U);
      put(0x80 | (code >> 6U & 0x3fU));
      put(0x80 | (code & 0x3fU));
    } else {
      put(0xf0 | (code >> 18U & 0x7U));
      put(0x80 | (code >> 12U & 0x3fU));
      put(0x80 | (code >> 6U & 0x3fU));
      put(0x80 | (code & 0x3fU));
    }
  }

  std::unique_ptr<ByteSource> bytes_;
  bool little_endian_;
  std::string ready_;
  std::size_t given_ = 0;  // of them
  std::uint32_t high_ = 0xd800;
  bool at_end_ = false;
};

}  // namespace

std::unique_ptr<ByteSource> AsUtf8(std::unique_ptr<ByteSource> bytes) {
  std::string start(kLooked, '\0');
  try {
    start.resize(bytes->Read(start.data(), start.size()));
  } catch (const ByteError& error) {
    return std::make_unique<Damaged>(error);
  }
  const Encoding encoding = EncodingOf(start);
  auto all = std::make_unique<Restored>(std::move(start), std::move(bytes));
  if (encoding == Encoding::kOther) return all;
  return std::make_unique<Utf16Bytes>(std::move(all), encoding == Encoding::kLittleEndian);
}

}  // namespace howl

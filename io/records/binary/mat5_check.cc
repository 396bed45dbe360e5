#include "io/records/binary/mat5_check.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "io/records/binary/mat5_element.h"
#include "io/records/binary/mat5_nested.h"
#include "io/records/columns/packed_size.h"
#include "io/user_error.h"

namespace howl {
namespace {

using Bytes = std::vector<unsigned char>;

constexpr std::uint32_t kCompressed = 15;
constexpr std::size_t kStart = 4096;  // of a variable, that has its class, dimensions and name

constexpr const char* kDamagedHead =
    "a variable that does not begin as one does, expected a MATLAB file: damaged";

// 0 for a type that is no number.
std::size_t SizeOfType(std::uint32_t type) {
  constexpr std::array<std::size_t, 14> kSizes = {0, 1, 1, 2, 2, 4, 4, 4, 0, 8, 0, 0, 8, 8};
  return type < kSizes.size() ? kSizes[type] : 0;
}

// The fault of a variable, of which `bytes` has the start behind its own tag; empty if there is
// none.
std::string Fault(const Bytes& bytes, const Mat5Words& words, std::string* name) {
  const auto flags = Mat5ElementAt(bytes, 0, words);
  if (!flags || flags->next > bytes.size() || flags->length < 4) return "";
  const std::uint32_t kind = words.At(bytes, flags->begin) & 0xff;
  if (kind < 6 || kind > 15) return "";  // a cell, a structure, text: refused elsewhere
  const auto dimensions = Mat5ElementAt(bytes, flags->next, words);
  if (!dimensions || dimensions->begin + dimensions->length > bytes.size()) return "";
  const auto label = Mat5ElementAt(bytes, dimensions->next, words);
  if (!label || label->begin + label->length > bytes.size()) return "";
  const auto numbers = Mat5ElementAt(bytes, label->next, words);
  if (!numbers || SizeOfType(numbers->type) == 0) return "";
  name->assign(bytes.begin() + static_cast<std::ptrdiff_t>(label->begin),
               bytes.begin() + static_cast<std::ptrdiff_t>(label->begin + label->length));
  double expected = 1.0;
  std::string sizes;
  for (std::size_t i = 0; i + 4 <= dimensions->length; i += 4) {
    const std::uint32_t size = words.At(bytes, dimensions->begin + i);
    expected *= size;
    sizes += (i > 0 ? " x " : "") + std::to_string(size);
  }
  const std::size_t has = numbers->length / SizeOfType(numbers->type);
  if (static_cast<double>(has) == expected) return "";
  return "has " + std::to_string(has) + " numbers, expected " + sizes +
         " by its dimensions: damaged";
}

Bytes Inflated(const Bytes& packed, std::size_t size) {
  Bytes bytes(size);
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) return {};
  stream.next_in = const_cast<Bytef*>(packed.data());
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = bytes.data();
  stream.avail_out = static_cast<uInt>(bytes.size());
  inflate(&stream, Z_SYNC_FLUSH);
  bytes.resize(bytes.size() - stream.avail_out);
  inflateEnd(&stream);
  return bytes;
}

}  // namespace

void CheckMat5(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const auto read = [&](std::uintmax_t at, std::size_t size) {
    Bytes bytes(size);
    in.clear();
    in.seekg(static_cast<std::streamoff>(at));
    in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
    bytes.resize(static_cast<std::size_t>(in.gcount()));
    return bytes;
  };
  const Bytes header = read(0, 128);
  if (header.size() < 128) return;
  const Mat5Words words{header[126] == 'M'};  // "MI" as seen from here: the other byte order
  const std::uintmax_t size = std::filesystem::file_size(file);
  std::uintmax_t at = header.size();
  while (at + kMat5Tag <= size) {
    const Bytes tag = read(at, kMat5Tag);
    const std::uint32_t type = words.At(tag, 0);
    const std::size_t length = words.At(tag, 4);
    Bytes start = read(at + kMat5Tag, std::min(length, kStart));
    const std::uintmax_t begin = at + kMat5Tag;
    at = begin + length;
    if (at > size) break;
    std::size_t stated = length;
    if (type == kCompressed) {
      start = Inflated(start, kStart);
      if (start.size() < kMat5Tag || words.At(start, 0) != kMat5Matrix) {
        throw UserError(file.string(), 0, "", kDamagedHead);
      }
      stated = words.At(start, 4);
      start.erase(start.begin(), start.begin() + kMat5Tag);
    } else if (type != kMat5Matrix) {
      continue;
    }
    if (!HasHead(start, words)) throw UserError(file.string(), 0, "", kDamagedHead);
    std::string name;
    std::string fault = Fault(start, words, &name);
    if (fault.empty() && HoldsOthers(start, words)) {
      if (IsBomb(static_cast<double>(length), static_cast<double>(stated))) {
        throw UserError(file.string(), 0, name, kBombWords);
      }
      Bytes whole = read(begin, length);
      if (type == kCompressed) whole = Inflated(whole, kMat5Tag + stated);
      const std::size_t skipped = type == kCompressed ? std::min(kMat5Tag, whole.size()) : 0;
      fault = FindNestedFault(Mat5Bytes(whole).subspan(skipped), words);
    }
    if (!fault.empty()) throw UserError(file.string(), 0, name, fault);
  }
  if (at > size) {
    throw UserError(file.string(), 0, "",
                    "a truncated MATLAB file of " + std::to_string(size) + " bytes, expected " +
                        std::to_string(at) + " or more");
  }
}

}  // namespace howl

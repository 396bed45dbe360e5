#include "io/records/columns/table_source.h"

#include <algorithm>
#include <charconv>
#include <system_error>

namespace howl {

std::string TableSource::NameOf(const ColumnName& name) const {
  const std::size_t channel = name.rfind(':');
  const bool is_channel =
      channel != std::string::npos && ColumnNumber(name.substr(channel + 1)) > 0;
  if (is_channel) return name.substr(0, channel);
  return ColumnNumber(name) > 0 ? std::string() : name;
}

std::string DisplayName(const ColumnName& name) {
  return ColumnNumber(name) > 0 ? "column " + name : name;
}

std::size_t ColumnNumber(const std::string& name) {
  std::size_t number = 0;
  const char* end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(name.data(), end, number);
  return error == std::errc() && stop == end ? number : 0;
}

std::string ListNames(const std::vector<std::string>& names) {
  constexpr std::size_t kMaxListed = 12;
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), kMaxListed); ++i) {
    list += (i > 0 ? ", " : "") + names[i];
  }
  if (names.size() > kMaxListed) {
    list += " and " + std::to_string(names.size() - kMaxListed) + " more";
  }
  return list;
}

}  // namespace howl

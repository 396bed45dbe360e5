#include "io/records/binary/array_columns.h"

#include <filesystem>
#include <system_error>
#include <unordered_map>

#include "io/memory.h"
#include "io/records/columns/packed_size.h"
#include "io/user_error.h"

namespace howl {
namespace {

constexpr std::size_t kMostChannels = 10'000;  // that are listed

double FileBytes(const std::string& file) {
  std::error_code ignored;
  const auto size = std::filesystem::file_size(file, ignored);
  return ignored ? 0.0 : static_cast<double>(size);
}

std::string Size(const ArrayInfo& array) {
  return std::to_string(array.rows) + " x " + std::to_string(array.columns);
}

std::string ListArrays(const std::vector<ArrayInfo>& arrays) {
  std::vector<std::string> names;
  names.reserve(arrays.size());
  for (const ArrayInfo& array : arrays) {
    names.push_back(array.name + " (" + (array.problem.empty() ? Size(array) : array.problem) +
                    ")");
  }
  return ListNames(names);
}

class Finder {
 public:
  Finder(const std::string& file, const std::vector<ArrayInfo>& arrays)
      : file_(file), arrays_(arrays) {
    for (const ArrayInfo& array : arrays_) by_name_.try_emplace(WithoutRoot(array.name), &array);
  }

  ArrayChannel Find(const ColumnName& name) const {
    if (const ArrayInfo* array = Named(name)) return Channel(*array, name, 0);
    const std::size_t colon = name.rfind(':');
    const std::size_t number =
        colon == std::string::npos ? 0 : ColumnNumber(name.substr(colon + 1));
    if (number > 0) {
      if (const ArrayInfo* array = Named(name.substr(0, colon))) {
        return Channel(*array, name, number);
      }
    }
    if (ColumnNumber(name) > 0) return Channel(OnlyMatrix(name), name, ColumnNumber(name));
    Fail(name, "no such variable, expected one of " + ListArrays(arrays_));
  }

  [[noreturn]] void Fail(const ColumnName& name, const std::string& what) const {
    throw UserError(file_, 0, DisplayName(name), what);
  }

 private:
  static std::string WithoutRoot(const std::string& name) {
    return name.starts_with('/') ? name.substr(1) : name;
  }

  const ArrayInfo* Named(const std::string& name) const {
    const auto found = by_name_.find(WithoutRoot(name));
    return found == by_name_.end() ? nullptr : found->second;
  }

  const ArrayInfo& OnlyMatrix(const ColumnName& name) const {
    const ArrayInfo* only = nullptr;
    for (const ArrayInfo& array : arrays_) {
      if (!array.problem.empty() || array.channels() < 2) continue;
      if (only != nullptr) {
        Fail(name, "more than one matrix, expected NAME:" + name + " of " + ListArrays(arrays_));
      }
      only = &array;
    }
    if (only == nullptr) {
      Fail(name, "no matrix to take a column of, expected one of " + ListArrays(arrays_));
    }
    return *only;
  }

  // `number` from 1, or 0 when a vector is meant.
  ArrayChannel Channel(const ArrayInfo& array, const ColumnName& name, std::size_t number) const {
    if (!array.problem.empty()) Fail(name, array.problem + ", expected real numbers");
    if (number == 0 && array.channels() > 1) {
      Fail(name, "a " + Size(array) + " matrix, expected " + name + ":K with K from 1 to " +
                     std::to_string(array.channels()));
    }
    if (number > array.channels()) {
      Fail(name, "no such column, expected 1 to " + std::to_string(array.channels()) + " of " +
                     array.name + " (" + Size(array) + ")");
    }
    return {static_cast<std::size_t>(&array - arrays_.data()), number > 0 ? number - 1 : 0};
  }

  const std::string& file_;
  const std::vector<ArrayInfo>& arrays_;
  // A file may have as many arrays as bytes allow, and a look at it asks for each by its name.
  std::unordered_map<std::string, const ArrayInfo*> by_name_;
};

}  // namespace

std::vector<ColumnInfo> ListChannels(const std::vector<ArrayInfo>& arrays) {
  std::vector<ColumnInfo> columns;
  for (const ArrayInfo& array : arrays) {
    if (!array.problem.empty() || array.channels() <= 1) {
      columns.push_back({array.name, array.name, array.problem, array.samples()});
      continue;
    }
    if (array.channels() > kMostChannels) {
      columns.push_back({array.name, array.name, "a " + Size(array) + " matrix", array.samples()});
      continue;
    }
    for (std::size_t k = 1; k <= array.channels(); ++k) {
      const std::string name = array.name + ":" + std::to_string(k);
      columns.push_back({name, "", "", array.samples()});
    }
  }
  return columns;
}

std::vector<ArrayChannel> FindChannels(const std::string& file,
                                       const std::vector<ArrayInfo>& arrays,
                                       const std::vector<ColumnName>& names) {
  if (arrays.empty()) {
    throw UserError(file, 0, "", "no variables, expected some: an empty or a truncated file");
  }
  const Finder finder(file, arrays);
  std::vector<ArrayChannel> found;
  for (const ColumnName& name : names) {
    const ArrayChannel channel = finder.Find(name);
    for (const ArrayChannel& other : found) {
      if (other.array == channel.array && other.channel == channel.channel) {
        finder.Fail(name, "the same column is asked for twice");
      }
    }
    found.push_back(channel);
    const std::size_t samples = arrays[channel.array].samples();
    const double bytes = static_cast<double>(sizeof(double)) * static_cast<double>(samples);
    if (bytes * static_cast<double>(names.size()) > MemoryBytes()) {
      finder.Fail(name, std::to_string(samples) +
                            " samples do not fit into the memory, expected a shorter record");
    }
    // Of a matrix all is unpacked, whichever of its channels is read.
    const double all_bytes = bytes * static_cast<double>(arrays[channel.array].channels());
    if (IsBomb(FileBytes(file), all_bytes)) finder.Fail(name, kBombWords);
    const std::size_t expected = arrays[found.front().array].samples();
    if (samples != expected) {
      finder.Fail(name, std::to_string(samples) + " samples, expected " + std::to_string(expected) +
                            " as in " + DisplayName(names.front()));
    }
  }
  return found;
}

}  // namespace howl

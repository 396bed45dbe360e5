#include "app/jobs/unit_store.h"

#include <cstdio>
#include <sstream>
#include <system_error>
#include <utility>

#include "app/files/digest.h"
#include "estimation/unit_seed.h"
#include "model/version.h"

namespace howl {
namespace {

// No unit is longer than its file: a damaged length does not claim memory.
std::uintmax_t LongestUnit(const std::filesystem::path& path) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  return error ? 0 : size;
}

std::uint64_t Hash(const std::string& key, const std::string& bytes) {
  return UnitSeed(0, key + " " + bytes);
}

std::string UnitText(const std::string& key, const std::string& bytes) {
  return key + " " + std::to_string(bytes.size()) + " " + std::to_string(Hash(key, bytes)) + "\n" +
         bytes + "\n";
}

}  // namespace

StoredUnits ReadUnits(const std::filesystem::path& path) {
  StoredUnits stored;
  std::ifstream file(path, std::ios::binary);
  stored.is_there = file.is_open();
  // A device has no units, and may never end.
  std::error_code ignored;
  if (stored.is_there && !std::filesystem::is_regular_file(path, ignored)) return stored;
  if (!std::getline(file, stored.header) || file.eof()) {
    stored.header.clear();  // a header that was not written to its end is nobody's
    return stored;
  }
  stored.end = stored.header.size() + 1;
  const std::uintmax_t longest = LongestUnit(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string key;
    std::size_t size = 0;
    std::uint64_t hash = 0;
    if (!(words >> key >> size >> hash) || size > longest) {
      ++stored.damaged;
      break;
    }
    std::string bytes(size, '\0');
    if (!file.read(bytes.data(), static_cast<std::streamsize>(size)) || file.get() != '\n') {
      ++stored.damaged;
      break;
    }
    stored.end += line.size() + 1 + size + 1;
    if (Hash(key, bytes) != hash) {
      ++stored.damaged;
    } else if (!stored.units.emplace(key, std::move(bytes)).second) {
      stored.repeats_a_key = true;
    }
  }
  return stored;
}

std::string StoreText(std::string_view header, const Units& units) {
  std::string text = std::string(header) + "\n";
  for (const auto& [key, bytes] : units) text += UnitText(key, bytes);
  return text;
}

// The version's number does not move with every change of a fit.
std::string ProgramIdentity() {
  static const std::string identity =
      std::string(Version()) + "-" + Sha256OfFile("/proc/self/exe").value_or("unknown");
  return identity;
}

UnitStore::UnitStore(std::filesystem::path path, const std::string& header)
    : path_(std::move(path)), stored_(ReadUnits(path_)) {
  std::error_code ignored;
  std::filesystem::create_directories(path_.parent_path(), ignored);
  if (stored_.is_there && stored_.header == header && !stored_.repeats_a_key) {
    std::filesystem::resize_file(path_, stored_.end, ignored);
    log_.open(path_, std::ios::binary | std::ios::app);
    return;
  }
  refused_ = stored_.is_there;
  stored_ = {};
  log_.open(path_, std::ios::binary | std::ios::trunc);
  log_ << header << "\n" << std::flush;
}

void UnitStore::Append(const std::string& key, const std::string& bytes) {
  const std::lock_guard<std::mutex> hold(lock_);
  log_ << UnitText(key, bytes) << std::flush;
}

void UnitStore::Forget() {
  log_.close();
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

void SayWhereItGoesOn(const UnitStore& store, const std::filesystem::path& path) {
  if (!store.found().empty()) {
    const std::string anew = store.damaged() == 0 ? "" : ", what was damaged there is done anew";
    std::fprintf(stderr, "going on from %s: %zu fits are done%s\n", path.c_str(),
                 store.found().size(), anew.c_str());
  } else if (store.refused()) {
    std::fprintf(stderr, "%s is of another build or of other inputs: begun anew\n", path.c_str());
  }
}

}  // namespace howl

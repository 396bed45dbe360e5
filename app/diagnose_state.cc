#include "app/diagnose_state.h"

#include <sstream>
#include <system_error>

#include "app/digest.h"
#include "estimation/unit_seed.h"
#include "model/version.h"

namespace howl {
namespace {

constexpr std::size_t kLongestEntry = 1'000'000'000;
// 2: every unit of work has a key of its own. 3: the hash is of the key as well.
constexpr int kFormat = 3;

std::uint64_t Hash(const std::string& key, const std::string& bytes) {
  return UnitSeed(0, key + " " + bytes);
}

// The version's number does not move with every change of a fit.
std::string Build() {
  return std::string(Version()) + "-" + Sha256OfFile("/proc/self/exe").value_or("unknown");
}

}  // namespace

DiagnoseState::DiagnoseState(const std::filesystem::path& path, const std::string& inputs)
    : path_(path) {
  const std::string header = "howl.diagnosis.state/" + std::to_string(kFormat) + " " + Build() +
                             " " + Sha256(inputs) + "\n";
  std::error_code ignored;
  std::filesystem::create_directories(path.parent_path(), ignored);
  const bool was_there = std::filesystem::exists(path, ignored);
  const std::uintmax_t end = Load(header);
  refused_ = was_there && end == 0;
  if (end > 0) {
    std::filesystem::resize_file(path, end, ignored);
    log_.open(path, std::ios::binary | std::ios::app);
  } else {
    log_.open(path, std::ios::binary | std::ios::trunc);
    log_ << header << std::flush;
  }
}

std::uintmax_t DiagnoseState::Load(const std::string& header) {
  std::ifstream file(path_, std::ios::binary);
  std::string line;
  if (!std::getline(file, line) || line + "\n" != header) return 0;
  std::uintmax_t end = header.size();
  while (std::getline(file, line)) {
    std::istringstream words(line);
    std::string key;
    std::size_t size = 0;
    std::uint64_t hash = 0;
    if (!(words >> key >> size >> hash) || size > kLongestEntry) {
      ++damaged_;
      break;
    }
    std::string bytes(size, '\0');
    if (!file.read(bytes.data(), static_cast<std::streamsize>(size)) || file.get() != '\n') {
      ++damaged_;
      break;
    }
    end += line.size() + 1 + size + 1;
    if (Hash(key, bytes) != hash) {
      ++damaged_;
      continue;
    }
    if (!found_.emplace(key, std::move(bytes)).second) {
      found_.clear();
      return 0;
    }
  }
  return end;
}

std::optional<std::string> DiagnoseState::Recall(const std::string& key) {
  {
    const std::lock_guard<std::mutex> hold(lock_);
    asked_.Take(key);
  }
  const auto found = found_.find(key);
  if (found == found_.end()) return std::nullopt;
  return found->second;
}

void DiagnoseState::Keep(const std::string& key, const std::string& bytes) {
  const std::lock_guard<std::mutex> hold(lock_);
  kept_.Take(key);
  // With a full disk the run cannot be resumed, but the diagnosis goes on.
  log_ << key << " " << bytes.size() << " " << Hash(key, bytes) << "\n"
       << bytes << "\n"
       << std::flush;
}

void DiagnoseState::Forget() {
  log_.close();
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

}  // namespace howl

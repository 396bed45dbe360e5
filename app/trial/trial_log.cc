#include "app/trial/trial_log.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>

#include "app/files/digest.h"
#include "io/json_fields.h"
#include "io/json_text.h"
#include "io/user_error.h"
#include "io/whole_file.h"

namespace howl {

TrialLog::TrialLog() : last_hash_(Sha256("")) {}

TrialLog::TrialLog(std::filesystem::path path) : TrialLog() {
  path_ = std::move(path);
  const std::optional<std::string> text = ReadWholeFile(path_);
  if (!text) return;
  const std::size_t whole = Read(*text);
  if (whole < text->size()) std::filesystem::resize_file(path_, whole);
}

TrialLog::TrialLog(TrialLog&& other) noexcept
    : path_(std::move(other.path_)),
      entries_(std::move(other.entries_)),
      last_hash_(std::move(other.last_hash_)),
      broken_line_(other.broken_line_) {}

TrialLog TrialLog::Parse(const std::string& text) {
  TrialLog log;
  log.Read(text);
  return log;
}

std::size_t TrialLog::Read(const std::string& text) {
  std::size_t from = 0;
  std::size_t to = 0;
  while ((to = text.find('\n', from)) != std::string::npos) {
    const std::string line = text.substr(from, to - from);
    from = to + 1;
    nlohmann::json entry = ParseJsonOrNone<nlohmann::json>(line);
    const bool holds = entry.is_object() && TextAt(entry, "previous") == last_hash_;
    if (!holds && broken_line_ == 0) broken_line_ = entries_.size() + 1;
    last_hash_ = Sha256(line);
    entries_.push_back(entry.is_object() ? std::move(entry) : nlohmann::json::object());
  }
  return from;
}

void TrialLog::Append(nlohmann::ordered_json entry) {
  const std::lock_guard<std::mutex> hold(lock_);
  entry["previous"] = last_hash_;
  const std::string line = JsonText(entry) + "\n";
  const int file = open(path_.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
  const bool written = file >= 0 &&
                       write(file, line.data(), line.size()) == static_cast<ssize_t>(line.size()) &&
                       fsync(file) == 0;
  const std::string reason = std::strerror(errno);
  if (file >= 0) close(file);
  if (!written) throw UserError(path_.string(), 0, "", "cannot be written: " + reason);
  last_hash_ = Sha256(std::string_view(line).substr(0, line.size() - 1));
  entries_.push_back(nlohmann::json::parse(line));
}

std::optional<nlohmann::json> TrialLog::Find(const std::string& event) const {
  for (const nlohmann::json& entry : entries_) {
    if (TextAt(entry, "event") == event) return entry;
  }
  return std::nullopt;
}

std::string TimeStamp() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text.data();
}

}  // namespace howl

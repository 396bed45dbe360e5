#include "io/results/reference_file.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string_view>

#include "io/json_text.h"
#include "io/user_error.h"

namespace howl {
namespace {

using Json = nlohmann::ordered_json;

// Values this close to zero compare as absolute differences.
constexpr double kZero = 1e-9;

// Text that tells how a fit went and not what it found, and is not compared.
bool IsIncidental(const std::string& key) {
  return key == "termination" || key == "iterations" || key == "starts" || key == "text";
}

std::string Joined(const std::string& name, const std::string& key) {
  return name.empty() ? key : name + "." + key;
}

std::string Shortened(const Json& json) {
  constexpr std::size_t kLongest = 60;
  std::string text = json.dump();
  if (text.size() > kLongest) text = text.substr(0, kLongest) + "...";
  return text;
}

std::string_view KindOf(const Json& json) {
  if (json.is_number()) return "a number";
  if (json.is_string()) return "a text";
  if (json.is_boolean()) return "true or false";
  if (json.is_array()) return "a list";
  if (json.is_object()) return "a mapping";
  return "null";
}

// An item of a list: its experiment and name where it has them, else its number.
std::string LabelOf(const Json& item, std::size_t number) {
  const auto text = [&](const char* key) -> std::string {
    const bool has = item.is_object() && item.contains(key) && item[key].is_string();
    return has ? item[key].get<std::string>() : "";
  };
  const std::string name = text("name");
  if (name.empty()) return std::to_string(number);
  const std::string experiment = text("experiment");
  return experiment.empty() ? name : experiment + "." + name;
}

class Comparison {
 public:
  Comparison(const std::filesystem::path& path, double tolerance)
      : path_(path), tolerance_(tolerance) {}

  void Compare(const std::string& name, const Json& stored, const Json& fresh) {
    CheckKind(name, stored, fresh);
    if (stored.is_number() && fresh.is_number()) {
      const double a = stored.get<double>();
      const double b = fresh.get<double>();
      if (!(std::abs(a - b) <= tolerance_ * std::max(std::abs(a), std::abs(b)) + kZero)) {
        Differs(name, stored, fresh);
      }
    } else if (stored.is_object() && fresh.is_object()) {
      CompareMappings(name, stored, fresh);
    } else if (stored.is_array() && fresh.is_array() && stored.size() == fresh.size()) {
      CompareLists(name, stored, fresh);
    } else if (stored != fresh) {
      Differs(name, stored, fresh);
    }
  }

  std::vector<MovedFigure> Moved() && { return std::move(moved_); }

 private:
  // Null stands for a number that is not finite, or for what is not known.
  void CheckKind(const std::string& name, const Json& stored, const Json& fresh) const {
    if (stored.is_null() || fresh.is_null() || KindOf(stored) == KindOf(fresh)) return;
    throw UserError(path_.string(), 0, name,
                    "is " + Shortened(stored) + ", expected " + std::string(KindOf(fresh)));
  }

  void Differs(const std::string& name, const Json& stored, const Json& fresh) {
    moved_.push_back({name, Shortened(stored), Shortened(fresh)});
  }

  void CompareMappings(const std::string& name, const Json& stored, const Json& fresh) {
    for (const auto& [key, value] : stored.items()) {
      if (IsIncidental(key)) continue;
      if (key == "digests") {
        CompareDigests(Joined(name, key), value, fresh.value(key, Json::array()));
      } else if (fresh.contains(key)) {
        Compare(Joined(name, key), value, fresh[key]);
      } else {
        moved_.push_back({Joined(name, key), Shortened(value), "missing"});
      }
    }
    for (const auto& [key, value] : fresh.items()) {
      if (IsIncidental(key) || stored.contains(key)) continue;
      moved_.push_back({Joined(name, key), "missing", Shortened(value)});
    }
  }

  void CompareLists(const std::string& name, const Json& stored, const Json& fresh) {
    for (std::size_t i = 0; i < stored.size(); ++i) {
      const Json& item = stored[i];
      Compare(name + "[" + LabelOf(item, i) + "]", item, fresh[i]);
    }
  }

  // Members are the same where one digest is.
  void CompareDigests(const std::string& name, const Json& stored, const Json& fresh) {
    CheckKind(name, stored, fresh);
    for (std::size_t i = 0; i < std::min(stored.size(), fresh.size()); ++i) {
      if (stored[i] == fresh[i]) return;
    }
    Differs(name, stored, fresh);
  }

  const std::filesystem::path& path_;
  const double tolerance_;
  std::vector<MovedFigure> moved_;
};

int LineOfByte(const std::string& text, std::size_t byte) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(byte, text.size()));
  return 1 + static_cast<int>(std::count(text.begin(), end, '\n'));
}

}  // namespace

Json ReadReference(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    throw UserError(path.string(), 0, "",
                    "no stored results, expected the file that howl regress --update writes");
  }
  std::stringstream content;
  content << file.rdbuf();
  const std::string text = content.str();
  Json reference;
  try {
    reference = ParseJson<Json>(text);
  } catch (const Json::parse_error& error) {
    throw UserError(path.string(), LineOfByte(text, error.byte), "",
                    "not JSON, expected stored results");
  } catch (const JsonTooDeep& error) {
    throw UserError(path.string(), 0, "", error.what());
  } catch (const Json::exception&) {  // a number that is too large
    throw UserError(path.string(), 0, "", "a number is out of range, expected stored results");
  }
  const Json schema =
      reference.is_object() ? reference.value("schema", Json(nullptr)) : Json(nullptr);
  if (schema != kReferenceSchema && schema != kReferenceSchemaBefore) {
    throw UserError(path.string(), 0, "schema",
                    "is " + Shortened(schema) + ", expected \"" + kReferenceSchema +
                        "\" as howl regress --update writes it");
  }
  return reference;
}

std::vector<MovedFigure> CompareReference(const std::filesystem::path& path, const Json& stored,
                                          const Json& fresh, double tolerance) {
  Comparison comparison(path, tolerance);
  comparison.Compare("", stored, fresh);
  return std::move(comparison).Moved();
}

}  // namespace howl

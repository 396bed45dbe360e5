#include "io/records/mat5_nested.h"

namespace howl {
namespace {

constexpr std::uint32_t kCell = 1;
constexpr std::uint32_t kStruct = 2;
constexpr std::uint32_t kObject = 3;
constexpr int kDeepest = 32;

constexpr const char* kFault = "a cell array or structure that has less than it states: damaged";
constexpr const char* kTooDeep = "cell arrays and structures within one another, expected fewer";

std::uint32_t ClassOf(Mat5Bytes variable, const Mat5Words& words) {
  const auto flags = Mat5ElementAt(variable, 0, words);
  if (!flags || flags->next > variable.size() || flags->length < 4) return 0;
  return words.At(variable, flags->begin) & 0xff;
}

bool IsNested(std::uint32_t kind) { return kind >= kCell && kind <= kObject; }

std::string Fault(Mat5Bytes variable, const Mat5Words& words, int depth) {
  const std::uint32_t kind = ClassOf(variable, words);
  if (kind == 0) return "";  // an empty cell has no more than its tag
  const auto inside = [&](const Mat5Element& element) {
    return element.begin + element.length <= variable.size();
  };
  const auto flags = Mat5ElementAt(variable, 0, words);
  const auto dimensions = Mat5ElementAt(variable, flags->next, words);
  if (!dimensions || !inside(*dimensions)) return kFault;
  const auto name = Mat5ElementAt(variable, dimensions->next, words);
  if (!name || !inside(*name)) return kFault;
  double places = 1.0;
  for (std::size_t i = 0; i + 4 <= dimensions->length; i += 4) {
    places *= words.At(variable, dimensions->begin + i);
  }
  std::size_t at = name->next;
  if (!IsNested(kind)) {
    // Each number, or letter, takes a byte or more; zeros of a sparse matrix none.
    constexpr std::uint32_t kSparse = 5;
    const bool has_room = places <= static_cast<double>(variable.size()) || kind == kSparse;
    return has_room ? "" : kFault;
  }
  if (depth == kDeepest) return kTooDeep;
  if (kind == kObject) {  // the name of its class
    const auto class_name = Mat5ElementAt(variable, at, words);
    if (!class_name || !inside(*class_name)) return kFault;
    at = class_name->next;
  }
  if (kind != kCell) {
    const auto width = Mat5ElementAt(variable, at, words);
    if (!width || !inside(*width) || width->length < 4) return kFault;
    const std::uint32_t letters = words.At(variable, width->begin);
    const auto names = Mat5ElementAt(variable, width->next, words);
    if (!names || !inside(*names) || letters == 0) return kFault;
    places *= static_cast<double>(names->length / letters);
    at = names->next;
  }
  const std::size_t left = at < variable.size() ? variable.size() - at : 0;
  if (places * kMat5Tag > static_cast<double>(left)) return kFault;
  for (double place = 0.0; place < places; place += 1.0) {
    const auto element = Mat5ElementAt(variable, at, words);
    if (!element || element->type != kMat5Matrix || !inside(*element)) return kFault;
    const std::string fault =
        Fault(variable.subspan(element->begin, element->length), words, depth + 1);
    if (!fault.empty()) return fault;
    at = element->next;
  }
  return "";
}

}  // namespace

bool HoldsOthers(Mat5Bytes variable, const Mat5Words& words) {
  return IsNested(ClassOf(variable, words));
}

std::string FindNestedFault(Mat5Bytes variable, const Mat5Words& words) {
  return Fault(variable, words, 0);
}

}  // namespace howl

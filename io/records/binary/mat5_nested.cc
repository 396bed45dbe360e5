#include "io/records/binary/mat5_nested.h"

#include <optional>

namespace howl {
namespace {

constexpr std::uint32_t kCell = 1;  // 2 is a structure
constexpr std::uint32_t kObject = 3;
constexpr int kDeepest = 32;

constexpr const char* kFault = "a cell array or structure that has less than it states: damaged";
constexpr const char* kTooDeep = "cell arrays and structures within one another, expected fewer";

constexpr std::uint32_t kSparse = 5;
constexpr std::uint32_t kFunction = 16;
constexpr std::uint32_t kOpaque = 17;  // without dimensions; its name follows the flags

constexpr std::uint32_t kInt8 = 1;
constexpr std::uint32_t kInt32 = 5;
constexpr std::uint32_t kUInt32 = 6;

// What every variable begins with.
struct Head {
  std::uint32_t kind = 0;
  double places = 1.0;  // the product of its dimensions
  std::size_t end = 0;
};

bool IsInside(const Mat5Element& element, Mat5Bytes variable) {
  return element.begin + element.length <= variable.size();
}

// No value for a head that no program writes. matio does not look at the lengths that it states,
// and reads on elsewhere than they say.
std::optional<Head> ReadHead(Mat5Bytes variable, const Mat5Words& words) {
  const auto flags = Mat5ElementAt(variable, 0, words);
  if (!flags || flags->type != kUInt32 || flags->length != 8 || !IsInside(*flags, variable)) {
    return std::nullopt;
  }
  Head head{words.At(variable, flags->begin) & 0xff, 1.0, flags->next};
  if (head.kind < kCell || head.kind > kOpaque) return std::nullopt;
  if (head.kind >= kFunction) return head;
  const auto dimensions = Mat5ElementAt(variable, flags->next, words);
  if (!dimensions || dimensions->type != kInt32 || dimensions->length < 8 ||
      dimensions->length % 4 != 0 || !IsInside(*dimensions, variable)) {
    return std::nullopt;
  }
  const auto name = Mat5ElementAt(variable, dimensions->next, words);
  if (!name || name->type != kInt8 || !IsInside(*name, variable)) return std::nullopt;
  for (std::size_t i = 0; i < dimensions->length; i += 4) {
    head.places *= words.At(variable, dimensions->begin + i);
  }
  head.end = name->next;
  return head;
}

bool IsNested(std::uint32_t kind) { return kind >= kCell && kind <= kObject; }

std::string Fault(Mat5Bytes variable, const Mat5Words& words, int depth) {
  if (variable.empty()) return "";  // an empty cell has no more than its tag
  const std::optional<Head> head = ReadHead(variable, words);
  if (!head) return kFault;
  double places = head->places;
  std::size_t at = head->end;
  if (!IsNested(head->kind)) {
    // Each number, or letter, takes a byte or more; zeros of a sparse matrix none.
    const bool may_be_short = head->kind == kSparse || head->kind >= kFunction;
    return may_be_short || places <= static_cast<double>(variable.size()) ? "" : kFault;
  }
  if (depth == kDeepest) return kTooDeep;
  if (head->kind == kObject) {  // the name of its class
    const auto class_name = Mat5ElementAt(variable, at, words);
    if (!class_name || !IsInside(*class_name, variable)) return kFault;
    at = class_name->next;
  }
  if (head->kind != kCell) {
    const auto width = Mat5ElementAt(variable, at, words);
    if (!width || width->length != 4 || !IsInside(*width, variable)) return kFault;
    const std::uint32_t letters = words.At(variable, width->begin);
    const auto names = Mat5ElementAt(variable, width->next, words);
    if (!names || !IsInside(*names, variable) || letters == 0) return kFault;
    const std::size_t fields = names->length / letters;
    places *= static_cast<double>(fields);
    at = names->next;
  }
  const std::size_t left = at < variable.size() ? variable.size() - at : 0;
  if (places * kMat5Tag > static_cast<double>(left)) return kFault;
  for (double place = 0.0; place < places; place += 1.0) {
    const auto element = Mat5ElementAt(variable, at, words);
    if (!element || element->type != kMat5Matrix || !IsInside(*element, variable)) return kFault;
    std::string fault = Fault(variable.subspan(element->begin, element->length), words, depth + 1);
    if (!fault.empty()) return fault;
    at = element->next;
  }
  return "";
}

}  // namespace

bool HasHead(Mat5Bytes variable, const Mat5Words& words) {
  return ReadHead(variable, words).has_value();
}

bool HoldsOthers(Mat5Bytes variable, const Mat5Words& words) {
  const std::optional<Head> head = ReadHead(variable, words);
  return head && IsNested(head->kind);
}

std::string FindNestedFault(Mat5Bytes variable, const Mat5Words& words) {
  return Fault(variable, words, 0);
}

}  // namespace howl

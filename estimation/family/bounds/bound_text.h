// The searches of an interrupted run as text, exact: numbers are hexadecimal floating point. A
// head, then each search, one after another:
//
//   howl.enclosure/2 <searches> <experiments>, then for each search a line of its length in bytes
//   and their hash, a line of its state, draws, counts, ends and witness, and a line for every cell
//   of its heap
//
// What is bounded is not written: it follows from the problem and the options.
#ifndef HOWL_ESTIMATION_FAMILY_BOUNDS_BOUND_TEXT_H_
#define HOWL_ESTIMATION_FAMILY_BOUNDS_BOUND_TEXT_H_

#include <cstddef>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "estimation/family/bounds/bound_search.h"

namespace howl {

std::string BoundSearchHead(std::size_t experiments, std::size_t searches);
std::string BoundSearchText(const BoundSearch& search);

// Into searches of the same problem and options. A search whose bytes do not have their hash is
// left as it was, and counted: each is a unit of its own. No value where the text is not of this
// form, or of another problem; the searches are then all as they were.
std::optional<std::size_t> ReadBoundSearches(std::istream& in, std::size_t experiments,
                                             std::vector<BoundSearch>& searches);

// Of the same text, how many searches are damaged.
std::size_t CountDamagedSearches(std::istream& in);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_BOUNDS_BOUND_TEXT_H_

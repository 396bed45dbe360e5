// The searches of an interrupted run as text, exact: numbers are hexadecimal floating point.
//
//   howl.enclosure/1 <searches> <experiments>, then for each search a line of its state, draws,
//   counts, ends and witness, and a line for every cell of its heap
//
// What is bounded is not written: it follows from the problem and the options.
#ifndef HOWL_ESTIMATION_FAMILY_BOUND_TEXT_H_
#define HOWL_ESTIMATION_FAMILY_BOUND_TEXT_H_

#include <cstddef>
#include <iosfwd>
#include <vector>

#include "estimation/family/bound_search.h"

namespace howl {

void WriteBoundSearches(std::ostream& out, std::size_t experiments,
                        const std::vector<BoundSearch>& searches);

// Into searches of the same problem and options. False on anything else than what was written; the
// searches are then as they were.
bool ReadBoundSearches(std::istream& in, std::size_t experiments,
                       std::vector<BoundSearch>& searches);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_BOUND_TEXT_H_

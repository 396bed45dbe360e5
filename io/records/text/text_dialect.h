// Which dialect makes a table of a text file's first lines: the hint of a message, and howl init's
// guess.
#ifndef HOWL_IO_RECORDS_TEXT_TEXT_DIALECT_H_
#define HOWL_IO_RECORDS_TEXT_TEXT_DIALECT_H_

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "io/record_spec.h"

namespace howl {

inline constexpr std::size_t kDialectLines = 100;

// `lines`: the file's first ones, kDialectLines at most. The dialect that is nearest to `stated`
// (first with its decimal sign, then with the other; few skipped rows before many) under which the
// lines are rows of as many numbers each, a header and a units row before them apart; if there is
// none, the one under which they are rows of numbers and texts. No value without such rows.
std::optional<TextDialect> GuessDialect(std::span<const std::string_view> lines,
                                        const TextDialect& stated = {});

// What to change of `stated`, as the end of a message: "; the rows look like numbers with a decimal
// comma, expected decimal: "," in the record". Empty where nothing else makes a table.
std::string DialectHint(std::span<const std::string_view> lines, const TextDialect& stated);

}  // namespace howl

#endif  // HOWL_IO_RECORDS_TEXT_TEXT_DIALECT_H_

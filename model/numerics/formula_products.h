// Formulas (formula.h) in which a product may be written without its sign, as in "2 pi 400". After
// a division it may not, since "s / 2 pi" can be read in two ways, nor between two numbers, "2
// 000".
#ifndef HOWL_MODEL_NUMERICS_FORMULA_PRODUCTS_H_
#define HOWL_MODEL_NUMERICS_FORMULA_PRODUCTS_H_

#include "model/numerics/formula.h"

namespace howl {

// No value on an error, which is then told.
std::optional<std::vector<FormulaToken>> ParseFormulaWithProducts(std::string_view text,
                                                                  const FormulaNames& names,
                                                                  FormulaError& error);

}  // namespace howl

#endif  // HOWL_MODEL_NUMERICS_FORMULA_PRODUCTS_H_

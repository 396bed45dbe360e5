// Prints a diagnosis on the terminal: where the gap is, which effect causes it, how large and how
// certain it is, and what to measure next.
#ifndef HOWL_APP_TEXT_DIAGNOSE_TEXT_H_
#define HOWL_APP_TEXT_DIAGNOSE_TEXT_H_

#include "diagnosis/verdict/diagnosis_result.h"

namespace howl {

// Writes to standard output.
void PrintDiagnosis(const Diagnosis& diagnosis);

}  // namespace howl

#endif  // HOWL_APP_TEXT_DIAGNOSE_TEXT_H_

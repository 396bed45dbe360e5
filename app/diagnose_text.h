// What a diagnosis says on the terminal: where, which, how much, how sure, what next.
#ifndef HOWL_APP_DIAGNOSE_TEXT_H_
#define HOWL_APP_DIAGNOSE_TEXT_H_

#include "diagnosis/diagnosis.h"

namespace howl {

// On standard output.
void PrintDiagnosis(const Diagnosis& diagnosis);

}  // namespace howl

#endif  // HOWL_APP_DIAGNOSE_TEXT_H_

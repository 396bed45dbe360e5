// howl diagnose without records: the diagnosis from a table of characteristics
// (diagnosis/table/table_diagnosis.h).
#ifndef HOWL_APP_DIAGNOSE_DIAGNOSE_TABLE_H_
#define HOWL_APP_DIAGNOSE_DIAGNOSE_TABLE_H_

#include "app/command_line/options.h"
#include "io/config/config.h"

namespace howl {

// Writes diagnosis.json, prints the bounds. Throws UserError where the table has no lines.
int RunTable(const Config& config, const Options& options);

}  // namespace howl

#endif  // HOWL_APP_DIAGNOSE_DIAGNOSE_TABLE_H_

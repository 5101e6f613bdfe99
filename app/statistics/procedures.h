// Every procedure of `seldinger stats`, whichever shelf it lies on: command, help, docs/statistics.md and tests
// loop over this.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "assessment/statistics/procedure.h"

namespace seldinger::app {

// In the order of docs/statistics.md: by shelf.
std::span<const assessment::statistics::Procedure> procedures();
// nullptr: there is none of that name.
const assessment::statistics::Procedure* find_procedure(std::string_view name);

// An example of it, without "seldinger stats": the files are those of docs/statistics.
struct ProcedureExample {
  const char* procedure;
  const char* words;
};
std::span<const ProcedureExample> procedure_examples();

// docs/statistics.md.
std::string procedures_markdown();

}  // namespace seldinger::app

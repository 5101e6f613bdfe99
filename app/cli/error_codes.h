// Every code that an error, a finding or a warning may have: what it means and what to do about it. `seldinger help
// --errors` prints the table to docs/errors.md; tests/docs/error_codes_test.cpp holds it against the sources.
#pragma once

#include <span>
#include <string>

namespace seldinger::app {

// How a code comes out; more than one bit where it depends.
enum CodeKind : unsigned {
  kRefuses = 1,   // the input is refused, or a reason beside the first: exit 3
  kFails = 2,     // the environment fails: exit 4
  kFinds = 4,     // a check ran and found this: exit 1
  kMisused = 16,  // the command was called wrongly: exit 2
  kWarns = 8      // noticed and kept with the case, nothing is refused
};

struct ErrorCode {
  const char* code;  // stable, snake_case; one meaning has one code
  unsigned kinds;
  const char* meaning;
  const char* remedy;  // empty: nothing is asked
};

struct ErrorCodeSection {
  const char* title;
  std::span<const ErrorCode> codes;
};

std::span<const ErrorCodeSection> error_codes();

// docs/errors.md.
std::string errors_markdown();

}  // namespace seldinger::app

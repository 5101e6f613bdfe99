// Erasing: what a person did, an attempt, a case. Nothing of it is left in the library: not in its rows, in freed
// pages, in the write-ahead log, in assets/, nor in the copies of older schemas that lie beside the databases; an
// empty row tells that something was there, when it went and who erased it. Backups and exports that were made
// before are out of reach. Throws base::Failure ("disk", "database").
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "casedb/database/library.h"
#include "sim/base/result.h"

namespace seldinger::casedb {

struct Erased {
  std::size_t attempts = 0;     // also those that were still open
  std::size_t assets = 0;       // files
  std::size_t old_copies = 0;   // of the databases, from before a change of the schema
  std::size_t kept_copies = 0;  // of these, which could not be deleted
  // False: another program was reading the library all the time, so that old bytes lie in its log until the last
  // one closes it; in pages, what is deleted is overwritten at once.
  bool overwritten = true;
};

// In each, `by` is the id of who erases; none: whoever has the library's files.

// The name, the account, what the person said of themselves, to which cohorts they belonged, their attempts and the
// notes they wrote. Consents stay as withdrawn, and what they decided about cases, as somebody's of whom nothing is
// known. `no_user`; an erasure that was interrupted is finished by asking again: the name goes last.
base::Result<Erased> erase_person(Library& library, const std::string& name, const std::optional<std::string>& by);
// The attempts of somebody who stays; where there are none, and no old copies, nothing is done. `no_person`.
base::Result<Erased> erase_attempts_of(Library& library, const std::string& person_id,
                                       const std::optional<std::string>& by);
base::Result<Erased> erase_attempt(Library& library, const std::string& attempt_id,
                                   const std::optional<std::string>& by);  // `no_attempt`
// A draft or a retired case on which nobody has made an attempt: `no_case`, `bad_state`, `has_attempts`.
base::Result<Erased> erase_case(Library& library, const std::string& case_id, const std::optional<std::string>& by);

// What refers to a person: removed with them, or kept on the empty row. Every such column of the schema is in one
// of the two; a test compares.
struct PersonColumn {
  std::string_view table, column;
};
std::span<const PersonColumn> removed_with_a_person();
std::span<const PersonColumn> kept_of_a_person();

}  // namespace seldinger::casedb

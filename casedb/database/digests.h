// What the rows of each table hold, as one number for whom they belong to (table `digest`): by it a bit that turned
// over on the disk is told, and a row that somebody changed past the program. A Transaction keeps it (sqlite.h). It
// guards against disks, not against people: whoever writes rows with this program's library writes their digests.
// Pieces of recordings have a checksum of their own; here it stands for them.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "casedb/database/sqlite.h"
#include "sim/base/result.h"

namespace seldinger::casedb {

// Table and id: the rows' first column; where single rows go while others of it stay (told_by_two), the first two
// with '/' between. Before schema 21 of the library metrics, steps and conditions had the first two, and nothing
// else.
using DigestOf = std::pair<std::string, std::string>;

bool has_digests(Sqlite& database);
// By how much (XOR) what is there differs from what was stored, where it does; empty where all holds. The schema
// itself is looked at too, as the table sqlite_schema.
std::map<DigestOf, std::uint64_t> digest_differences(Sqlite& database);
std::string in_words(const DigestOf& whose);  // naming no person
// The same in words: `value_damaged`.
std::vector<base::Problem> damaged_values(Sqlite& database);

// Within a transaction: takes what is there now as it is, save that what differed still does by as much.
void renew_digests(Sqlite& database, const std::map<DigestOf, std::uint64_t>& differences);
// By XOR; a digest of 0 is none. With the difference of digest_differences() the rows as they are become what was
// stored.
void change_digest(Sqlite& database, const DigestOf& whose, std::uint64_t by);
// Within a transaction: of rows that are gone, whatever was damaged of them.
void forget_if_gone(Sqlite& database, const DigestOf& whose);
void forget_digests(Sqlite& database, const std::string& id);  // of all of an attempt, a case or a person

// The condition on a table's rows that belong to :id; by the table's own key.
std::string rows_of_digest(Sqlite& database, const std::string& table);

}  // namespace seldinger::casedb

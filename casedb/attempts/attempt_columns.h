// Attempts as rows: what the tables of stored and of open ones have in common.
#pragma once

#include <string>
#include <vector>

#include "casedb/attempts/attempts.h"
#include "casedb/database/sqlite.h"

namespace seldinger::casedb {

Statement& bind_head(Statement& insert, const std::string& attempt_id, const AttemptHead& head);
AttemptHead read_head(const Statement& from);
// Within the transaction that inserts it: `no_case`, `no_lesion`, `no_person`.
base::Result<void> check_head(Sqlite& database, const AttemptHead& head);

Statement& bind_chunk(Statement& insert, const std::string& attempt_id, const cases::RecordingChunk& chunk);
// `rows` asks for one attempt's chunks in order.
std::vector<cases::RecordingChunk> read_chunks(Statement rows, const std::string& attempt_id);

void insert_servo_record(Sqlite& database, const std::string& attempt_id, const cases::ServoRecord& record);
cases::ServoRecord read_servo_record(const Statement& row);

// Those that are known, into a table by its question; and back, from one attempt's rows. What today's table does
// not have, or not so, is left out.
void insert_conditions(Sqlite& database, const char* into, const std::string& attempt_id,
                       const Conditions& conditions);
Conditions read_conditions(Statement rows, const std::string& attempt_id);

MetricValue read_metric(const Statement& from);

// For json_each: ids are hexadecimal digits and dashes, so nothing in them needs to be escaped (CHECKed).
std::string json_of_ids(const std::vector<std::string>& ids);

AttemptEnd end_from(const std::string& name);  // CHECKs that there is one of that name

}  // namespace seldinger::casedb

// A case's setting in the columns of training_case; its needle and approach are in those of attempts too.
#pragma once

#include "casedb/cases/case_setting.h"
#include "casedb/database/sqlite.h"
#include "sim/base/result.h"

namespace seldinger::casedb {

inline const base::Error kNotADraft{"not_a_draft",
                                    "only a draft is changed; `seldinger case version` makes the next one"};

void bind_needle(Statement& statement, const cases::Instrument& needle, cases::Approach approach);
void read_needle(const Statement& from, cases::Instrument& needle, cases::Approach& approach);

// Of a row of training_case; throws Failure where it holds what the schema does not take.
void read_setting(const Statement& from, CaseSetting& setting);
// Into the row of a case, whole. To be called within the transaction that may change it.
void write_setting(Sqlite& database, const std::string& case_id, const CaseSetting& setting);

}  // namespace seldinger::casedb

// A case's setting in the columns of training_case; its needle and approach are in those of attempts too.
#pragma once

#include "casedb/case_setting.h"
#include "casedb/sqlite.h"
#include "sim/base/result.h"

namespace seldinger::casedb {

inline const base::Error kNotADraft{"not_a_draft",
                                    "only a draft is changed; `seldinger case version` makes the next one"};

void bind_needle(Statement& statement, const cases::Instrument& needle, cases::Approach approach);
void read_needle(const Statement& from, cases::Instrument& needle, cases::Approach& approach);

void bind_setting(Statement& statement, const CaseSetting& setting);
void read_setting(const Statement& from, CaseSetting& setting);

}  // namespace seldinger::casedb

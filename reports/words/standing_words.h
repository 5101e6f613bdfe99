// Where a learner stands, in words.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "casedb/grading/learner_records.h"

namespace seldinger::reports {

std::string standing_text(assessment::Standing standing);  // "Ready", "Under way", …

// What says so, in one sentence: "5 attempts running at 2. Liver biopsy, none passed; missed most: Hit (4 of 5)."
// `record` is what `found` was found in.
std::string evidence_text(const assessment::StandingFound& found, const casedb::CurriculumRecord& record,
                          std::int64_t now_us);

// "6 of 8"
std::string proficient_text(std::span<const casedb::ItemState> items);

// Passes of graded attempts with Wilson's 95 % interval of the share: "3 of 5 (23 to 88 %)"; "none graded".
std::string passes_text(const casedb::ItemState& item);

// "2 days ago", "today"
std::string days_ago_text(std::int64_t then_us, std::int64_t now_us);

}  // namespace seldinger::reports

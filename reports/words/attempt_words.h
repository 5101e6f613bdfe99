// How an attempt's plain data is written for people.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "casedb/attempts/comments.h"
#include "casedb/grading/grading.h"

namespace seldinger::reports {

// What somebody said of a moment, and how they are called for this reader.
struct CommentView {
  casedb::AttemptComment comment;
  std::string author;
};

// An attempt, how its operator is called for this reader (whether a log-in name may be shown is not ours to say),
// what it is worth, and its steps; a list needs no more of that than the grade.
struct AttemptView {
  casedb::AttemptRow row;
  std::string operator_label;
  casedb::AttemptGrade grade{};
  std::vector<assessment::StepResult> steps{};
  std::vector<CommentView> comments{};
  bool may_comment = false, may_replay = false;  // the reader
};

std::string instrument_text(const cases::Instrument& instrument);       // short: "Access needle"
std::string instrument_size_text(const cases::Instrument& instrument);  // "0.72 mm across, 200 mm long"
std::string lesion_text(const cases::Lesion& lesion);        // "LPS (12.0, −3.5, 100.0) mm, diameter 16.0 mm"
std::string picture_text(const cases::Picture& picture);     // "MPR, 150 mm wide, 150 mm deep"; "Fluoroscopy"
std::string approach_text(cases::Approach approach);         // "In plane"
std::string position_text(cases::PatientPosition position);  // "on the left side"
// "Interrupted, and resumed after 12 min."; empty: it was not, or nobody knows.
std::string away_text(const casedb::AttemptHead& attempt);
std::string person_text(const std::string& person_id);  // "Person 3f20ab": no name
std::string case_text(const std::string& case_id);      // "Case 3f20ab": no title
// The name of one that the program brings; else "custom": somebody's own file has somebody's words.
std::string_view own_or_known_operator(std::string_view operator_name);
std::string simulated_operator_text(const std::string& operator_name);  // "Simulated expert"

}  // namespace seldinger::reports

// The report of a library's cases: how hard each is, how far it tells persons apart, how many such cases a decision
// about a person needs, and which to change or retire.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "assessment/statistics/answer.h"
#include "casedb/grading/learning.h"

namespace seldinger::reports {

// A case in all its versions, and what was done there.
struct ReportedCase {
  std::string family_id, title;
  assessment::PassRule rule;                      // of its newest version
  std::vector<casedb::LearningAttempt> attempts;  // oldest first
};

struct CaseReport {
  casedb::Learners whose = casedb::Learners::people;
  std::int64_t made_us = 0;
  std::string program_version;
  std::vector<ReportedCase> cases;  // oldest first; those that somebody attempted
  assessment::statistics::Answer dependability;
  std::map<std::string, double> planted;  // of simulated people: the mean of the abilities before practice
};
CaseReport case_report_of(casedb::Library& library, casedb::Learners whose, const std::string& program_version);

// What a case's attempts say of it. A person counts once.
struct CaseNumbers {
  std::size_t persons = 0;                       // with a graded attempt
  std::size_t first_passes = 0;                  // at their first graded attempt
  std::size_t last_passes = 0;                   // at their last
  assessment::statistics::Interval first, last;  // of the shares, Wilson
  // Of the persons' share of passes here with their mean share at the other cases.
  assessment::statistics::Answer discrimination;
};
// In the order of the cases.
std::vector<CaseNumbers> case_numbers(const std::vector<ReportedCase>& cases);

// Of the persons' mean share of passes with what was planted in them, by ranks.
assessment::statistics::Answer against_planted(const CaseReport& report);

// "Change or retire: …", "Keep", "Too few to say: …"; thresholds are judgement, and told by the page.
std::string advice_text(const CaseNumbers& numbers);

// Of people no number that rests on fewer than casedb::kSmallestCell of them. Deterministic.
std::string case_report_page(const CaseReport& report);

}  // namespace seldinger::reports

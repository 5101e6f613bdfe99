// How grades, scores and expert sets are written for people.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "casedb/grading/grading.h"

namespace seldinger::reports {

std::string verdict_text(const assessment::Grade& grade);  // "Passed", "Not passed: a critical error", …
std::string verdict_word(
    assessment::Verdict verdict);  // for lists: "Passed", "Not passed", "Not graded", "No rule"
std::string score_text(const assessment::Score& score);  // "63 of 100", "none: no standard"
// A rule's criteria for people, a line each; where two bound the same value from both sides, one line.
struct RuleLine {
  std::string metric;  // its label
  std::string bound;   // "at most 3 mm", "within ±3 mm", "from −2 mm to 3 mm", "yes"
  bool critical = false;
};
std::vector<RuleLine> rule_lines(const assessment::PassRule& rule);
// "One more pass, at the next attempt, and you are proficient here."; `missing`: passes in a row.
std::string proficiency_text(int missing);
std::string experts_text(const assessment::ExpertSet& set);  // who they are, how many, since when

// The standard's band of this version of a metric, "0–3 mm"; empty where there is none, or for a yes and no.
std::string band_text(const assessment::ExpertSet& set, std::string_view metric_id, int version);
// Beside it: "n = 9, tolerance 0–5 mm"; that it is not comparable, where the standard has another version of the
// metric; empty where there is no band.
std::string tolerance_text(const assessment::ExpertSet& set, std::string_view metric_id, int version);
std::string bands_note();  // what bands and tolerance intervals are

}  // namespace seldinger::reports

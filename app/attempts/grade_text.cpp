#include "app/attempts/grade_text.h"

#include "assessment/grading/plain_words.h"
#include "assessment/grading/reason_words.h"
#include "reports/words/grade_words.h"

namespace seldinger::app {

std::string text_of_grade(const casedb::AttemptGrade& grade) {
  std::string text = reports::verdict_text(grade.grade);
  if (grade.provisional && grade.grade.verdict != assessment::Verdict::no_rule) text += ", provisional";
  text += "\n";
  for (const assessment::Sentence& one : grade.debrief) text += "  " + one.text + "\n";
  for (const assessment::CriterionResult& one : grade.grade.criteria) {
    text += std::string("  [") + (one.outcome == assessment::Outcome::met ? "met" : "not met") + "] " +
            assessment::text_of(one.criterion) + (one.criterion.critical ? ", critical" : "") +
            (one.of_the_time_limit ? ", the time limit" : "") + ": ";
    text += one.value ? assessment::plain_apart(*one.value, one.criterion.value, one.unit).first
                      : "no value (" + assessment::reason_words(one.reason) + ")";
    text += "\n";
  }
  if (grade.grade.verdict != assessment::Verdict::no_rule)
    text += "  score " + reports::score_text(grade.score) + "\n";
  return text;
}

}  // namespace seldinger::app

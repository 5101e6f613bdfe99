#include "reports/questionnaires/ratings_csv.h"

#include "reports/export/csv_line.h"

namespace seldinger::reports {

std::string ratings_csv(const casedb::SentRatings& ratings, bool all) {
  namespace questionnaire = assessment::questionnaire;
  const questionnaire::Form& form = ratings.form.form;
  CsvLine line;
  for (const char* column : {"form", "version", "form_sha256", "round", "rater", "simulated", "number", "part",
                             "replay", "attempt", "mean"})
    line.text(column);
  for (const questionnaire::Item& item : form.items) line.text(item.id);
  std::string csv = line.take();
  for (const casedb::SentRating& one : ratings.ratings) {
    if (!all && one.part != assessment::rating::Part::rated) continue;
    line.text(form.id).whole(std::int64_t{form.version}).text(ratings.form.body_hash).text(ratings.round.code);
    line.text(one.rater).whole(std::int64_t{one.simulated ? 1 : 0}).whole(static_cast<std::int64_t>(one.number));
    line.text(base::name_of(casedb::kRatingPartNames, one.part)).text(one.view_id).text(one.attempt_id);
    line.number(questionnaire::mean_score(form, one.answers));
    for (const questionnaire::Item& item : form.items) {
      const auto found = one.answers.find(item.id);
      const questionnaire::ItemAnswer answer =
          found == one.answers.end() ? questionnaire::ItemAnswer{} : found->second;
      if (item.kind == questionnaire::ItemKind::comment)
        line.text(answer.text);
      else
        line.number(questionnaire::scored(form, item, answer));
    }
    csv += line.take();
  }
  return csv;
}

}  // namespace seldinger::reports

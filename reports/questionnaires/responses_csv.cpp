#include "reports/questionnaires/responses_csv.h"

#include "reports/export/csv_line.h"

namespace seldinger::reports {

std::string responses_csv(const casedb::Responses& responses) {
  namespace questionnaire = assessment::questionnaire;
  std::string csv =
      "form,version,language,form_sha256,round,respondent,group,source,item,kind,state,value,scored,label,"
      "comment\n";
  CsvLine line;
  for (const auto& [questionnaire_id, set] : responses.sets) {
    const casedb::StoredForm& stored = responses.forms.at(questionnaire_id);
    for (const questionnaire::Item& item : stored.form.items) {
      const auto found = set.answers.find(item.id);
      const questionnaire::ItemAnswer answer =
          found == set.answers.end() ? questionnaire::ItemAnswer{} : found->second;
      line.text(stored.form.id).whole(std::int64_t{stored.form.version}).text(stored.form.language);
      line.text(stored.body_hash).text(responses.round.code).text(set.respondent).text(set.group).text(set.source);
      line.text(item.id).text(base::name_of(questionnaire::kItemKindNames, item.kind));
      line.text(base::name_of(questionnaire::kAnswerStateNames, answer.state)).number(answer.value);
      line.number(questionnaire::scored(stored.form, item, answer));
      line.text(questionnaire::label_of(stored.form, item, answer)).text(answer.text);
      csv += line.take();
    }
  }
  return csv;
}

}  // namespace seldinger::reports

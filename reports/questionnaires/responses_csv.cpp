#include "reports/questionnaires/responses_csv.h"

#include "reports/export/csv_line.h"

namespace seldinger::reports {
namespace {

namespace questionnaire = assessment::questionnaire;

questionnaire::ItemAnswer answer_to(const casedb::ResponseSet& set, const questionnaire::Item& item) {
  const auto found = set.answers.find(item.id);
  return found == set.answers.end() ? questionnaire::ItemAnswer{} : found->second;
}

bool counts(const questionnaire::Item& item) {
  return item.kind == questionnaire::ItemKind::scale || item.kind == questionnaire::ItemKind::number;
}

}  // namespace

std::string responses_csv(const casedb::Responses& responses) {
  std::string csv =
      "form,version,language,form_sha256,round,respondent,group,source,item,kind,state,value,scored,label,"
      "comment\n";
  CsvLine line;
  for (const auto& [questionnaire_id, set] : responses.sets) {
    const casedb::StoredForm& stored = responses.forms.at(questionnaire_id);
    for (const questionnaire::Item& item : stored.form.items) {
      const questionnaire::ItemAnswer answer = answer_to(set, item);
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

std::string scores_csv(const casedb::Responses& responses) {
  CsvLine line;
  line.text("respondent").text("group").text("source");
  // The round asks one version, and that has the same items in every language.
  for (const questionnaire::Item& item : responses.forms.begin()->second.form.items)
    if (counts(item)) line.text(item.id);
  std::string csv = line.take();
  for (const auto& [questionnaire_id, set] : responses.sets) {
    const questionnaire::Form& form = responses.forms.at(questionnaire_id).form;
    line.text(set.respondent).text(set.group).text(set.source);
    for (const questionnaire::Item& item : form.items)
      if (counts(item)) line.number(questionnaire::scored(form, item, answer_to(set, item)));
    csv += line.take();
  }
  return csv;
}

}  // namespace seldinger::reports

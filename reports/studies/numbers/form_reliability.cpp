#include "reports/studies/numbers/form_reliability.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "assessment/statistics/complete_table.h"
#include "assessment/statistics/reliability/alpha.h"
#include "assessment/statistics/reliability/omega.h"

namespace seldinger::reports {
namespace {

namespace questionnaire = assessment::questionnaire;
namespace statistics = assessment::statistics;

constexpr std::size_t kResamples = 1'000;
constexpr std::uint64_t kReliabilitySeed = 1;  // the same answers, the same report

statistics::Column column_of(const casedb::Responses& responses, const std::string& item_id) {
  statistics::Column column{item_id, {}};
  for (const auto& [questionnaire_id, set] : responses.sets) {
    const questionnaire::Form& form = responses.forms.at(questionnaire_id).form;
    const auto answer = set.answers.find(item_id);
    const auto counts = answer == set.answers.end()
                            ? std::nullopt
                            : questionnaire::scored(form, *form.find_item(item_id), answer->second);
    column.values.push_back(counts.value_or(std::numeric_limits<double>::quiet_NaN()));
  }
  return column;
}

}  // namespace

std::vector<FormReliability> reliability_of(const casedb::Responses& responses) {
  std::vector<FormReliability> all;
  // The round asks one version, and that has the same items in every language.
  const questionnaire::Form& form = responses.forms.begin()->second.form;
  for (const questionnaire::Scale& scale : form.scales) {
    statistics::DataTable table;
    table.rows = responses.sets.size();
    for (const questionnaire::Item& item : form.items)
      if (item.kind == questionnaire::ItemKind::scale && item.scale == scale.id)
        table.values.push_back(column_of(responses, item.id));
    if (table.values.size() < 2) continue;
    const statistics::CompleteTable items = statistics::complete_table(table);
    all.push_back({form.title, responses.round.title, form.version, table.values.size(), scale.low(), scale.high(),
                   statistics::alpha(items, {}), statistics::omega(items, {}, kResamples, kReliabilitySeed),
                   std::move(table)});
  }
  return all;
}

std::vector<FormReliability> reliability_of_study(casedb::Library& library, const std::string& study_id) {
  std::vector<FormReliability> all;
  std::vector<casedb::Round> rounds = casedb::list_rounds(library);
  std::reverse(rounds.begin(), rounds.end());
  for (const casedb::Round& round : rounds) {
    if (round.rated || round.study_id != study_id) continue;
    const auto responses = casedb::list_responses(library, round.code);
    if (!responses || responses->sets.empty()) continue;  // an error is damage, which the library's check tells
    for (FormReliability& one : reliability_of(*responses)) all.push_back(std::move(one));
  }
  return all;
}

}  // namespace seldinger::reports

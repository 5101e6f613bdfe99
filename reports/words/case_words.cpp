#include "reports/words/case_words.h"

#include "reports/words/metric_words.h"

namespace seldinger::reports {
namespace {

// Empty: there is none. What is composed has words of its own.
std::string setting_text(const casedb::SettingRow& row, const casedb::CaseSetting& setting) {
  using namespace casedb;
  return std::visit(OfKind{[&](const NumberField& one) { return number_text(one.get(setting), row.page.digits); },
                           [&](const MaybeNumberField& one) {
                             const auto value = one.get(setting);
                             return value ? number_text(*value, row.page.digits) : std::string();
                           },
                           [&](const MaybeWholeField& one) {
                             const auto value = one.get(setting);
                             return value ? std::to_string(*value) : std::string();
                           },
                           [&](const TextField& one) { return one.get(setting); },
                           [&](const ChoiceField& one) { return words_from_code(one.get(setting)); },
                           [&](const SwitchField& one) { return std::string(one.get(setting) ? one.yes : one.no); },
                           [](const ComposedField&) { return std::string(); }},
                    row.field);
}

}  // namespace

std::string guidance_text(const casedb::CaseSetting& setting) {
  std::string text = casedb::name_of(setting.modality) + ", ";
  if (setting.modality != cases::Modality::xray) text += words_from_code(casedb::name_of(setting.approach)) + ", ";
  text += setting.subject == cases::Subject::phantom
              ? "phantom"
              : "patient " + words_from_code(casedb::name_of(setting.position));
  for (const cases::Modality one : setting.further_modalities) text += ", also " + casedb::name_of(one);
  if (setting.probe_is_chosen) text += ", the trainee chooses the probe";
  return text;
}

std::vector<SettingFact> setting_facts(const casedb::CaseSetting& setting) {
  std::vector<SettingFact> facts;
  for (const casedb::SettingRow* row : casedb::shown_rows(&casedb::SettingRow::page))
    if (std::string text = setting_text(*row, setting); !text.empty())
      facts.push_back({row->page.words, std::move(text)});
  return facts;
}

}  // namespace seldinger::reports

#include "casedb/cases/setting_columns.h"

#include <algorithm>

#include "assessment/grading/rule_json.h"
#include "casedb/cases/cases.h"
#include "casedb/cases/setting_table.h"
#include "sim/base/check.h"
#include "sim/base/failure.h"

namespace seldinger::casedb {
namespace {

bool sound_text(const std::string& text) {
  if (text.size() > kMostSettingText) return false;
  for (const char c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) return false;
  return true;
}

bool within(double value, double low, double high) {
  return value >= low && value <= high;  // false for NaN
}

// Within the bounds of its row; choices and switches cannot be outside, what is composed has rules of its own.
bool sound(const SettingRow& row, const CaseSetting& setting) {
  return std::visit(OfKind{[&](const NumberField& one) { return within(one.get(setting), one.least, one.most); },
                           [&](const MaybeNumberField& one) {
                             const auto value = one.get(setting);
                             return !value || within(*value, one.least, one.most);
                           },
                           [&](const MaybeWholeField& one) {
                             const auto value = one.get(setting);
                             return !value || (*value >= one.least && *value <= one.most);
                           },
                           [&](const TextField& one) { return sound_text(one.get(setting)); },
                           [](const ChoiceField&) { return true; }, [](const SwitchField&) { return true; },
                           [](const ComposedField&) { return true; }},
                    row.field);
}

std::string text_of(const std::vector<cases::Modality>& modalities) {
  std::string text;
  for (const cases::Modality one : modalities) {
    if (!text.empty()) text.push_back(',');
    text.append(name_of(one));
  }
  return text;
}

std::vector<cases::Modality> modalities_from(const std::string& text) {
  std::vector<cases::Modality> modalities;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    if (const auto one = modality_from(text.substr(at, end - at))) modalities.push_back(*one);
    at = end + 1;
  }
  return modalities;
}

void bind_composed(Statement& statement, const ComposedField& field, const CaseSetting& setting) {
  switch (field.what) {
    case Composed::further_modalities:
      statement.bind(field.columns[0], text_of(setting.further_modalities));
      break;
    case Composed::gauge:
      break;
    case Composed::planned_entry:
      for (int axis = 0; axis < 3; ++axis)
        statement.bind(
            field.columns[static_cast<std::size_t>(axis)],
            setting.planned_entry_lps_mm ? std::optional((*setting.planned_entry_lps_mm)[axis]) : std::nullopt);
      break;
    case Composed::pass_rule:
      if (setting.rule.criteria.empty())
        statement.bind_null(field.columns[0]);
      else
        statement.bind(field.columns[0], assessment::json_of_rule(setting.rule));
      break;
  }
}

void read_composed(const Statement& from, const ComposedField& field, CaseSetting& setting) {
  switch (field.what) {
    case Composed::further_modalities:
      setting.further_modalities = modalities_from(from.text(field.columns[0]));
      break;
    case Composed::gauge:
      break;
    case Composed::planned_entry:
      if (!from.is_null(field.columns[0]))
        setting.planned_entry_lps_mm =
            glm::dvec3(from.real(field.columns[0]), from.real(field.columns[1]), from.real(field.columns[2]));
      break;
    case Composed::pass_rule:
      if (from.is_null(field.columns[0])) break;
      auto rule = assessment::rule_from_json(from.text(field.columns[0]));
      if (!rule) throw base::Failure("database", "a stored pass rule cannot be read");
      setting.rule = std::move(*rule);
      break;
  }
}

void bind_row(Statement& statement, const SettingRow& row, const CaseSetting& setting) {
  std::visit(OfKind{[&](const NumberField& one) { statement.bind(row.column, one.get(setting)); },
                    [&](const MaybeNumberField& one) { statement.bind(row.column, one.get(setting)); },
                    [&](const MaybeWholeField& one) { statement.bind(row.column, one.get(setting)); },
                    [&](const TextField& one) { statement.bind(row.column, one.get(setting)); },
                    [&](const ChoiceField& one) { statement.bind(row.column, one.get(setting)); },
                    [&](const SwitchField& one) {
                      const bool yes = one.get(setting);
                      if (one.stored_as_number)
                        statement.bind(row.column, yes ? 1 : 0);
                      else
                        statement.bind(row.column, yes ? one.yes : one.no);
                    },
                    [&](const ComposedField& one) { bind_composed(statement, one, setting); }},
             row.field);
}

void read_row(const Statement& from, const SettingRow& row, CaseSetting& setting) {
  const char* const column = row.column;
  std::visit(
      OfKind{[&](const NumberField& one) { one.set(setting, from.real(column)); },
             [&](const MaybeNumberField& one) {
               one.set(setting, from.is_null(column) ? std::nullopt : std::optional(from.real(column)));
             },
             [&](const MaybeWholeField& one) {
               one.set(setting, from.is_null(column) ? std::nullopt : std::optional(from.small_integer(column)));
             },
             [&](const TextField& one) { one.set(setting, from.text(column)); },
             [&](const ChoiceField& one) {
               if (!one.set(setting, from.view(column)))  // the schema takes no others
                 throw base::Failure("database", "a stored setting cannot be read");
             },
             [&](const SwitchField& one) {
               one.set(setting, one.stored_as_number ? from.integer(column) != 0 : from.view(column) == one.yes);
             },
             [&](const ComposedField& one) { read_composed(from, one, setting); }},
      row.field);
}

}  // namespace

std::optional<cases::Breathing> Motion::breathing() const {
  if (!(breath_depth > 0.0)) return std::nullopt;
  const bool drifts = breath_law != BreathLaw::equal_holds;
  cases::Breathing made;
  made.amplitude_mm = breath_depth * (drifts ? cases::breath::kQuietMm : cases::breath::kBetweenCtMm);
  made.period_s = breath_period_s;
  made.irregularity = breath_irregularity;
  made.slides = breath_law == BreathLaw::sliding_organs;
  // Who plans on a CT asks for the breath in which it was taken.
  made.ct_level = made.hold_level = ct_breath == cases::CtBreath::inspiration ? 1.0 : 0.0;
  if (drifts) {
    made.hold_spread = cases::breath::kHoldSpreadMm / made.amplitude_mm.z;
    made.hold_drift_per_s = cases::breath::kHoldDriftMmPerS / made.amplitude_mm.z;
  }
  return made;
}

std::string name_of(cases::InstrumentKind kind) {
  return std::string(base::name_of(cases::kInstrumentKindNames, kind));
}

std::string name_of(cases::Approach approach) {
  return std::string(base::name_of(cases::kApproachNames, approach));
}

std::string name_of(cases::Subject subject) {
  return std::string(base::name_of(cases::kSubjectNames, subject));
}

std::optional<cases::Subject> subject_from(const std::string& name) {
  return base::from_name(cases::kSubjectNames, name);
}

base::Result<void> check_setting(const CaseSetting& setting) {
  base::Error error{"bad_setting", "the setting of the case is not sound"};
  const auto wrong = [&](const char* text) {
    for (const base::Problem& one : error.findings)
      if (one.text == text) return;
    error.findings.push_back({"bad_setting", text});
  };
  for (const SettingRow& row : kSettingRows)
    if (!sound(row, setting)) wrong(row.unsound);
  // What several settings must be together.
  const cases::Instrument& needle = setting.instrument;
  if (!(needle.inner_radius_mm <= needle.radius_mm)) wrong(setting_table::kRadius);
  if (needle.kind == cases::InstrumentKind::core &&
      !(needle.notch_mm > 0.0 && needle.notch_mm + needle.dead_tip_mm <= needle.throw_mm + 1e-9))
    wrong("a core needle's notch and dead tip are within its throw");
  for (std::size_t i = 0; i < setting.further_modalities.size(); ++i) {
    bool twice = setting.further_modalities[i] == setting.modality;
    for (std::size_t other = 0; other < i; ++other)
      twice = twice || setting.further_modalities[other] == setting.further_modalities[i];
    if (twice) wrong("a modality is named twice");
  }
  const Clinic& clinic = setting.clinic;
  if (setting.subject == cases::Subject::phantom &&
      (clinic.inr || clinic.platelets_per_nl || !clinic.allergy.empty() || clinic.defer ||
       setting.motion.breath_depth > 0.0))
    wrong("a phantom has neither laboratory values nor an allergy, does not breathe, and is not deferred");
  if (setting.planned_entry_lps_mm)
    for (int axis = 0; axis < 3; ++axis)
      if (!within((*setting.planned_entry_lps_mm)[axis], -1e5, 1e5)) {
        wrong("the planned entry is no point");
        break;
      }
  if (!error.findings.empty()) return error;
  return {};
}

void bind_needle(Statement& statement, const cases::Instrument& needle, cases::Approach approach) {
  CaseSetting setting;
  setting.instrument = needle;
  setting.approach = approach;
  for (const SettingRow& row : kSettingRows)
    if (row.of_attempts) bind_row(statement, row, setting);
}

void read_needle(const Statement& from, cases::Instrument& needle, cases::Approach& approach) {
  CaseSetting setting;
  for (const SettingRow& row : kSettingRows)
    if (row.of_attempts) read_row(from, row, setting);
  needle = setting.instrument;
  approach = setting.approach;
}

void read_setting(const Statement& from, CaseSetting& setting) {
  for (const SettingRow& row : kSettingRows) read_row(from, row, setting);
}

void write_setting(Sqlite& database, const std::string& case_id, const CaseSetting& setting) {
  static const std::string kUpdate = [] {  // of names that are in the table above, and of nothing else
    std::string columns;
    const auto add = [&](const char* column) {
      columns += std::string(columns.empty() ? "" : ", ") + column + " = :" + column;
    };
    for (const SettingRow& row : kSettingRows) {
      if (row.column != nullptr) add(row.column);
      if (const auto* composed = std::get_if<ComposedField>(&row.field))
        for (const char* column : composed->columns) add(column);
    }
    return "UPDATE training_case SET " + columns + " WHERE case_id = :case_id";
  }();
  Statement update = database.prepare(kUpdate);
  for (const SettingRow& row : kSettingRows) bind_row(update, row, setting);
  update.bind("case_id", case_id).run();
}

}  // namespace seldinger::casedb

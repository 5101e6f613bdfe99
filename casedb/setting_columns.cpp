#include "casedb/setting_columns.h"

#include <algorithm>

#include "assessment/grading/rule_json.h"
#include "casedb/store.h"
#include "sim/base/check.h"

namespace seldinger::casedb {
namespace {

constexpr std::size_t kMostText = 200;  // bytes

bool sound_text(const std::string& text) {
  if (text.size() > kMostText) return false;
  for (const char c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) return false;
  return true;
}

bool within(double value, double low, double high) {
  return value >= low && value <= high;  // false for NaN
}

std::optional<std::string> column_of(const assessment::PassRule& rule) {
  if (rule.criteria.empty()) return std::nullopt;
  return assessment::json_of_rule(rule);
}

}  // namespace

std::string name_of(cases::InstrumentKind kind) {
  return kind == cases::InstrumentKind::core ? "core" : "access";
}

std::string name_of(cases::Approach approach) {
  return approach == cases::Approach::out_of_plane ? "out_of_plane" : "in_plane";
}

std::string name_of(cases::Subject subject) {
  return std::string(cases::kSubjectNames[static_cast<std::size_t>(subject)]);
}

std::optional<cases::Subject> subject_from(const std::string& name) {
  for (std::size_t i = 0; i < cases::kSubjectNames.size(); ++i)
    if (cases::kSubjectNames[i] == name) return static_cast<cases::Subject>(i);
  return std::nullopt;
}

std::optional<cases::Breathing> Motion::breathing() const {
  if (!(breath_depth > 0.0)) return std::nullopt;
  cases::Breathing made;
  made.amplitude_mm *= breath_depth;
  made.period_s = breath_period_s;
  made.irregularity = breath_irregularity;
  return made;
}

base::Result<void> check_setting(const CaseSetting& setting) {
  base::Error error{"bad_setting", "the setting of the case is not sound"};
  const auto wrong = [&](const char* text) { error.findings.push_back({"bad_setting", text}); };
  const cases::Instrument& needle = setting.instrument;
  if (!within(needle.length_mm, 10.0, 500.0)) wrong("the needle's length is from 10 to 500 mm");
  if (!within(needle.radius_mm, 0.1, 5.0) || !within(needle.inner_radius_mm, 0.0, needle.radius_mm))
    wrong("the needle's radius is from 0.1 to 5 mm, its lumen no wider");
  if (!within(needle.hu, -1024.0, 32767.0)) wrong("the needle's HU are from -1024 to 32767");
  if (!within(needle.throw_mm, 0.0, 60.0) || !within(needle.notch_mm, 0.0, 60.0) ||
      !within(needle.dead_tip_mm, 0.0, 30.0))
    wrong("throw and notch are up to 60 mm, the dead tip up to 30");
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
  if (clinic.inr && !within(*clinic.inr, 0.5, 20.0)) wrong("INR is from 0.5 to 20");
  if (clinic.platelets_per_nl && !within(*clinic.platelets_per_nl, 0.0, 3000.0))
    wrong("platelets are from 0 to 3000 per nl");
  const Motion& motion = setting.motion;
  if (!within(motion.breath_depth, 0.0, 2.0) || !within(motion.breath_period_s, 1.0, 20.0) ||
      !within(motion.breath_irregularity, 0.0, 0.4))
    wrong("a breath is up to twice as deep as a quiet one, 1 to 20 s long, and up to 0.4 irregular");
  if (setting.subject == cases::Subject::phantom &&
      (clinic.inr || clinic.platelets_per_nl || !clinic.allergy.empty() || clinic.defer ||
       motion.breath_depth > 0.0))
    wrong("a phantom has neither laboratory values nor an allergy, does not breathe, and is not deferred");
  if (!sound_text(clinic.allergy) || !sound_text(clinic.indication))
    wrong("allergy and indication are one line of at most 200 bytes");
  if (setting.planned_entry_lps_mm)
    for (int axis = 0; axis < 3; ++axis)
      if (!within((*setting.planned_entry_lps_mm)[axis], -1e5, 1e5)) {
        wrong("the planned entry is no point");
        break;
      }
  if (setting.time_limit_s && !within(*setting.time_limit_s, 1.0, 86400.0))
    wrong("a time limit is from 1 s to a day");
  if (setting.attempt_limit && !(*setting.attempt_limit >= 1 && *setting.attempt_limit <= 1000))
    wrong("an attempt limit is from 1 to 1000");
  if (!error.findings.empty()) return error;
  return {};
}

void bind_needle(Statement& statement, const cases::Instrument& needle, cases::Approach approach) {
  statement.bind("approach", name_of(approach));
  statement.bind("instrument_kind", name_of(needle.kind)).bind("instrument_length_mm", needle.length_mm);
  statement.bind("instrument_radius_mm", needle.radius_mm);
  statement.bind("instrument_inner_radius_mm", needle.inner_radius_mm).bind("instrument_hu", needle.hu);
  statement.bind("instrument_throw_mm", needle.throw_mm).bind("instrument_notch_mm", needle.notch_mm);
  statement.bind("instrument_dead_tip_mm", needle.dead_tip_mm);
}

void read_needle(const Statement& from, cases::Instrument& needle, cases::Approach& approach) {
  approach = from.text("approach") == name_of(cases::Approach::out_of_plane) ? cases::Approach::out_of_plane
                                                                             : cases::Approach::in_plane;
  needle.kind = from.text("instrument_kind") == name_of(cases::InstrumentKind::core)
                    ? cases::InstrumentKind::core
                    : cases::InstrumentKind::access;
  needle.length_mm = from.real("instrument_length_mm");
  needle.radius_mm = from.real("instrument_radius_mm");
  needle.inner_radius_mm = from.real("instrument_inner_radius_mm");
  needle.hu = from.real("instrument_hu");
  needle.throw_mm = from.real("instrument_throw_mm");
  needle.notch_mm = from.real("instrument_notch_mm");
  needle.dead_tip_mm = from.real("instrument_dead_tip_mm");
}

void bind_setting(Statement& statement, const CaseSetting& setting) {
  std::string further;
  for (const cases::Modality one : setting.further_modalities) {
    if (!further.empty()) further.push_back(',');
    further.append(name_of(one));
  }
  const Clinic& clinic = setting.clinic;
  const auto entry = [&](int axis) {
    return setting.planned_entry_lps_mm ? std::optional((*setting.planned_entry_lps_mm)[axis]) : std::nullopt;
  };
  statement.bind("subject", name_of(setting.subject));
  statement.bind("modality", name_of(setting.modality)).bind("patient_position", name_of(setting.position));
  statement.bind("further_modalities", further);
  bind_needle(statement, setting.instrument, setting.approach);
  statement.bind("inr", clinic.inr).bind("platelets_per_nl", clinic.platelets_per_nl);
  statement.bind("allergy", clinic.allergy).bind("indication", clinic.indication);
  statement.bind("decision", clinic.defer ? "defer" : "proceed");
  statement.bind("breath_depth", setting.motion.breath_depth);
  statement.bind("breath_period_s", setting.motion.breath_period_s);
  statement.bind("breath_irregularity", setting.motion.breath_irregularity);
  statement.bind("tissue_yields", setting.motion.yields ? 1 : 0);
  statement.bind("planned_entry_x_lps_mm", entry(0)).bind("planned_entry_y_lps_mm", entry(1));
  statement.bind("planned_entry_z_lps_mm", entry(2));
  statement.bind("difficulty", kDifficultyNames[static_cast<std::size_t>(setting.difficulty)]);
  statement.bind("time_limit_s", setting.time_limit_s).bind("attempt_limit", setting.attempt_limit);
  statement.bind("pass_rule", column_of(setting.rule));
}

void read_setting(const Statement& from, CaseSetting& setting) {
  // The schema takes no others.
  setting.modality = *modality_from(from.text("modality"));
  setting.subject = *subject_from(from.text("subject"));
  setting.position = *position_from(from.text("patient_position"));
  const std::string further = from.text("further_modalities");
  for (std::size_t at = 0; at < further.size();) {
    const std::size_t end = std::min(further.find(',', at), further.size());
    if (const auto one = modality_from(further.substr(at, end - at))) setting.further_modalities.push_back(*one);
    at = end + 1;
  }
  read_needle(from, setting.instrument, setting.approach);
  const auto maybe = [&](const char* column) {
    return from.is_null(column) ? std::nullopt : std::optional(from.real(column));
  };
  setting.clinic.inr = maybe("inr");
  setting.clinic.platelets_per_nl = maybe("platelets_per_nl");
  setting.clinic.allergy = from.text("allergy");
  setting.clinic.indication = from.text("indication");
  setting.clinic.defer = from.text("decision") == "defer";
  setting.motion.breath_depth = from.real("breath_depth");
  setting.motion.breath_period_s = from.real("breath_period_s");
  setting.motion.breath_irregularity = from.real("breath_irregularity");
  setting.motion.yields = from.integer("tissue_yields") != 0;
  if (!from.is_null("planned_entry_x_lps_mm"))
    setting.planned_entry_lps_mm =
        glm::dvec3(from.real("planned_entry_x_lps_mm"), from.real("planned_entry_y_lps_mm"),
                   from.real("planned_entry_z_lps_mm"));
  for (std::size_t i = 0; i < kDifficultyNames.size(); ++i)
    if (from.text("difficulty") == kDifficultyNames[i]) setting.difficulty = static_cast<Difficulty>(i);
  setting.time_limit_s = maybe("time_limit_s");
  if (!from.is_null("attempt_limit")) setting.attempt_limit = from.small_integer("attempt_limit");
  if (!from.is_null("pass_rule")) {
    auto rule = assessment::rule_from_json(from.text("pass_rule"));
    if (!rule) throw base::Failure("database", "a stored pass rule cannot be read");
    setting.rule = std::move(*rule);
  }
}

}  // namespace seldinger::casedb

// Every setting of a case, one row each: its column in the database, its option of `case setting`, its key in JSON,
// its words on the case's page and in the editor, and what is sound. Store, JSON, command, page and editor loop
// over these rows; a new setting is a field of CaseSetting, a row here and a migration.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "casedb/cases/setting_field.h"

namespace seldinger::casedb {

struct SettingOption {
  const char* name = nullptr;   // nullptr: none
  const char* value = nullptr;  // what follows, as the help shows it
  const char* help = nullptr;
  bool repeatable = false;
};

// Where a setting stands among others that are shown; those without a place come last, as the table has them.
constexpr int kLastPlace = 1000;
struct PageFact {
  const char* words = nullptr;  // nullptr: not shown by itself
  int place = kLastPlace;
  int digits = 0;  // after the point
};
struct EditorField {
  const char* words = nullptr;  // nullptr: not to be set there
  int place = kLastPlace;
  int digits = 0;
  double step = 0.0;                          // numbers: of the buttons beside the field; 0: none
  double usual = 0.0;                         // numbers that may be missing: what is there at first
  std::span<const std::string_view> names{};  // choices: in place of the stored names
};

struct SettingRow {
  const char* column;  // of training_case; nullptr: composed
  SettingField field;
  const char* json = nullptr;  // key, or group/key; nullptr: left out
  SettingOption option{};
  const char* unsound = nullptr;  // the finding when the value is out of bounds
  PageFact page{};
  EditorField editor{};
  bool of_core_needles = false;  // in JSON only for these
  bool of_attempts = false;      // each attempt keeps its own copy
};

inline constexpr auto kModalityWords = base::names<cases::Modality>({{cases::Modality::mpr, "CT slices"},
                                                                     {cases::Modality::xray, "Fluoroscopy"},
                                                                     {cases::Modality::ultrasound, "Ultrasound"}});

inline constexpr auto kApproachWords = base::names<cases::Approach>(
    {{cases::Approach::in_plane, "in plane"}, {cases::Approach::out_of_plane, "out of plane"}});
inline constexpr auto kPositionWords =
    base::names<cases::PatientPosition>({{cases::PatientPosition::supine, "on the back"},
                                         {cases::PatientPosition::prone, "face down"},
                                         {cases::PatientPosition::lateral_left, "on the left side"},
                                         {cases::PatientPosition::lateral_right, "on the right side"}});
inline constexpr auto kInstrumentWords =
    base::names<cases::InstrumentKind>({{cases::InstrumentKind::access, "access: the tip decides"},
                                        {cases::InstrumentKind::core, "core: the fired notch"}});
inline constexpr auto kTipWords =
    base::names<cases::NeedleTip>({{cases::NeedleTip::bevel, "bevel, as a Chiba's"},
                                   {cases::NeedleTip::diamond, "diamond point"},
                                   {cases::NeedleTip::trocar, "trocar point"},
                                   {cases::NeedleTip::core, "core: stylet in a cannula"}});

// The editor takes a name by the place of its words.
template <typename Names, typename Words>
consteval bool in_one_order(const Names& names, const Words& words) {
  for (std::size_t i = 0; i < words.size(); ++i)
    if (words[i].value != names[i].value) return false;
  return words.size() == names.size();
}
static_assert(in_one_order(cases::kModalityNames, kModalityWords) &&
              in_one_order(cases::kApproachNames, kApproachWords) &&
              in_one_order(cases::kPatientPositionNames, kPositionWords) &&
              in_one_order(cases::kInstrumentKindNames, kInstrumentWords) &&
              in_one_order(cases::kNeedleTipNames, kTipWords));

namespace setting_table {

using cases::Instrument;

// The main modality is not listed again among the further ones.
inline bool set_modality(CaseSetting& to, std::string_view name) {
  const auto modality = base::from_name(cases::kModalityNames, name);
  if (!modality) return false;
  to.modality = *modality;
  std::erase(to.further_modalities, *modality);
  return true;
}
consteval ChoiceField modality() {
  ChoiceField field = choice<cases::kModalityNames, &CaseSetting::modality>();
  field.set = &set_modality;
  return field;
}

// Another kind of needle comes with the tip of its kind; a tip that is named as well stands after it in the table.
inline bool set_instrument_kind(CaseSetting& to, std::string_view name) {
  const auto kind = base::from_name(cases::kInstrumentKindNames, name);
  if (!kind) return false;
  if (*kind != to.instrument.kind)
    to.touch.tip = *kind == cases::InstrumentKind::core ? cases::NeedleTip::core : cases::NeedleTip::bevel;
  to.instrument.kind = *kind;
  return true;
}
consteval ChoiceField instrument_kind() {
  ChoiceField field = choice<cases::kInstrumentKindNames, &CaseSetting::instrument, &Instrument::kind>();
  field.set = &set_instrument_kind;
  return field;
}

inline constexpr const char* kFurtherColumns[] = {"further_modalities"};
inline constexpr const char* kEntryColumns[] = {"planned_entry_x_lps_mm", "planned_entry_y_lps_mm",
                                                "planned_entry_z_lps_mm"};
inline constexpr const char* kRuleColumns[] = {"pass_rule"};

inline constexpr const char* kRadius = "the needle's radius is from 0.1 to 5 mm, its lumen no wider";
inline constexpr const char* kThrow = "throw and notch are up to 60 mm, the dead tip up to 30";
inline constexpr const char* kWords = "allergy and indication are one line of at most 200 bytes";
inline constexpr const char* kBreath =
    "a breath is up to three times as deep as a quiet one, 1 to 20 s long, and up to 0.4 irregular";

}  // namespace setting_table

// In the order of the options; JSON keeps it.
inline constexpr auto kSettingRows = [] {
  using namespace setting_table;
  constexpr auto needle = &CaseSetting::instrument;
  constexpr auto clinic = &CaseSetting::clinic;
  constexpr auto motion = &CaseSetting::motion;
  return std::to_array<SettingRow>({
      {.column = "modality",
       .field = modality(),
       .json = "modality",
       .option = {"--modality", base::kAlternatives<cases::kModalityNames>, "what it is practised with"},
       .editor = {.words = "guidance", .place = 2, .names = base::kNamesOf<kModalityWords>}},
      {.column = nullptr,
       .field = ComposedField{Composed::further_modalities, kFurtherColumns},
       .json = "further_modalities",
       .option = {"--also", "mpr|xray|ultrasound|none", "what else it may be practised with; none: nothing else",
                  true},
       .editor = {.words = "also practised with", .place = 3}},
      {.column = "subject",
       .field = choice<cases::kSubjectNames, &CaseSetting::subject>(),
       .json = "subject",
       .option = {"--subject", base::kAlternatives<cases::kSubjectNames>,
                  "phantom: a block to practise on, without the steps around a patient"}},
      {.column = "patient_position",
       .field = choice<cases::kPatientPositionNames, &CaseSetting::position>(),
       .json = "patient_position",
       .option = {"--position", base::kAlternatives<cases::kPatientPositionNames>, "how the patient lies"},
       .editor = {.words = "patient lies", .place = 5, .names = base::kNamesOf<kPositionWords>}},
      {.column = "approach",
       .field = choice<cases::kApproachNames, &CaseSetting::approach>(),
       .json = "approach",
       .option = {"--approach", base::kAlternatives<cases::kApproachNames>, "of the needle to the picture"},
       .editor = {.words = "approach", .place = 4, .names = base::kNamesOf<kApproachWords>},
       .of_attempts = true},
      {.column = "probe_is_chosen",
       .field = yes_or_no<&CaseSetting::probe_is_chosen>("given", "chosen", true),
       .json = "probe",
       .option = {"--probe", "given|chosen",
                  "ultrasound: given to suit the depth, or chosen by the trainee; default given"},
       .editor = {.words = "the trainee chooses the probe", .place = 4}},
      {.column = "instrument_kind",
       .field = instrument_kind(),
       .json = "instrument/kind",
       .option = {"--instrument", base::kAlternatives<cases::kInstrumentKindNames>,
                  "access: the tip decides; core: the fired notch. Changing it also sets --tip to the usual one"},
       .editor = {.words = "needle", .place = 6, .names = base::kNamesOf<kInstrumentWords>},
       .of_attempts = true},
      {.column = "instrument_tip",
       .field = choice<cases::kNeedleTipNames, &CaseSetting::touch, &cases::Touch::tip>(),
       .json = "instrument/tip",
       .option = {"--tip", base::kAlternatives<cases::kNeedleTipNames>,
                  "the shape of its tip, which sets the cutting force; default bevel, for a core needle core"},
       .page = {.words = "Needle's tip", .place = 9},
       .editor = {.words = "tip", .place = 6, .names = base::kNamesOf<kTipWords>}},
      {.column = nullptr,
       .field = ComposedField{Composed::gauge, {}},
       .json = "instrument/outer_diameter_mm",
       .option = {"--gauge", "G", "16 to 25"},
       .editor = {.words = "gauge", .place = 7}},
      {.column = "instrument_length_mm",
       .field = number<needle, &Instrument::length_mm>(10.0, 500.0),
       .json = "instrument/length_mm",
       .option = {"--length-mm", "L", "length of the needle"},
       .unsound = "the needle's length is from 10 to 500 mm",
       .editor = {.words = "length mm", .place = 8, .step = 10.0},
       .of_attempts = true},
      {.column = "instrument_radius_mm",
       .field = number<needle, &Instrument::radius_mm>(0.1, 5.0),
       .unsound = kRadius,
       .of_attempts = true},
      {.column = "instrument_inner_radius_mm",
       .field = number<needle, &Instrument::inner_radius_mm>(0.0, 5.0),
       .unsound = kRadius,
       .of_attempts = true},
      {.column = "instrument_hu",
       .field = number<needle, &Instrument::hu>(-1024.0, 32767.0),
       .unsound = "the needle's HU are from -1024 to 32767",
       .of_attempts = true},
      {.column = "instrument_throw_mm",
       .field = number<needle, &Instrument::throw_mm>(0.0, 60.0),
       .json = "instrument/throw_mm",
       .option = {"--throw-mm", "T", "core: how far the tip travels when fired"},
       .unsound = kThrow,
       .of_core_needles = true,
       .of_attempts = true},
      {.column = "instrument_notch_mm",
       .field = number<needle, &Instrument::notch_mm>(0.0, 60.0),
       .json = "instrument/notch_mm",
       .option = {"--notch-mm", "N", "core: length of the sample notch"},
       .unsound = kThrow,
       .of_core_needles = true,
       .of_attempts = true},
      {.column = "instrument_dead_tip_mm",
       .field = number<needle, &Instrument::dead_tip_mm>(0.0, 30.0),
       .json = "instrument/dead_tip_mm",
       .option = {"--dead-tip-mm", "D", "core: from the notch's end to the tip"},
       .unsound = kThrow,
       .of_core_needles = true,
       .of_attempts = true},
      {.column = "inr",
       .field = maybe_number<clinic, &Clinic::inr>(0.5, 20.0),
       .json = "clinic/inr",
       .option = {"--inr", "X", "INR from the laboratory"},
       .unsound = "INR is from 0.5 to 20",
       .page = {.words = "INR", .place = 3, .digits = 1},
       .editor = {.words = "INR", .place = 10, .digits = 1, .usual = 1.0}},
      {.column = "platelets_per_nl",
       .field = maybe_number<clinic, &Clinic::platelets_per_nl>(0.0, 3000.0),
       .json = "clinic/platelets_per_nl",
       .option = {"--platelets", "X", "per nl (10⁹/l)"},
       .unsound = "platelets are from 0 to 3000 per nl",
       .page = {.words = "Platelets per nl", .place = 4},
       .editor = {.words = "platelets 10⁹/l", .place = 11, .usual = 200.0}},
      {.column = "allergy",
       .field = one_line<clinic, &Clinic::allergy>(),
       .json = "clinic/allergy",
       .option = {"--allergy", "TEXT", "mentioned at the sign-in"},
       .unsound = kWords,
       .page = {.words = "Allergy", .place = 5},
       .editor = {.words = "allergy", .place = 12}},
      {.column = "indication",
       .field = one_line<clinic, &Clinic::indication>(),
       .json = "clinic/indication",
       .option = {"--indication", "TEXT", "why"},
       .unsound = kWords,
       .page = {.words = "Indication", .place = 2},
       .editor = {.words = "why", .place = 1}},
      {.column = "decision",
       .field = yes_or_no<clinic, &Clinic::defer>("proceed", "defer", false),
       .json = "clinic/decision",
       .option = {"--decision", "proceed|defer", "the right decision"},
       .page = {.words = "Right decision", .place = 6},
       .editor = {.words = "the right decision is to defer", .place = 15}},
      {.column = "breath_depth",
       .field = number<motion, &Motion::breath_depth>(0.0, cases::breath::kDeepest),
       .json = "motion/breath_depth",
       .option = {"--breath-depth", "SHARE",
                  "1 is a quiet breath (the liver moves 12 mm), 3 a deep one; default 0: no breathing"},
       .unsound = kBreath,
       .page = {.words = "Breath (0 none, 1 quiet, 3 deep)", .place = 10, .digits = 1},
       .editor = {.words = "breath: 1 quiet, 3 deep", .place = 17, .digits = 2, .step = 0.25}},
      {.column = "breath_period_s",
       .field = number<motion, &Motion::breath_period_s>(1.0, 20.0),
       .json = "motion/breath_period_s",
       .option = {"--breath-period-s", "S", "from breath to breath; default 4"},
       .unsound = kBreath,
       .editor = {.words = "breath every s", .place = 18, .digits = 1, .step = 0.5}},
      {.column = "breath_irregularity",
       .field = number<motion, &Motion::breath_irregularity>(0.0, 0.4),
       .json = "motion/breath_irregularity",
       .option = {"--breath-irregularity", "SHARE", "standard deviation of period and depth; default 0.1"},
       .unsound = kBreath,
       .editor = {.words = "breath: irregular by", .place = 19, .digits = 2, .step = 0.05}},
      {.column = "ct_breath",
       .field = choice<cases::kCtBreathNames, motion, &Motion::ct_breath>(),
       .json = "motion/ct_breath",
       .option =
           {"--ct-breath", base::kAlternatives<cases::kCtBreathNames>,
            "the phase of breathing in which the CT was taken, and which is held when asked; default expiration"},
       .editor = {.words = "CT taken in", .place = 20}},
      {.column = "breath_law",
       .field = choice<kBreathLawNames, motion, &Motion::breath_law>(),
       .json = "motion/breath_law"},
      {.column = "tissue_yields",
       .field = yes_or_no<motion, &Motion::yields>("still", "yields", true),
       .json = "motion/tissue",
       .option = {"--tissue", "still|yields", "how tissue responds to probe and needle; default still"},
       .page = {.words = "Tissue", .place = 11},
       .editor = {.words = "tissue yields", .place = 16}},
      {.column = nullptr,
       .field = ComposedField{Composed::planned_entry, kEntryColumns},
       .json = "planned_entry_mm",
       .option = {"--entry-mm", "X,Y,Z", "the planned entry"}},
      {.column = "difficulty",
       .field = choice<kDifficultyNames, &CaseSetting::difficulty>(),
       .json = "difficulty",
       .option = {"--difficulty", base::kAlternatives<kDifficultyNames>, "how hard it is"},
       .page = {.words = "Difficulty", .place = 1},
       .editor = {.words = "difficulty", .place = 9}},
      {.column = "time_limit_s",
       .field = maybe_number<&CaseSetting::time_limit_s>(1.0, 86400.0),
       .json = "time_limit_s",
       .option = {"--time-limit-s", "S", "an attempt ends after this time"},
       .unsound = "a time limit is from 1 s to a day",
       .page = {.words = "Time limit, s", .place = 7},
       .editor = {.words = "time limit s", .place = 13, .usual = 300.0}},
      {.column = "attempt_limit",
       .field = maybe_whole<&CaseSetting::attempt_limit>(1, 1000),
       .json = "attempt_limit",
       .option = {"--attempt-limit", "N", "attempts per trainee"},
       .unsound = "an attempt limit is from 1 to 1000",
       .page = {.words = "Attempts", .place = 8},
       .editor = {.words = "attempts of each", .place = 14, .usual = 10.0}},
      {.column = "sight_law",
       .field = choice<cases::kSightLawNames, &CaseSetting::sight_law>(),
       .json = "sight_law"},
      {.column = "touch_law",
       .field = choice<cases::kTouchLawNames, &CaseSetting::touch, &cases::Touch::law>(),
       .json = "touch_law"},
      {.column = nullptr, .field = ComposedField{Composed::pass_rule, kRuleColumns}, .json = "rule"},
  });
}();

// Those that `shown` gives words, a member of SettingRow with words and a place, in the order of their places.
template <typename Shown>
std::vector<const SettingRow*> shown_rows(Shown SettingRow::*shown) {
  std::vector<const SettingRow*> rows;
  for (const SettingRow& row : kSettingRows)
    if ((row.*shown).words != nullptr) rows.push_back(&row);
  std::stable_sort(rows.begin(), rows.end(), [shown](const SettingRow* a, const SettingRow* b) {
    return (a->*shown).place < (b->*shown).place;
  });
  return rows;
}

}  // namespace seldinger::casedb

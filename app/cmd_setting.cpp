// case setting: what a case asks of whoever attempts it.
#include <cmath>
#include <cstdio>

#include "app/command.h"
#include "app/file.h"
#include "assessment/grading/rule_json.h"
#include "casedb/authoring.h"
#include "sim/case/gauge.h"

namespace seldinger::app {
namespace {

cases::Modality modality_named(const std::string& option, const std::string& name) {
  const auto modality = casedb::modality_from(name);
  if (!modality) throw UsageError(option + " is " + casedb::modality_names());
  return *modality;
}

void read_instrument(const Arguments& arguments, cases::Instrument& needle) {
  if (arguments.has("--instrument")) {
    const std::string kind = arguments.text("--instrument");
    if (kind != "access" && kind != "core") throw UsageError("--instrument is access or core");
    needle.kind = kind == "core" ? cases::InstrumentKind::core : cases::InstrumentKind::access;
  }
  if (arguments.has("--gauge")) {
    const auto gauge = cases::gauge(static_cast<int>(arguments.whole("--gauge", 22, 1, 99)));
    if (!gauge) throw UsageError("--gauge is 16 to 25");
    needle.radius_mm = gauge->outer_mm / 2.0;
  }
  needle.length_mm = arguments.number("--length-mm", needle.length_mm);
  needle.throw_mm = arguments.number("--throw-mm", needle.throw_mm);
  needle.notch_mm = arguments.number("--notch-mm", needle.notch_mm);
  needle.dead_tip_mm = arguments.number("--dead-tip-mm", needle.dead_tip_mm);
}

void read_clinic(const Arguments& arguments, casedb::Clinic& clinic) {
  if (arguments.has("--inr")) clinic.inr = arguments.number("--inr", 0.0);
  if (arguments.has("--platelets")) clinic.platelets_per_nl = arguments.number("--platelets", 0.0);
  clinic.allergy = arguments.text("--allergy", clinic.allergy);
  clinic.indication = arguments.text("--indication", clinic.indication);
  if (arguments.has("--decision")) {
    const std::string decision = arguments.text("--decision");
    if (decision != "proceed" && decision != "defer") throw UsageError("--decision is proceed or defer");
    clinic.defer = decision == "defer";
  }
}

void read_motion(const Arguments& arguments, casedb::Motion& motion) {
  motion.breath_depth = arguments.number("--breath-depth", motion.breath_depth);
  motion.breath_period_s = arguments.number("--breath-period-s", motion.breath_period_s);
  motion.breath_irregularity = arguments.number("--breath-irregularity", motion.breath_irregularity);
  if (arguments.has("--tissue")) {
    const std::string tissue = arguments.text("--tissue");
    if (tissue != "still" && tissue != "yields") throw UsageError("--tissue is still or yields");
    motion.yields = tissue == "yields";
  }
}

void read_criteria(const Arguments& arguments, assessment::PassRule& rule) {
  if (!arguments.has("--pass") && !arguments.has("--critical")) return;
  rule.criteria.clear();
  for (const char* option : {"--pass", "--critical"}) {
    if (!arguments.has(option)) continue;
    for (const std::string& text : arguments.all(option)) {
      auto criterion = assessment::criterion_from(text);
      if (!criterion) throw UsageError(std::string(option) + " is METRIC<=VALUE, METRIC>=VALUE or METRIC=VALUE");
      criterion->critical = std::string(option) == "--critical";
      rule.criteria.push_back(std::move(*criterion));
    }
  }
}

void read_setting(const Arguments& arguments, casedb::CaseSetting& setting) {
  if (arguments.has("--modality")) {
    setting.modality = modality_named("--modality", arguments.text("--modality"));
    std::erase(setting.further_modalities, setting.modality);
  }
  if (arguments.has("--also")) {
    setting.further_modalities.clear();
    for (const std::string& name : arguments.all("--also"))
      if (name != "none") setting.further_modalities.push_back(modality_named("--also", name));
  }
  if (arguments.has("--subject")) {
    const auto subject = casedb::subject_from(arguments.text("--subject"));
    if (!subject) throw UsageError("--subject is patient or phantom");
    setting.subject = *subject;
  }
  if (arguments.has("--position")) {
    const auto position = casedb::position_from(arguments.text("--position"));
    if (!position) throw UsageError("--position is supine, prone, lateral_left or lateral_right");
    setting.position = *position;
  }
  if (arguments.has("--approach")) {
    const std::string approach = arguments.text("--approach");
    if (approach != "in_plane" && approach != "out_of_plane")
      throw UsageError("--approach is in_plane or out_of_plane");
    setting.approach = approach == "in_plane" ? cases::Approach::in_plane : cases::Approach::out_of_plane;
  }
  read_instrument(arguments, setting.instrument);
  read_clinic(arguments, setting.clinic);
  read_motion(arguments, setting.motion);
  if (arguments.has("--entry-mm")) {
    setting.planned_entry_lps_mm = parse_point(arguments.text("--entry-mm"));
    if (!setting.planned_entry_lps_mm) throw UsageError("--entry-mm needs X,Y,Z in mm");
  }
  if (arguments.has("--difficulty")) {
    bool known = false;
    for (std::size_t i = 0; i < casedb::kDifficultyNames.size(); ++i)
      if (arguments.text("--difficulty") == casedb::kDifficultyNames[i]) {
        setting.difficulty = static_cast<casedb::Difficulty>(i);
        known = true;
      }
    if (!known) throw UsageError("--difficulty is easy, moderate or hard");
  }
  if (arguments.has("--time-limit-s")) setting.time_limit_s = arguments.number("--time-limit-s", 0.0);
  if (arguments.has("--attempt-limit"))
    setting.attempt_limit = static_cast<int>(arguments.whole("--attempt-limit", 1, 1, 1000));
  read_criteria(arguments, setting.rule);
}

int run_case_setting(const Arguments& arguments) {
  const std::string folder = arguments.required("--library"), case_id = arguments.positional(0);
  std::optional<assessment::PassRule> rule;
  if (arguments.has("--rule")) {
    if (arguments.has("--pass") || arguments.has("--critical"))
      throw UsageError("a rule is a file, or --pass and --critical");
    const auto text = read_text(arguments.text("--rule"), 1U << 20U);
    if (!text) return refuse(text.error());
    auto read = assessment::rule_from_json(*text);
    if (!read) return refuse(read.error());
    rule = std::move(*read);
  }
  {
    casedb::CaseSetting any;
    read_setting(arguments, any);  // wrong use is told before a library is asked for
  }
  auto library = casedb::Library::open(folder);
  if (!library) return refuse(library.error());
  const auto row = casedb::find_case(*library, case_id);
  if (!row) return refuse(row.error());
  casedb::CaseSetting setting = *row;
  read_setting(arguments, setting);
  if (rule) setting.rule = std::move(*rule);
  if (arguments.has("--title"))
    if (const auto set = casedb::set_title(*library, case_id, arguments.text("--title")); !set)
      return refuse(set.error());
  const auto set = casedb::set_setting(*library, case_id, setting);
  return set ? kDone : refuse(set.error());
}

// The options of `case setting`.
std::span<const Option> setting_options() {
  static constexpr Option kOptions[] = {
      kLibrary,
      {"--title", "TEXT", "the case's title"},
      {"--modality", "mpr|xray|ultrasound", "what it is practised with"},
      {"--also", "mpr|xray|ultrasound|none", "what it may be practised with too; none: nothing else", true},
      {"--subject", "patient|phantom", "phantom: a block to practise on; nothing is asked around a patient"},
      {"--position", "supine|prone|lateral_left|lateral_right", "how the patient lies"},
      {"--approach", "in_plane|out_of_plane", "of needle to picture"},
      {"--instrument", "access|core", "access: the tip decides; core: the fired notch"},
      {"--gauge", "G", "16 to 25"},
      {"--length-mm", "L", "the needle's"},
      {"--throw-mm", "T", "core: the way the tip goes when fired"},
      {"--notch-mm", "N", "core: length of the sample notch"},
      {"--dead-tip-mm", "D", "core: from the notch's end to the tip"},
      {"--inr", "X", "what the laboratory found"},
      {"--platelets", "X", "per nl (10⁹/l)"},
      {"--allergy", "TEXT", "told at the sign-in"},
      {"--indication", "TEXT", "why"},
      {"--decision", "proceed|defer", "what is right"},
      {"--breath-depth", "SHARE", "of a quiet breath, 16 mm of liver; default 0: none is shown"},
      {"--breath-period-s", "S", "from breath to breath; default 4"},
      {"--breath-irregularity", "SHARE", "standard deviation of its period and depth; default 0.1"},
      {"--tissue", "still|yields", "to probe and needle; default still"},
      {"--entry-mm", "X,Y,Z", "the planned entry"},
      {"--difficulty", "easy|moderate|hard", "how hard it is"},
      {"--time-limit-s", "S", "an attempt ends then"},
      {"--attempt-limit", "N", "so many a trainee"},
      {"--pass", "METRIC>=VALUE", "a criterion: <=, >= or =; with --critical it makes the whole rule anew", true},
      {"--critical", "METRIC=VALUE", "a criterion that must not be missed whatever else is good", true},
      {"--rule", "FILE.json", "the rule from a file"}};
  return kOptions;
}

}  // namespace

Command case_setting_command() {
  return {.name = "case setting",
          .positionals = "CASE",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = setting_options(),
          .summary =
              "Sets what a case asks of whoever attempts it: guidance, needle, patient, limits, pass rule. What is "
              "not given stays.",
          .run = &run_case_setting};
}

}  // namespace seldinger::app

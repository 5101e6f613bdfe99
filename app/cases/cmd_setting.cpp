// case setting: what a case asks of whoever attempts it.
#include <algorithm>

#include "app/acting/acting.h"
#include "app/cases/setting_options.h"
#include "app/cli/command.h"
#include "app/cli/file.h"
#include "app/cli/words.h"
#include "assessment/grading/rule_json.h"
#include "assessment/registry.h"
#include "casedb/cases/authoring.h"
#include "casedb/cases/setting_table.h"
#include "sim/case/gauge.h"

namespace seldinger::app {
namespace {

void read_composed(const Arguments& arguments, const casedb::SettingOption& option, casedb::Composed what,
                   casedb::CaseSetting& setting) {
  const std::string name = option.name;
  switch (what) {
    case casedb::Composed::further_modalities:
      setting.further_modalities.clear();
      for (const std::string& one : arguments.all(name)) {
        if (one == "none") continue;
        const auto modality = casedb::modality_from(one);
        if (!modality) throw UsageError(name + " is " + casedb::modality_names());
        setting.further_modalities.push_back(*modality);
      }
      break;
    case casedb::Composed::gauge: {
      const auto gauge = cases::gauge(static_cast<int>(arguments.whole(name, 22, 1, 99)));
      if (!gauge) throw UsageError(name + " is " + option.help);
      setting.instrument.radius_mm = gauge->outer_mm / 2.0;
      break;
    }
    case casedb::Composed::planned_entry:
      setting.planned_entry_lps_mm = point_of(name, arguments.text(name));
      break;
    case casedb::Composed::pass_rule:  // read_criteria: several options make one
      break;
  }
}

void read_row(const Arguments& arguments, const casedb::SettingRow& row, casedb::CaseSetting& setting) {
  using namespace casedb;
  if (row.option.name == nullptr || !arguments.has(row.option.name)) return;
  const std::string name = row.option.name;
  std::visit(OfKind{[&](const NumberField& one) { one.set(setting, arguments.number(name, 0.0)); },
                    [&](const MaybeNumberField& one) { one.set(setting, arguments.number(name, 0.0)); },
                    [&](const MaybeWholeField& one) {
                      one.set(setting, static_cast<int>(arguments.whole(name, one.least, one.least, one.most)));
                    },
                    [&](const TextField& one) { one.set(setting, arguments.text(name)); },
                    [&](const ChoiceField& one) {
                      if (!one.set(setting, arguments.text(name)))
                        throw UsageError(name + " is " + base::listed(one.names));
                    },
                    [&](const SwitchField& one) {
                      const std::string word = arguments.text(name);
                      const std::string_view both[] = {one.no, one.yes};
                      if (word != one.no && word != one.yes) throw UsageError(name + " is " + base::listed(both));
                      one.set(setting, word == one.yes);
                    },
                    [&](const ComposedField& one) { read_composed(arguments, row.option, one.what, setting); }},
             row.field);
}

void read_criteria(const Arguments& arguments, casedb::CaseSetting& setting) {
  if (!arguments.has("--pass") && !arguments.has("--critical")) return;
  setting.rule.criteria.clear();
  for (const char* option : {"--pass", "--critical"}) {
    if (!arguments.has(option)) continue;
    for (const std::string& text : arguments.all(option)) {
      auto criterion = assessment::criterion_from(text, setting.sight_law);
      if (!criterion)
        throw UsageError(std::string(option) + " is METRIC<=VALUE, METRIC>=VALUE or METRIC=VALUE, not " +
                         shown(text));
      if (assessment::find_metric(criterion->metric) == nullptr)
        throw UsageError(std::string(option) + ": no metric is called " + shown(criterion->metric) +
                         "; `seldinger help --metrics` lists them");
      criterion->critical = std::string(option) == "--critical";
      setting.rule.criteria.push_back(std::move(*criterion));
    }
  }
}

void read_setting(const Arguments& arguments, casedb::CaseSetting& setting) {
  for (const casedb::SettingRow& row : casedb::kSettingRows) read_row(arguments, row, setting);
  read_criteria(arguments, setting);
}

// Than its title, which a draft with attempts may change too.
bool sets_more(const Arguments& arguments) {
  return std::any_of(casedb::kSettingRows.begin(), casedb::kSettingRows.end(),
                     [&](const casedb::SettingRow& row) {
                       return row.option.name != nullptr && arguments.has(row.option.name);
                     }) ||
         arguments.has("--rule") || arguments.has("--pass") || arguments.has("--critical");
}

int run_case_setting(const Arguments& arguments) {
  if (!sets_more(arguments) && !arguments.has("--title"))
    throw UsageError("nothing is to be set; `seldinger help case setting` lists what can be");
  std::optional<std::string> rule;
  if (arguments.has("--rule")) {
    if (arguments.has("--pass") || arguments.has("--critical"))
      throw UsageError("a rule is a file, or --pass and --critical");
    const auto text = read_text_of(arguments, "--rule", 1U << 20U);
    if (!text) return refuse(text.error());
    if (const auto read = assessment::rule_from_json(*text); !read) return refuse(read.error());
    rule = *text;
  }
  {
    casedb::CaseSetting any;
    read_setting(arguments, any);  // wrong use is told before a library is asked for
  }
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  const std::string& case_id = arguments.positional(0);
  const auto row = casedb::find_case(*library, case_id);
  if (!row) return refuse(row.error());
  if (const auto may = may_work_on(*library, arguments); !may) return refuse(may.error());
  casedb::CaseSetting setting = *row;
  read_setting(arguments, setting);
  if (rule) setting.rule = std::move(assessment::rule_from_json(*rule, row->sight_law)).value();
  std::optional<std::string> title;
  if (arguments.has("--title")) title = arguments.text("--title");
  const auto set = title && !sets_more(arguments) ? casedb::set_title(*library, case_id, *title)
                                                  : casedb::set_setting(*library, case_id, setting, title);
  return set ? kDone : refuse(set.error());
}

}  // namespace

Command case_setting_command() {
  return {.name = "case setting",
          .positionals = "CASE",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kSettingOptions,
          .acts = true,
          .summary =
              "Sets what a case asks of the trainee: guidance, needle, patient, limits, pass rule. What is "
              "not given stays.",
          .run = &run_case_setting};
}

}  // namespace seldinger::app

#include "app/commands.h"

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "sim/base/training_only.h"

namespace seldinger::app {

// Every command, in the order in which help lists them. A command's row (options, help, run) is NAME_command() at
// the end of its cmd_*.cpp.
#define SELDINGER_COMMANDS(ROW) \
  ROW(import)                   \
  ROW(sample)                   \
  ROW(case_list)                \
  ROW(case_show)                \
  ROW(case_explain)             \
  ROW(case_lesion)              \
  ROW(case_mesh)                \
  ROW(case_structure)           \
  ROW(case_label)               \
  ROW(case_setting)             \
  ROW(case_check)               \
  ROW(case_meet)                \
  ROW(case_confirm)             \
  ROW(case_review)              \
  ROW(case_publish)             \
  ROW(case_retire)              \
  ROW(case_version)             \
  ROW(case_delete)              \
  ROW(deidentify)               \
  ROW(case_bundle)              \
  ROW(bundle_export)            \
  ROW(bundle_import)            \
  ROW(bundle_check)             \
  ROW(bundle_key)               \
  ROW(bundle_trust)             \
  ROW(backup)                   \
  ROW(restore)                  \
  ROW(check)                    \
  ROW(render)                   \
  ROW(sheet)                    \
  ROW(simulate)                 \
  ROW(simulate_merge)           \
  ROW(simulate_answers)         \
  ROW(surrogate_fit)            \
  ROW(surrogate_check)          \
  ROW(surrogate_effects)        \
  ROW(surrogate_distributions)  \
  ROW(surrogate_coverage)       \
  ROW(recovery)                 \
  ROW(score)                    \
  ROW(replay)                   \
  ROW(recompute)                \
  ROW(export)                   \
  ROW(attempt_list)             \
  ROW(attempt_show)             \
  ROW(attempt_compare)          \
  ROW(attempt_delete)           \
  ROW(standard_set)             \
  ROW(standard_show)            \
  ROW(standard_propose)         \
  ROW(standard_freeze)          \
  ROW(standard_cuts)            \
  ROW(standard_dependability)   \
  ROW(curriculum_add)           \
  ROW(curriculum_item)          \
  ROW(curriculum_publish)       \
  ROW(curriculum_list)          \
  ROW(curriculum_show)          \
  ROW(curriculum_remove)        \
  ROW(user_add)                 \
  ROW(user_list)                \
  ROW(user_passwd)              \
  ROW(user_invite)              \
  ROW(user_reset)               \
  ROW(user_level)               \
  ROW(user_disable)             \
  ROW(user_enable)              \
  ROW(user_unlock)              \
  ROW(user_role)                \
  ROW(user_fact)                \
  ROW(user_erase)               \
  ROW(login)                    \
  ROW(logout)                   \
  ROW(audit)                    \
  ROW(cohort_add)               \
  ROW(cohort_list)              \
  ROW(cohort_show)              \
  ROW(cohort_enrol)             \
  ROW(cohort_direct)            \
  ROW(study_new)                \
  ROW(study_list)               \
  ROW(study_researcher)         \
  ROW(study_template)           \
  ROW(study_plan)               \
  ROW(study_show)               \
  ROW(study_freeze)             \
  ROW(study_enrol)              \
  ROW(study_look)               \
  ROW(study_deviate)            \
  ROW(study_lock)               \
  ROW(study_simulate)           \
  ROW(study_stations)           \
  ROW(study_visits)             \
  ROW(report)                   \
  ROW(workshop_open)            \
  ROW(workshop_admit)           \
  ROW(workshop_tick)            \
  ROW(workshop_show)            \
  ROW(workshop_close)           \
  ROW(questionnaire_template)   \
  ROW(questionnaire_add)        \
  ROW(questionnaire_list)       \
  ROW(questionnaire_show)       \
  ROW(questionnaire_open)       \
  ROW(questionnaire_close)      \
  ROW(questionnaire_import)     \
  ROW(questionnaire_export)     \
  ROW(rating_open)              \
  ROW(rating_show)              \
  ROW(rating_export)            \
  ROW(consent_text)             \
  ROW(consent_list)             \
  ROW(consent_give)             \
  ROW(consent_withdraw)         \
  ROW(stats)                    \
  ROW(haptics_insert)           \
  ROW(haptics_needles)          \
  ROW(haptics_fit)              \
  ROW(haptics_calibrate)        \
  ROW(haptics_stability)        \
  ROW(haptics_selftest)         \
  ROW(device_list)              \
  ROW(device_probe)             \
  ROW(device_simulate)          \
  ROW(bench)                    \
  ROW(goals_ultrasound)         \
  ROW(goals_haptics)            \
  ROW(doctor)                   \
  ROW(demo)                     \
  ROW(train)                    \
  ROW(serve)                    \
  ROW(help)

#define ROW(name) Command name##_command();
SELDINGER_COMMANDS(ROW)
#undef ROW

namespace {

// The nouns of help, in its order.
struct Group {
  const char* title;
  std::vector<std::string_view> nouns;
};
const std::vector<Group>& groups() {
  static const std::vector<Group> kGroups = {
      {"To begin", {"demo", "train", "serve", "doctor", "help"}},
      {"Cases", {"import", "sample", "case", "deidentify", "bundle"}},
      {"Attempts",
       {"simulate", "surrogate", "recovery", "score", "replay", "recompute", "export", "attempt", "standard",
        "curriculum"}},
      {"People", {"user", "login", "logout", "audit", "cohort", "consent"}},
      {"Studies", {"study", "workshop", "questionnaire", "rating", "report"}},
      {"Numbers", {"stats"}},
      {"The library", {"backup", "restore", "check"}},
      {"Pictures", {"render", "sheet"}},
      {"Hands", {"haptics", "device"}},
      {"Measurements", {"bench", "goals"}}};
  return kGroups;
}

std::string_view noun_of(const Command& command) {
  const std::string_view name = command.name;
  return name.substr(0, name.find(' '));
}

std::string synopsis(const Command& command) {
  std::string text = std::string("seldinger ") + command.name;
  if (*command.positionals != '\0') text += std::string(" ") + command.positionals;
  return text + (options_of(command).empty() ? "" : " [options]");
}

constexpr std::size_t kHelpColumns = 80;

std::size_t columns_of(std::string_view text) {  // of UTF-8, a column a letter
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80; }));
}

// `text` in lines of at most kHelpColumns, each after `indent` spaces; the first one goes on after `lead`.
std::string wrapped(const std::string& lead, std::size_t indent, const std::string& text) {
  std::string made = lead;
  std::size_t column = columns_of(lead);
  if (column > indent || (column == indent && lead.find_last_not_of(' ') == lead.size() - 1 && !lead.empty())) {
    made += "\n";
    column = 0;
  }
  made += std::string(indent - column, ' ');
  column = indent;
  std::istringstream words(text);
  bool first = true;
  for (std::string word; words >> word; first = false) {
    if (!first && column + 1 + columns_of(word) > kHelpColumns) {
      made += "\n" + std::string(indent, ' ');
      column = indent;
    } else if (!first) {
      made += ' ';
      ++column;
    }
    made += word;
    column += columns_of(word);
  }
  return made + "\n";
}

std::string typed_name(const Option& option) {
  std::string name = option.name;
  if (option.value != nullptr) name += std::string(" ") + option.value;
  return name + (option.repeatable ? " …" : "");
}

bool is_of(std::string_view example, const Command& command) {
  const std::string name = command.name;
  return example == name || example.starts_with(name + " ");
}

}  // namespace

std::span<const Command> commands() {
#define ROW(name) name##_command(),
  static const Command kCommands[] = {SELDINGER_COMMANDS(ROW)};
#undef ROW
  return kCommands;
}

std::string help_text(const Command& command) {
  std::string text = synopsis(command) + "\n" + wrapped("  ", 2, command.summary);
  std::string lines;
  for (const std::string_view example : examples())
    if (is_of(example, command)) lines += "  seldinger " + std::string(example) + "\n";
  if (!lines.empty()) text += "\nExamples\n" + lines;
  const std::vector<Option> options = options_of(command);
  if (!options.empty()) text += "\nOptions\n";
  for (const Option& option : options) text += wrapped("  " + typed_name(option), 22, option.help);
  return text;
}

std::string help_text_of_noun(std::string_view noun) {
  std::string lines;
  for (const Command& command : commands()) {
    const std::string name = command.name;
    if (noun_of(command) != noun || name == noun) continue;
    lines += wrapped("  " + name + (*command.positionals != '\0' ? std::string(" ") + command.positionals : ""), 26,
                     command.summary);
  }
  if (lines.empty()) return lines;
  return lines + "\n`seldinger help " + std::string(noun) +
         " …` shows the options of one of them, with examples.\n";
}

std::string help_text() {
  std::string text =
      wrapped("", 0, std::string("seldinger: training in image-guided needle puncture. ") + base::kTrainingOnly);
  for (const Group& group : groups()) {
    text += "\n" + std::string(group.title) + "\n";
    for (const std::string_view noun : group.nouns) {
      std::string of_noun;
      for (const Command& command : commands()) {
        const std::string name = command.name;
        if (noun_of(command) != noun) continue;
        if (name == noun)
          text +=
              wrapped("  " + name + (*command.positionals != '\0' ? std::string(" ") + command.positionals : ""),
                      22, command.summary);
        else
          of_noun += (of_noun.empty() ? "" : ", ") + name.substr(noun.size() + 1);
      }
      if (!of_noun.empty()) text += wrapped("  " + std::string(noun), 22, of_noun);
    }
  }
  return text +
         "\nFor example\n  seldinger demo --no-serve          a case, a lesion, attempts\n"
         "  seldinger case show Built          a case by the beginning of its title\n"
         "  seldinger help case                what can be done with cases\n"
         "  seldinger help case lesion         one command, its options and examples\n"
         "  seldinger --version\n\n" +
         wrapped("", 0,
                 "Name a case, lesion, attempt, study, cohort or curriculum by its id, its title, or a unique "
                 "beginning.");
}

std::string commands_markdown() {
  std::string text =
      "# Commands\n\nMade from the table in `app/commands.cpp` by `seldinger help --commands`; a test compares, "
      "and "
      "another types every example (`tests/e2e/examples_test.cpp`).\n"
      "Lengths in mm, coordinates in LPS. Exit codes: 0 done · 1 ran, but its check failed · 2 usage · "
      "3 the input is refused, nothing is changed · 4 the environment fails (disk, database, GL).\n"
      "`--` ends the options: nothing after it is an option, even if it begins with dashes.\n\n"
      "Without `--library`, the library is the one that the environment variable `SELDINGER_LIBRARY` names, else "
      "the demo's (`seldinger/demo` under the user's data folder). CASE, LESION, ATTEMPT, STUDY, COHORT and "
      "CURRICULUM may be an id, a title, or a unique beginning. With `--json` an error is "
      "also "
      "printed to standard "
      "output, as `{\"error\": {\"code\", \"text\"}}` ([codes](errors.md)).\n";
  for (const Command& command : commands()) {
    text += "\n## " + std::string(command.name) + "\n\n" + command.summary + "\n\n```\n" + synopsis(command) + "\n";
    for (const std::string_view example : examples())
      if (is_of(example, command)) text += "\nseldinger " + std::string(example);
    text += "\n```\n";
    if (options_of(command).empty()) continue;
    text += "\n| option | what |\n|---|---|\n";
    for (const Option& option : options_of(command)) {
      std::string name = typed_name(option);
      for (std::size_t at = 0; (at = name.find('|', at)) != std::string::npos; at += 2) name.replace(at, 1, "\\|");
      text += "| `" + name + "` | " + option.help + " |\n";
    }
  }
  return text;
}

}  // namespace seldinger::app

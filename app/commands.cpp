#include "app/commands.h"

#include <algorithm>
#include <cstdio>
#include <string>

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
  ROW(backup)                   \
  ROW(restore)                  \
  ROW(check)                    \
  ROW(render)                   \
  ROW(sheet)                    \
  ROW(simulate)                 \
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
  ROW(curriculum_add)           \
  ROW(curriculum_item)          \
  ROW(curriculum_publish)       \
  ROW(curriculum_list)          \
  ROW(curriculum_show)          \
  ROW(curriculum_remove)        \
  ROW(user_add)                 \
  ROW(user_list)                \
  ROW(user_passwd)              \
  ROW(user_level)               \
  ROW(user_disable)             \
  ROW(user_enable)              \
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
  ROW(consent_text)             \
  ROW(consent_list)             \
  ROW(consent_give)             \
  ROW(consent_withdraw)         \
  ROW(haptics_insert)           \
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

std::string synopsis(const Command& command) {
  std::string text = std::string("seldinger ") + command.name;
  if (*command.positionals != '\0') text += std::string(" ") + command.positionals;
  for (const Option& option : options_of(command)) {
    text += std::string(" [") + option.name;
    if (option.value != nullptr) text += std::string(" ") + option.value;
    text += option.repeatable ? " …]" : "]";
  }
  return text;
}

}  // namespace

std::span<const Command> commands() {
#define ROW(name) name##_command(),
  static const Command kCommands[] = {SELDINGER_COMMANDS(ROW)};
#undef ROW
  return kCommands;
}

std::string help_text(const Command& command) {
  std::string text = synopsis(command) + "\n  " + command.summary + "\n";
  for (const Option& option : options_of(command)) {
    std::string name = option.name;
    if (option.value != nullptr) name += std::string(" ") + option.value;
    name.resize(std::max<std::size_t>(name.size(), 26), ' ');
    text += "  " + name + " " + option.help + "\n";
  }
  return text;
}

std::string help_text() {
  std::string text =
      std::string("seldinger: training in image-guided needle puncture. ") + base::kTrainingOnly + "\n\n";
  for (const Command& command : commands()) {
    std::string name = command.name;
    if (*command.positionals != '\0') name += std::string(" ") + command.positionals;
    name.resize(std::max<std::size_t>(name.size(), 22), ' ');
    text += "  " + name + " " + command.summary + "\n";
  }
  return text + "\n`seldinger help COMMAND` lists a command's options; `seldinger --version` prints the version.\n";
}

std::string commands_markdown() {
  std::string text =
      "# Commands\n\nMade from the table in `app/commands.cpp` by `seldinger help --commands`; a test compares.\n"
      "Lengths in mm, coordinates in LPS. Exit codes: 0 done · 1 ran and its check did not hold · 2 usage · "
      "3 the input is refused, nothing is changed · 4 the environment fails (disk, database, GL).\n";
  for (const Command& command : commands()) {
    text += "\n## " + std::string(command.name) + "\n\n" + command.summary + "\n\n```\n" + synopsis(command) +
            "\n```\n";
    if (options_of(command).empty()) continue;
    text += "\n| option | what |\n|---|---|\n";
    for (const Option& option : options_of(command)) {
      std::string value = option.value == nullptr ? "" : std::string(" ") + option.value;
      for (std::size_t at = 0; (at = value.find('|', at)) != std::string::npos; at += 2)
        value.replace(at, 1, "\\|");
      text += "| `" + std::string(option.name) + value + "` | " + option.help + " |\n";
    }
  }
  return text;
}

}  // namespace seldinger::app

// The command table: it drives the command line, `seldinger help` and docs/commands.md.
#pragma once

#include <span>
#include <string>

#include "app/arguments.h"
#include "sim/base/result.h"

namespace seldinger::app {

// contracts.md, exit codes
constexpr int kDone = 0, kCheckFailed = 1, kUsage = 2, kRefused = 3, kEnvironment = 4;

struct Option {
  const char* name;   // "--library"
  const char* value;  // what follows, e.g. "DIR"; nullptr: a flag
  const char* help;
  bool repeatable = false;
};

struct Command {
  const char* name;         // one or two words
  const char* positionals;  // as shown, e.g. "CASE"
  std::size_t min_positionals, max_positionals;
  std::span<const Option> options;
  const char* summary;
  int (*run)(const Arguments&);
};

std::span<const Command> commands();

// `seldinger help` and docs/commands.md.
std::string help_text();
std::string help_text(const Command& command);
std::string commands_markdown();

// Prints `error: <code>: <text>` and the findings to standard error; returns kRefused.
int refuse(const base::Error& error);

int run_help(const Arguments& arguments);
int run_import(const Arguments& arguments);
int run_sample(const Arguments& arguments);
int run_case_list(const Arguments& arguments);
int run_case_show(const Arguments& arguments);
int run_case_explain(const Arguments& arguments);
int run_case_lesion(const Arguments& arguments);
int run_case_confirm(const Arguments& arguments);
int run_case_mesh(const Arguments& arguments);
int run_case_bundle(const Arguments& arguments);
int run_bundle_export(const Arguments& arguments);
int run_bundle_import(const Arguments& arguments);
int run_bundle_check(const Arguments& arguments);
int run_backup(const Arguments& arguments);
int run_restore(const Arguments& arguments);
int run_check(const Arguments& arguments);
int run_case_structure(const Arguments& arguments);
int run_case_label(const Arguments& arguments);
int run_case_setting(const Arguments& arguments);
int run_case_check(const Arguments& arguments);
int run_case_review(const Arguments& arguments);
int run_case_publish(const Arguments& arguments);
int run_case_retire(const Arguments& arguments);
int run_case_version(const Arguments& arguments);
int run_deidentify(const Arguments& arguments);
int run_render(const Arguments& arguments);
int run_sheet(const Arguments& arguments);
int run_simulate(const Arguments& arguments);
int run_score(const Arguments& arguments);
int run_replay(const Arguments& arguments);
int run_export(const Arguments& arguments);
int run_recompute(const Arguments& arguments);
int run_attempt_list(const Arguments& arguments);
int run_attempt_show(const Arguments& arguments);
int run_attempt_compare(const Arguments& arguments);
int run_curriculum_add(const Arguments& arguments);
int run_curriculum_item(const Arguments& arguments);
int run_curriculum_publish(const Arguments& arguments);
int run_curriculum_list(const Arguments& arguments);
int run_curriculum_show(const Arguments& arguments);
int run_curriculum_remove(const Arguments& arguments);
int run_user_level(const Arguments& arguments);
int run_user_add(const Arguments& arguments);
int run_user_list(const Arguments& arguments);
int run_user_passwd(const Arguments& arguments);
int run_user_disable(const Arguments& arguments);
int run_haptics_insert(const Arguments& arguments);
int run_haptics_fit(const Arguments& arguments);
int run_haptics_calibrate(const Arguments& arguments);
int run_haptics_selftest(const Arguments& arguments);
int run_device_list(const Arguments& arguments);
int run_device_probe(const Arguments& arguments);
int run_device_simulate(const Arguments& arguments);
// bench, goals and haptics stability: becomes seldinger-measure, which lies beside this program.
int run_measure(const Arguments& arguments);
int run_doctor(const Arguments& arguments);
int run_demo(const Arguments& arguments);
int run_serve(const Arguments& arguments);
int run_train(const Arguments& arguments);

}  // namespace seldinger::app

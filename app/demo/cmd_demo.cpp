// demo: the main job, end to end.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <thread>

#include "app/attempts/answers_json.h"
#include "app/attempts/this_program.h"
#include "app/cases/import_case.h"
#include "app/cli/command.h"
#include "app/cli/library_place.h"
#include "app/demo/demo_case.h"
#include "app/demo/demo_cases.h"
#include "app/demo/demo_library.h"
#include "app/demo/demo_programme.h"
#include "app/library/serving.h"
#include "assessment/operators/lesion_site.h"
#include "assessment/registry.h"
#include "session/attempt/simulation.h"
#include "sim/base/training_only.h"

namespace seldinger::app {
namespace {

constexpr const char* kOperators[] = {"novice", "intermediate", "expert"};
constexpr std::array<std::uint64_t, 5> kSeeds = {1, 2, 3, 4, 5};

// The attempt of each operator that stands for his seeds; one that an earlier run left is used again.
base::Result<void> demo_attempts(casedb::Library& library, DemoAnswer& answer) {
  const auto accounts = casedb::list_users(library);
  auto attempts = casedb::list_attempts(library);
  std::reverse(attempts.begin(), attempts.end());  // oldest first
  std::optional<session::Simulation> simulation;
  for (const char* name : kOperators) {
    const auto account = std::find_if(accounts.begin(), accounts.end(),
                                      [&](const casedb::Account& one) { return one.login_name == name; });
    const std::optional<std::string> person_id =
        account == accounts.end() ? std::nullopt : std::optional(account->person_id);
    const auto there = std::find_if(attempts.begin(), attempts.end(), [&](const casedb::AttemptRow& one) {
      return one.case_id == answer.found.case_id && one.lesion_id == answer.lesion.lesion_id &&
             one.operator_name == name && one.synthetic() && one.person_id == person_id;
    });
    if (there != attempts.end()) {
      answer.attempts.push_back({there->attempt_id, there->operator_name, there->seed, there->metrics});
      continue;
    }
    if (!simulation) {
      auto prepared =
          session::Simulation::prepare(library, this_program(), answer.found.case_id, answer.lesion.lesion_id);
      if (!prepared) return prepared.error();
      simulation.emplace(std::move(*prepared));
    }
    const std::size_t jobs = std::clamp(std::thread::hardware_concurrency(), 1U, 5U);
    auto attempt = simulation->median_attempt(*assessment::named_profile(name), kSeeds, jobs, person_id);
    if (!attempt) return attempt.error();
    answer.attempts.push_back(std::move(*attempt));
  }
  return {};
}

void print_value(const assessment::MetricValue& metric) {
  if (metric.value)
    std::printf(" %12.*f", metric.unit == "count" || metric.unit == "bool" ? 0 : 2, *metric.value);
  else
    std::printf("            –");  // one column wide, three bytes long
}

void print_answer(const DemoAnswer& answer, const std::filesystem::path& folder) {
  const cases::Lesion& lesion = answer.lesion.lesion;
  std::printf("%s\n\nLibrary  %s\nCase     %s  %s\n", base::kTrainingOnly, folder.c_str(),
              answer.found.case_id.c_str(), answer.found.title.c_str());
  for (const base::Problem& warning : answer.found.warnings)
    std::printf("         warning: %s: %s\n", warning.code.c_str(), warning.text.c_str());
  int width = 0;
  if (!answer.attempts.empty())
    for (const assessment::MetricValue& metric : answer.attempts.front().metrics)
      width = std::max(width, static_cast<int>(metric.id.size()));
  std::printf(
      "Lesion   %.0f mm across at (%.1f, %.1f, %.1f) mm LPS, %.0f HU, its centre %.0f mm below the skin\n"
      "         rule: %s\n\n%-*s",
      2.0 * lesion.radius_mm, lesion.center_lps_mm.x, lesion.center_lps_mm.y, lesion.center_lps_mm.z, lesion.hu,
      answer.lesion_depth_mm, answer.lesion_rule.c_str(), width, "Metric");
  for (const session::SimulatedAttempt& attempt : answer.attempts)
    std::printf(" %12s", attempt.operator_name.c_str());
  std::printf("  unit\n");
  // As demo_attempts lets them practise.
  const assessment::Manner manner{answer.found.modality, cases::Approach::in_plane, cases::InstrumentKind::access};
  for (std::size_t i = 0; !answer.attempts.empty() && i < answer.attempts.front().metrics.size(); ++i) {
    const assessment::MetricValue& first = answer.attempts.front().metrics[i];
    if (!assessment::applies(first, manner) || assessment::absent_from_case(first.reason)) continue;
    std::printf("%-*s", width, first.id.c_str());
    for (const session::SimulatedAttempt& attempt : answer.attempts)
      for (const assessment::MetricValue& metric : attempt.metrics)
        if (metric.id == first.id) print_value(metric);
    std::printf("  %s\n", first.unit.c_str());
  }
  std::printf("\nEach attempt is the middle one of %zu with different seeds (here", kSeeds.size());
  for (const session::SimulatedAttempt& attempt : answer.attempts)
    std::printf("%s %s %llu", &attempt == &answer.attempts.front() ? "" : ",", attempt.operator_name.c_str(),
                static_cast<unsigned long long>(attempt.seed));
  std::printf(").\nThe operators are simulated: they test the software and say nothing about validity.\n\n");
  if (answer.passwords.empty())
    std::printf(
        "The accounts were made in an earlier run; `seldinger user passwd NAME --library DIR` sets a new "
        "password.\n");
  std::fflush(stdout);
}

int run_demo(const Arguments& arguments) {
  if (arguments.has(kFace.name) && !arguments.has("--ct")) throw UsageError("--face goes with --ct");
  if (arguments.has(kSeries.name) && (!arguments.has("--ct") || arguments.all("--ct").size() > 1))
    throw UsageError("--series goes with one --ct");
  if (arguments.has("--programme")) {
    if (arguments.has("--json")) throw UsageError("--json does not go with --programme");
    return run_demo_programme(arguments);
  }
  if (arguments.has("--cases") || arguments.has("--drills")) return run_demo_cases(arguments);
  if (arguments.all("--ct").size() > 1) throw UsageError("more than one --ct needs --cases");
  const int port = static_cast<int>(arguments.whole("--port", 8080, 0, 65535));
  const ServeAt at{"127.0.0.1", port, !arguments.has("--port")};
  const bool json = arguments.has("--json"), serving = !arguments.has("--no-serve");
  if (serving)
    if (const auto free = can_serve(at); !free) return refuse(free.error());
  MadeFolder folder(library_folder(arguments));
  std::optional<casedb::Library> library;  // closed before the folder may go
  DemoAnswer answer;
  auto found = demo_case(library, folder, arguments);
  if (!found) return refuse(found.error());
  answer.found = std::move(found->row);
  answer.lesion = std::move(found->lesion);
  answer.lesion_rule = assessment::describe(assessment::lesion_rule(answer.found.modality, answer.found.position));
  if (const auto skin = casedb::load_skin(*library, answer.found))
    answer.lesion_depth_mm = -cases::MeshIndex(*skin).closest_skin(answer.lesion.lesion.center_lps_mm).distance_mm;
  const std::vector<std::pair<const char*, casedb::Role>> accounts = {{"mentor", casedb::Role::mentor},
                                                                      {"novice", casedb::Role::trainee},
                                                                      {"intermediate", casedb::Role::trainee},
                                                                      {"expert", casedb::Role::trainee}};
  auto passwords = add_missing_accounts(*library, accounts);
  if (!passwords) return refuse(passwords.error());
  answer.passwords = std::move(*passwords);
  if (!json) print_accounts(answer.passwords);
  if (const auto made = make_demo_cohort(*library, accounts); !made) return refuse(made.error());
  if (const auto made = demo_attempts(*library, answer); !made) return refuse(made.error());
  folder.keep();
  if (!json) print_answer(answer, folder.path());
  if (!serving) {
    if (json) std::fputs(json_of_demo(answer).c_str(), stdout);
    return kDone;
  }
  const auto ready = [&](const std::string& url) {
    answer.url = url;
    if (json)
      std::fputs(json_of_demo(answer).c_str(), stdout);
    else
      std::printf("\nOpen %s  (Ctrl-C ends)\n", url.c_str());
    std::fflush(stdout);
  };
  const auto served = serve_until_stopped(std::move(*library), at, ready);
  return served ? kDone : refuse(served.error());
}

constexpr Option kDemoOptions[] = {
    kLibrary,
    {"--ct", "SOURCE", "a CT to use in place of the built-in case; with --cases as many as you like", true},
    kSeries,
    kFace,
    {"--drills", nullptr,
     "the first hour: three published drills on gel blocks, each with the replay of a simulated expert to watch, "
     "and the curriculum that leads through them; takes seconds"},
    {"--cases", nullptr,
     "the drills, then the eight graded cases, from a --ct where it fits, else from the built-in patients, and "
     "three "
     "of access to vessels of groin and neck; set up in the same way"},
    {"--programme", nullptr,
     "the drills, and a programme of sixty simulated people in three cohorts who have practised them, to fill the "
     "pages of mentors and directors; takes minutes"},
    {"--calyces", "normal|dilated|opacified", "the built-in case's calyces; default normal"},
    {"--modality", "ultrasound|xray|mpr",
     "ultrasound, fluoroscopy, or CT slices under a probe; default ultrasound"},
    {"--no-serve", nullptr, "print what was made, and end"},
    {"--port", "N", "the page's port; default 8080, or any free one"},
    kJson};

}  // namespace

Command demo_command() {
  return {.name = "demo",
          .options = kDemoOptions,
          .summary = "Shows the program's main job from start to end, on a real or built-in CT.",
          .run = &run_demo};
}

}  // namespace seldinger::app

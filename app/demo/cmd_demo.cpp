// demo: the main job, end to end.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "app/attempts/answers_json.h"
#include "app/attempts/this_program.h"
#include "app/cases/import_case.h"
#include "app/cli/command.h"
#include "app/demo/demo_cases.h"
#include "app/demo/demo_library.h"
#include "app/library/serving.h"
#include "assessment/operators/lesion_site.h"
#include "assessment/registry.h"
#include "casedb/database/credentials.h"
#include "session/attempt/simulation.h"
#include "session/case/case_build.h"
#include "session/guidance/ultrasound_sight.h"
#include "sim/base/failure.h"
#include "sim/base/training_only.h"
#include "sim/volume/volume_bytes.h"

namespace seldinger::app {
namespace {

constexpr const char* kOperators[] = {"novice", "intermediate", "expert"};
constexpr std::uint64_t kSeed = 1;

volume::Calyces calyces_of(const Arguments& arguments) {
  const std::string kind = arguments.text("--calyces", "normal");
  if (kind == "normal") return volume::Calyces::normal;
  if (kind == "dilated") return volume::Calyces::dilated;
  if (kind == "opacified") return volume::Calyces::opacified;
  throw UsageError("--calyces is normal, dilated or opacified");
}

cases::Modality modality_of(const Arguments& arguments) {
  const auto modality = casedb::modality_from(arguments.text("--modality", "ultrasound"));
  if (!modality) throw UsageError("--modality is " + casedb::modality_names());
  return *modality;
}

// The library with the demo's case: one already there is used again, so that a second run is quick and makes
// nothing twice. A CT that is refused makes no library.
base::Result<casedb::CaseRow> demo_case(std::optional<casedb::Library>& opened, const std::filesystem::path& folder,
                                        const Arguments& arguments) {
  const bool own = arguments.has("--ct");
  const volume::Calyces calyces = calyces_of(arguments);
  const cases::Modality modality = modality_of(arguments);
  if (own && arguments.has("--calyces")) throw UsageError("--calyces is of the built-in case, not of a CT");
  std::optional<casedb::NewCase> imported;
  if (own) {
    auto read = import_case(arguments.text("--ct"), series_of(arguments), "Demo CT", "import");
    if (!read) return read.error();
    imported.emplace(std::move(*read));
  }
  auto made = casedb::Library::open_or_create(folder);
  if (!made) return made.error();
  casedb::Library& library = opened.emplace(std::move(*made));
  if (!own)
    for (const casedb::CaseRow& row : casedb::list_cases(library))
      if (row.origin == phantom_origin(calyces) && row.modality == modality) return row;
  if (!own) {
    auto read = import_phantom(calyces);
    if (!read) return read.error();
    imported.emplace(std::move(*read));
  } else {
    const std::string volume_sha256 = casedb::sha256_hex(volume::bytes_from_volume(imported->volume));
    for (const casedb::CaseRow& row : casedb::list_cases(library))
      if (row.volume_sha256 == volume_sha256 && row.modality == modality) return row;
  }
  imported->modality = modality;
  if (modality == cases::Modality::xray) imported->title += ", fluoroscopy";
  if (modality == cases::Modality::mpr) imported->title += ", CT slices";
  return casedb::find_case(library, casedb::add_case(library, *imported));
}

base::Result<casedb::LesionRow> demo_lesion(casedb::Library& library, const casedb::CaseRow& row) {
  auto lesions = casedb::list_lesions(library, row.case_id);
  if (!lesions.empty()) return lesions.front();
  cases::Picture picture;
  picture.modality = row.modality;
  auto scene = session::build_case(library, row, std::nullopt, picture, session::needs_of(row.modality));
  if (!scene) return scene.error();
  assessment::LesionRule rule = assessment::lesion_rule(row.modality, row.position);
  if (row.modality == cases::Modality::ultrasound) {
    rule.looks_from = [&](const assessment::PuncturePlan& plan, const cases::Lesion& target) {
      return session::UltrasoundSight(*scene).looks_from(plan, target);
    };
  }
  const auto site = assessment::find_lesion_site(scene->volume, scene->skin_index, rule);
  if (!site) return site.error();
  const auto lesion_id = casedb::add_lesion(library, row.case_id, site->lesion);
  if (!lesion_id) return lesion_id.error();
  return casedb::list_lesions(library, row.case_id).front();
}

base::Result<void> demo_attempts(casedb::Library& library, DemoAnswer& answer) {
  for (const casedb::AttemptRow& attempt : casedb::list_attempts(library))
    if (attempt.case_id == answer.found.case_id && attempt.lesion_id == answer.lesion.lesion_id &&
        attempt.seed == kSeed)
      answer.attempts.insert(answer.attempts.begin(),
                             {attempt.attempt_id, attempt.operator_name, attempt.seed, attempt.metrics});
  std::optional<session::Simulation> simulation;
  for (const char* name : kOperators) {
    bool there = false;
    for (const session::SimulatedAttempt& attempt : answer.attempts) there = there || attempt.operator_name == name;
    if (there) continue;
    if (!simulation) {
      auto prepared =
          session::Simulation::prepare(library, this_program(), answer.found.case_id, answer.lesion.lesion_id);
      if (!prepared) return prepared.error();
      simulation.emplace(std::move(*prepared));
    }
    std::optional<std::string> person_id;
    for (const casedb::Account& account : casedb::list_users(library))
      if (account.login_name == name) person_id = account.person_id;
    auto attempt = simulation->attempt(*assessment::named_profile(name), kSeed, person_id);
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
  std::printf("\nThe operators are simulated: they test the software and say nothing about validity.\n\n");
  if (answer.passwords.empty())
    std::printf(
        "The accounts were made in an earlier run; `seldinger user passwd NAME --library DIR` sets a new "
        "password.\n");
  else
    std::printf("Accounts, with passwords that are shown only now:\n");
  for (const auto& [name, password] : answer.passwords) std::printf("  %-14s %s\n", name.c_str(), password.c_str());
  std::fflush(stdout);
}

int run_demo(const Arguments& arguments) {
  if (arguments.has(kSeries.name) && (!arguments.has("--ct") || arguments.all("--ct").size() > 1))
    throw UsageError("--series goes with one --ct");
  if (arguments.has("--cases") || arguments.has("--drills")) return run_demo_cases(arguments);
  const std::filesystem::path folder =
      arguments.has("--library") ? std::filesystem::path(arguments.text("--library")) : demo_library();
  const int port = static_cast<int>(arguments.whole("--port", 8080, 0, 65535));
  std::optional<casedb::Library> library;
  DemoAnswer answer;
  auto found = demo_case(library, folder, arguments);
  if (!found) return refuse(found.error());
  answer.found = std::move(*found);
  auto lesion = demo_lesion(*library, answer.found);
  if (!lesion) return refuse(lesion.error());
  answer.lesion = std::move(*lesion);
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
  if (const auto made = make_demo_cohort(*library, accounts); !made) return refuse(made.error());
  if (const auto made = demo_attempts(*library, answer); !made) return refuse(made.error());
  const bool json = arguments.has("--json"), serving = !arguments.has("--no-serve");
  if (!json) print_answer(answer, folder);
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
  const auto served =
      serve_until_stopped(std::move(*library), {"127.0.0.1", port, !arguments.has("--port")}, ready);
  return served ? kDone : refuse(served.error());
}

constexpr Option kDemoOptions[] = {
    {"--library", "DIR", "default seldinger/demo under the user's data folder; reused"},
    {"--ct", "SOURCE", "a CT to use in place of the built-in case; with --cases any number of them", true},
    kSeries,
    {"--drills", nullptr,
     "the first hour: three drills on blocks of gel, published, each passed once by a simulated expert whose "
     "replay is to be watched, and the curriculum that leads through them; takes seconds"},
    {"--cases", nullptr,
     "the drills, then the graded cases: 1, 5 and 6 from the built-in torso, those of a --ct that fits; likewise"},
    {"--calyces", "normal|dilated|opacified", "of the built-in case; default normal"},
    {"--modality", "ultrasound|xray|mpr",
     "ultrasound, fluoroscopy, or CT slices under a probe; default ultrasound"},
    {"--no-serve", nullptr, "end by printing what was made"},
    {"--port", "N", "the page's port; default 8080, or any free one"},
    kJson};

}  // namespace

Command demo_command() {
  return {.name = "demo",
          .options = kDemoOptions,
          .summary = "The main job, end to end, on real or built-in CT.",
          .run = &run_demo};
}

}  // namespace seldinger::app

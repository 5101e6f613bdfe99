// demo --cases: the graded cases from what is at hand, published, each hit once by a simulated expert.
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <map>

#include "app/case_check.h"
#include "app/command.h"
#include "app/demo_cases.h"
#include "app/demo_library.h"
#include "app/import_case.h"
#include "app/simulation.h"
#include "assessment/metrics/registry.h"
#include "casedb/versions.h"

namespace seldinger::app {
namespace {

constexpr std::uint64_t kMostSeeds = 8;  // an expert of these profiles hits in half of his attempts or more
constexpr const char* kAuthor = "mentor";
constexpr const char* kReviewer = "reviewer";

void progress(const char* what, const char* title) {
  if (::isatty(STDERR_FILENO) != 0) std::fprintf(stderr, "%s: %s …\n", title, what);
}

std::optional<volume::Calyces> calyces_of(DemoSource source) {
  switch (source) {
    case DemoSource::torso:
      return volume::Calyces::normal;
    case DemoSource::torso_dilated:
      return volume::Calyces::dilated;
    case DemoSource::torso_opacified:
      return volume::Calyces::opacified;
    default:
      return std::nullopt;
  }
}

// Criteria are of the newest version of their metric.
assessment::PassRule with_versions(assessment::PassRule rule) {
  for (assessment::Criterion& one : rule.criteria)
    if (const assessment::MetricInfo* info = assessment::find_metric(one.metric)) one.version = info->version;
  return rule;
}

base::Result<void> add_parts(casedb::Library& library, const DemoCase& wanted, const std::string& case_id) {
  const auto row = casedb::find_case(library, case_id);
  if (!row) return row.error();
  const auto maps = casedb::load_label_maps(library, *row);
  if (!maps) return maps.error();
  for (DemoStructure structure : wanted.structures) {
    structure.row.case_id = case_id;
    for (const casedb::StoredLabels& map : *maps)
      for (std::size_t label = 1; label < map.labels.names.size(); ++label)
        if (!structure.label.empty() && map.labels.names[label] == structure.label) {
          structure.row.labels_sha256 = map.sha256;
          structure.row.label = static_cast<int>(label);
        }
    if (const auto added = casedb::add_structure(library, structure.row); !added) return added.error();
  }
  for (const cases::LesionForm& lesion : wanted.lesions)
    if (const auto added = casedb::add_lesion(library, case_id, lesion); !added) return added.error();
  return {};
}

base::Result<void> check(casedb::Library& library, const std::string& case_id) {
  const auto row = casedb::find_case(library, case_id);
  if (!row) return row.error();
  const auto checks = check_case(library, *row);
  if (!checks) return checks.error();
  if (checks->holds()) return {};
  base::Error error{"checks_failed", "a graded case does not hold its check on this volume"};
  for (const Check& one : checks->checks)
    if (!one.holds) error.findings.push_back({one.name, row->title + ": " + one.text});
  return error;
}

// An attempt of a simulated expert that hits; those there are count.
base::Result<void> hit(casedb::Library& library, DemoCaseAnswer& answer) {
  const auto is_hit = [](const std::vector<assessment::MetricValue>& metrics) {
    return std::any_of(metrics.begin(), metrics.end(), [](const assessment::MetricValue& one) {
      return one.id == "hit" && one.value && *one.value == 1.0;
    });
  };
  for (const casedb::AttemptRow& attempt : casedb::list_attempts(library))
    if (attempt.case_id == answer.case_id && attempt.operator_name == "expert" && is_hit(attempt.metrics)) {
      answer.attempt_id = attempt.attempt_id;
      answer.seed = attempt.seed;
      return {};
    }
  auto simulation = Simulation::prepare(library, answer.case_id, {});
  if (!simulation) {
    base::Error error = simulation.error();
    error.findings.push_back({error.code, answer.title});
    return error;
  }
  for (std::uint64_t seed = 1; seed <= kMostSeeds; ++seed) {
    const auto attempt = simulation->attempt(*assessment::named_profile("expert"), seed, std::nullopt);
    if (!attempt) return attempt.error();
    if (!is_hit(attempt->metrics)) continue;
    answer.attempt_id = attempt->attempt_id;
    answer.seed = seed;
    return {};
  }
  return base::Error{"never_hit", "a simulated expert does not hit: " + answer.title};
}

base::Result<void> publish(casedb::Library& library, const std::string& case_id) {
  if (const auto done = casedb::submit_case(library, case_id, kAuthor); !done) return done.error();
  if (const auto done = casedb::judge_case(library, case_id, kReviewer, true); !done) return done.error();
  return casedb::publish_case(library, case_id, kAuthor, false);
}

base::Result<DemoCaseAnswer> make(casedb::Library& library, const DemoCase& wanted, const casedb::NewCase& source) {
  DemoCaseAnswer answer{wanted.number, wanted.title, {}, {}, wanted.setting.clinic.defer, {}, 0};
  for (const casedb::CaseRow& row : casedb::list_cases(library))
    if (row.title == wanted.title && row.origin == source.origin) answer.case_id = row.case_id;
  if (answer.case_id.empty()) {
    progress("stored", wanted.title.c_str());
    casedb::NewCase made = source;
    static_cast<casedb::CaseSetting&>(made) = wanted.setting;
    made.rule = with_versions(wanted.setting.rule);
    made.title = wanted.title;
    made.no_burned_in_text = true;  // its CTs are known ones (source_of), looked through when the table was made
    answer.case_id = casedb::add_case(library, made);
    if (const auto added = add_parts(library, wanted, answer.case_id); !added) return added.error();
  }
  const auto row = casedb::find_case(library, answer.case_id);
  if (!row) return row.error();
  if (row->state == "draft")
    if (const auto fit = check(library, answer.case_id); !fit) return fit.error();
  progress("attempted", wanted.title.c_str());
  if (!answer.defer)
    if (const auto done = hit(library, answer); !done) return done.error();
  if (row->state == "draft")
    if (const auto done = publish(library, answer.case_id); !done) return done.error();
  const auto now = casedb::find_case(library, answer.case_id);
  if (!now) return now.error();
  answer.state = now->state;
  return answer;
}

void print(const std::vector<DemoCaseAnswer>& made, const std::vector<int>& not_made, const Passwords& passwords) {
  std::printf("Training only, not for planning a patient's procedure.\n\n");
  for (const DemoCaseAnswer& one : made) {
    std::printf("%s  %-10s %s\n", one.case_id.c_str(), one.state.c_str(), one.title.c_str());
    if (one.defer)
      std::puts("    the right decision is to defer");
    else
      std::printf("    hit by attempt %s of a simulated expert, seed %llu\n", one.attempt_id.c_str(),
                  static_cast<unsigned long long>(one.seed));
  }
  if (!not_made.empty()) {
    std::printf("\nThese need a CT (--ct):");
    for (const int number : not_made) std::printf(" %d", number);
    std::puts("");
  }
  std::printf("\nThe operators are simulated: they test the software and say nothing about validity.\n");
  if (!passwords.empty()) std::printf("\nAccounts, shown once:\n");
  for (const auto& [name, password] : passwords) std::printf("  %-14s %s\n", name.c_str(), password.c_str());
}

}  // namespace

int run_demo_cases(const Arguments& arguments) {
  if (arguments.has("--calyces") || arguments.has("--modality"))
    throw UsageError("--calyces and --modality are not of the graded cases");
  std::map<DemoSource, casedb::NewCase> sources;
  for (const std::string& path : arguments.all("--ct")) {
    auto read = import_case(path, {}, {}, "import");
    if (!read) return refuse(read.error());
    const auto source = source_of(read->volume);
    if (!source) return refuse({"no_case_fits", "no graded case is made of this CT"});
    sources.insert_or_assign(*source, std::move(*read));
  }
  auto library = casedb::Library::open_or_create(
      arguments.has("--library") ? std::filesystem::path(arguments.text("--library")) : demo_library());
  if (!library) return refuse(library.error());
  const auto passwords =
      add_missing_accounts(*library, {{kAuthor, casedb::Role::mentor}, {kReviewer, casedb::Role::mentor}});
  if (!passwords) return refuse(passwords.error());
  std::vector<DemoCaseAnswer> made;
  std::vector<int> not_made;
  for (const DemoCase& wanted : demo_cases()) {
    const auto calyces = calyces_of(wanted.source);
    if (calyces && !sources.contains(wanted.source)) {
      auto read = import_phantom(*calyces);
      if (!read) return refuse(read.error());
      sources.emplace(wanted.source, std::move(*read));
    }
    const auto source = sources.find(wanted.source);
    if (source == sources.end()) {
      not_made.push_back(wanted.number);
      continue;
    }
    auto answer = make(*library, wanted, source->second);
    if (!answer) return refuse(answer.error());
    made.push_back(std::move(*answer));
  }
  if (arguments.has("--json"))
    std::fputs(json_of_demo_cases(made, not_made, *passwords).c_str(), stdout);
  else
    print(made, not_made, *passwords);
  return kDone;
}

}  // namespace seldinger::app

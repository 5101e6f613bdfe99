// demo --cases and --drills: drills and graded cases from what is at hand, published, each passed once by a
// simulated expert, and the curricula that lead through them.
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <map>

#include "app/attempts/this_program.h"
#include "app/cases/import_case.h"
#include "app/cli/command.h"
#include "app/cli/library_place.h"
#include "app/cli/words.h"
#include "app/demo/demo_case_parts.h"
#include "app/demo/demo_cases.h"
#include "app/demo/demo_library.h"
#include "assessment/grading/rule_json.h"
#include "assessment/registry.h"
#include "casedb/cases/versions.h"
#include "casedb/grading/curriculum.h"
#include "casedb/grading/grading.h"
#include "session/attempt/simulation.h"
#include "session/case/case_check.h"
#include "sim/base/training_only.h"

namespace seldinger::app {
namespace {

constexpr std::uint64_t kMostSeeds = 8;  // an expert of these profiles hits in half of his attempts or more
constexpr const char* kAuthor = "mentor";
constexpr const char* kReviewer = "reviewer";
constexpr const char* kDirector = "director";
constexpr const char* kTrainee = "trainee";

void progress(const char* what, const char* title) {
  if (::isatty(STDERR_FILENO) != 0) std::fprintf(stderr, "%s: %s …\n", title, what);
}

// Criteria are of the newest version of their metric.
assessment::PassRule with_versions(assessment::PassRule rule) {
  for (assessment::Criterion& one : rule.criteria)
    if (const assessment::MetricInfo* info = assessment::find_metric(one.metric)) one.version = info->version;
  return rule;
}

// With the title: it is one case of many.
base::Error titled(base::Error error, const std::string& title) {
  error.findings.push_back({error.code, title});
  return error;
}

// An attempt of a simulated expert that passes and hits, the replay to watch; one that is there counts. `hits`: the
// metric that says so.
base::Result<void> pass(casedb::Library& library, const casedb::CaseRow& row, const char* hits,
                        DemoCaseAnswer& answer) {
  const auto is_pass = [&](const std::string& attempt_id) {
    const auto attempt = casedb::find_attempt(library, attempt_id);
    return attempt && casedb::grade_of(*attempt, row).verdict == assessment::Verdict::passed &&
           std::any_of(attempt->metrics.begin(), attempt->metrics.end(), [&](const assessment::MetricValue& one) {
             return one.id == hits && one.value && *one.value == 1.0;
           });
  };
  for (const casedb::AttemptRow& attempt : casedb::list_attempts_on(library, answer.case_id))
    if (attempt.operator_name == "expert" && is_pass(attempt.attempt_id)) {
      answer.attempt_id = attempt.attempt_id;
      answer.seed = attempt.seed;
      return {};
    }
  auto simulation = session::Simulation::prepare(library, this_program(), answer.case_id, {});
  if (!simulation) return titled(simulation.error(), answer.title);
  for (std::uint64_t seed = 1; seed <= kMostSeeds; ++seed) {
    const auto attempt = simulation->attempt(*assessment::named_profile("expert"), seed, std::nullopt);
    if (!attempt) return attempt.error();
    if (!is_pass(attempt->attempt_id)) continue;
    answer.attempt_id = attempt->attempt_id;
    answer.seed = seed;
    return {};
  }
  return base::Error{"never_passed", "a simulated expert does not pass: " + answer.title};
}

base::Result<void> publish(casedb::Library& library, const std::string& case_id, const casedb::CaseCheck& check) {
  if (const auto done = casedb::submit_case(library, case_id, kAuthor); !done) return done.error();
  if (const auto done = casedb::judge_case(library, case_id, kReviewer, true); !done) return done.error();
  return casedb::publish_case(library, case_id, check, kReviewer, false);
}

// The newest version of the case that is in the library; empty: it is not there.
std::string newest_of(casedb::Library& library, const std::string& title, const std::string& origin) {
  std::string case_id;
  int version = 0;
  for (const casedb::CaseRow& row : casedb::list_cases(library))
    if (row.title == title && row.origin == origin && row.version > version) {
      case_id = row.case_id;
      version = row.version;
    }
  return case_id;
}

// A published case keeps its rule. Where this program's is another one, or names newer versions of metrics, it
// becomes that of the next version, in which what was passed before counts (docs/decisions/0022).
base::Result<std::string> with_rule(casedb::Library& library, const std::string& case_id,
                                    const assessment::PassRule& rule) {
  auto row = casedb::find_case(library, case_id);
  if (!row) return row.error();
  if (assessment::json_of_rule(row->rule) == assessment::json_of_rule(rule)) return case_id;
  auto next = casedb::new_version(library, case_id, kAuthor);
  if (!next) return next.error();
  casedb::CaseSetting setting = *row;
  setting.rule = rule;
  if (const auto set = casedb::set_setting(library, *next, setting); !set) return set.error();
  return next;
}

// What has a newer version is no longer practised: its rule may be one that waiting in view passes.
base::Result<void> retire_older(casedb::Library& library, const casedb::CaseRow& newest) {
  for (const casedb::CaseRow& row : casedb::list_cases(library))
    if (row.family_id == newest.family_id && row.version < newest.version &&
        row.state == casedb::CaseState::published) {
      // By who published it: the reviewer, or the author where an older program did.
      auto done = casedb::retire_case(library, row.case_id, kReviewer);
      if (!done) done = casedb::retire_case(library, row.case_id, kAuthor);
      if (!done) return done.error();
    }
  return {};
}

base::Result<DemoCaseAnswer> make(casedb::Library& library, const DemoCase& wanted, const casedb::NewCase& source,
                                  const char* hits) {
  DemoCaseAnswer answer{wanted.number, wanted.title, {}, {}, wanted.setting.clinic.defer, {}, 0, {}};
  const assessment::PassRule rule = with_versions(wanted.setting.rule);
  answer.case_id = newest_of(library, wanted.title, source.origin);
  if (!answer.case_id.empty()) {
    auto versioned = with_rule(library, answer.case_id, rule);
    if (!versioned) return titled(versioned.error(), answer.title);
    answer.case_id = std::move(*versioned);
  } else {
    progress("stored", wanted.title.c_str());
    casedb::NewCase made = source;
    static_cast<casedb::CaseSetting&>(made) = wanted.setting;
    made.rule = rule;
    made.title = wanted.title;
    made.no_burned_in_text = true;  // its CTs are known ones (source_of), looked through when the table was made
    answer.case_id = casedb::add_case(library, made);
    if (const auto added = add_parts(library, wanted, answer.case_id); !added) return added.error();
  }
  const auto row = casedb::find_case(library, answer.case_id);
  if (!row) return row.error();
  std::optional<casedb::CaseCheck> check;  // of a draft, which is published below
  if (row->state == casedb::CaseState::draft) {
    auto checked = session::check_case(library, answer.case_id);
    if (!checked) return titled(checked.error(), answer.title);
    // Before it is attempted: that would freeze what must be mended.
    if (const auto ready = casedb::ready_to_publish(*checked); !ready) return titled(ready.error(), answer.title);
    check = std::move(*checked);
  }
  progress("attempted", wanted.title.c_str());
  if (!answer.defer)
    if (const auto done = pass(library, *row, hits, answer); !done) return done.error();
  if (check)
    if (const auto done = publish(library, answer.case_id, *check); !done)
      return titled(done.error(), answer.title);
  if (const auto done = retire_older(library, *row); !done) return titled(done.error(), answer.title);
  const auto now = casedb::find_case(library, answer.case_id);
  if (!now) return now.error();
  answer.state = now->state;
  answer.warnings = now->warnings;
  return answer;
}

// The published one of that title that leads through these cases, each open when the one before it is passed; one
// of other cases (a CT has come) makes room for it. Attempts belong to cases and count in either.
base::Result<DemoCurriculum> lead_through(casedb::Library& library, const char* title,
                                          const std::vector<DemoCaseAnswer>& made) {
  std::vector<std::string> families;
  for (const DemoCaseAnswer& one : made) {
    const auto row = casedb::find_case(library, one.case_id);
    if (!row) return row.error();
    families.push_back(row->family_id);
  }
  for (const casedb::Curriculum& known : casedb::list_curricula(library)) {
    if (known.title != title || known.state != casedb::CurriculumState::published) continue;
    std::vector<std::string> its;
    for (const casedb::CurriculumItem& item : known.items) its.push_back(item.family_id);
    if (its == families) return DemoCurriculum{title, known.curriculum_id, its.size()};
    if (const auto done = casedb::remove_curriculum(library, known.curriculum_id, kDirector); !done)
      return done.error();
  }
  const auto curriculum_id = casedb::add_curriculum(library, title, kAuthor);
  if (!curriculum_id) return curriculum_id.error();
  for (std::size_t i = 0; i < made.size(); ++i) {
    std::vector<assessment::Gate> gates;
    if (i > 0) gates.push_back({i - 1, assessment::Proficiency::passed});
    const auto added = casedb::add_curriculum_item(library, *curriculum_id, made[i].case_id, {}, gates, kAuthor);
    if (!added) return added.error();
  }
  if (const auto done = casedb::publish_curriculum(library, *curriculum_id, kDirector); !done) return done.error();
  return DemoCurriculum{title, *curriculum_id, made.size()};
}

using Sources = std::map<DemoSource, casedb::NewCase>;

// The graded cases: those of a CT that is at hand in the place of the built-in ones.
std::vector<DemoCase> graded_cases(const Sources& given) {
  std::vector<DemoCase> all = demo_cases();
  for (const DemoCase& one : demo_cases_of_ct())
    if (given.contains(one.source)) all.at(static_cast<std::size_t>(one.number - 1)) = one;
  return all;
}

base::Result<std::vector<DemoCaseAnswer>> make_all(casedb::Library& library, const std::vector<DemoCase>& wanted,
                                                   Sources& sources, const char* hits) {
  std::vector<DemoCaseAnswer> made;
  for (const DemoCase& one : wanted) {
    if (!sources.contains(one.source))
      if (auto read = built_in(one.source)) {
        if (!*read) return read->error();
        sources.emplace(one.source, std::move(**read));
      }
    auto answer = make(library, one, sources.at(one.source), hits);
    if (!answer) return answer.error();
    made.push_back(std::move(*answer));
  }
  return made;
}

void print(const std::vector<DemoCaseAnswer>& made) {
  for (const DemoCaseAnswer& one : made) {
    std::printf("%s  %-10s %s\n", one.case_id.c_str(), casedb::name_of(one.state).c_str(), one.title.c_str());
    if (one.defer)
      std::puts("    the right decision is to defer");
    else
      std::printf("    passed in attempt %s of a simulated expert, seed %llu\n", one.attempt_id.c_str(),
                  static_cast<unsigned long long>(one.seed));
    for (const base::Problem& warning : one.warnings)
      std::printf("    warning: %s: %s\n", warning.code.c_str(), warning.text.c_str());
  }
}

void print(const DemoCasesAnswer& answer) {
  std::printf("%s\n\n", base::kTrainingOnly);
  print(answer.drills);
  print(answer.cases);
  print(answer.access);
  std::puts("");
  for (const DemoCurriculum& one : answer.curricula)
    std::printf("%s  curriculum of %zu: %s\n", one.curriculum_id.c_str(), one.items, one.title.c_str());
  std::printf("\nThe operators are simulated: they test the software and say nothing about validity.\n");
}

// What graded cases are made of, when they are made of this CT.
base::Result<void> take(const std::string& path, const Arguments& arguments, Sources& sources) {
  auto read = import_case(path, series_of(arguments), {}, "import", face_of(arguments));
  if (!read) return read.error();
  const auto source = source_of(read->volume);
  if (!source) return base::Error{"no_case_fits", "no graded case can be made from this CT", read->warnings};
  sources.insert_or_assign(*source, std::move(*read));
  return {};
}

}  // namespace

int run_demo_cases(const Arguments& arguments) {
  const bool graded = arguments.has("--cases");
  if (arguments.has("--calyces") || arguments.has("--modality"))
    throw UsageError("--calyces and --modality do not go with drills or graded cases");
  if (!graded && arguments.has("--ct")) throw UsageError("--ct does not go with the drills: they are built in");
  Sources sources;
  DemoCasesAnswer answer;
  for (const std::string& path : arguments.all("--ct"))
    if (const auto taken = take(path, arguments, sources); !taken)
      answer.left_out.push_back(error_of("--ct", path, taken.error()));
  // One that does not fit stops no other; where none does, nothing is made.
  if (sources.empty() && !answer.left_out.empty()) return refuse(answer.left_out.front());
  for (const base::Error& one : answer.left_out)
    std::fprintf(stderr, "left out: %s: %s\n", one.code.c_str(), one.text.c_str());
  MadeFolder folder(library_folder(arguments));
  auto library = casedb::Library::open_or_create(folder.path());
  if (!library) return refuse(error_of_library(arguments, library.error()));
  const std::vector<std::pair<const char*, casedb::Role>> accounts = {{kAuthor, casedb::Role::mentor},
                                                                      {kReviewer, casedb::Role::mentor},
                                                                      {kDirector, casedb::Role::director},
                                                                      {kTrainee, casedb::Role::trainee}};
  auto passwords = add_missing_accounts(*library, accounts);
  if (!passwords) return refuse(passwords.error());
  answer.passwords = std::move(*passwords);
  if (!arguments.has("--json")) print_accounts(answer.passwords);
  if (const auto made = make_demo_cohort(*library, accounts); !made) return refuse(made.error());
  const auto add = [&](const std::vector<DemoCase>& wanted, const char* title, const char* hits,
                       std::vector<DemoCaseAnswer>& made) -> base::Result<void> {
    auto all = make_all(*library, wanted, sources, hits);
    if (!all) return all.error();
    made = std::move(*all);
    auto curriculum = lead_through(*library, title, made);
    if (!curriculum) return curriculum.error();
    answer.curricula.push_back(std::move(*curriculum));
    return {};
  };
  // What a beginner watches first shows no second try.
  if (const auto done = add(drills(), "First hour", "first_pass_success", answer.drills); !done)
    return refuse(done.error());
  if (graded) {
    if (const auto done = add(graded_cases(sources), "Graded cases", "hit", answer.cases); !done)
      return refuse(done.error());
    if (const auto done = add(access_cases(), "Access to vessels", "hit", answer.access); !done)
      return refuse(done.error());
  }
  folder.keep();
  if (arguments.has("--json"))
    std::fputs(json_of_demo_cases(answer).c_str(), stdout);
  else
    print(answer);
  return kDone;
}

}  // namespace seldinger::app

// simulate.
#include <algorithm>
#include <cstdio>
#include <thread>

#include "app/acting/acting.h"
#include "app/attempts/answers_json.h"
#include "app/attempts/attempt_line.h"
#include "app/attempts/grade_text.h"
#include "app/attempts/metrics_text.h"
#include "app/attempts/people_options.h"
#include "app/attempts/this_program.h"
#include "app/cli/command.h"
#include "app/cli/file.h"
#include "app/cli/progress.h"
#include "app/cli/words.h"
#include "session/attempt/simulation.h"

namespace seldinger::app {
namespace {

base::Result<assessment::OperatorProfile> profile_of(const std::string& name) {
  if (const auto profile = assessment::named_profile(name)) return *profile;
  if (!name.ends_with(".json"))
    throw UsageError("--operator is novice, intermediate, expert, learner or a .json file");
  const auto text = read_text(name, 1U << 20U);
  if (!text) return error_of("--operator", name, text.error());
  auto profile = assessment::profile_from_json(*text);
  return profile ? std::move(profile) : error_of("--operator", name, profile.error());
}

// What can be put into an attempt: a mentor's events, and what is done at the needle's hub, which no operator does.
bool may_be_put_in(cases::EventKind kind) {
  using enum cases::EventKind;
  return cases::find_event(kind)->source == cases::EventSource::mentor || kind == stylet_out || kind == stylet_in ||
         kind == inject;
}

// "cough@12.5"
cases::Event put_in_event(const std::string& text) {
  const std::size_t at = text.find('@');
  const auto kind = cases::event_from(text.substr(0, at));
  const double t_s = at == text.npos ? -1.0 : parse_number(text.substr(at + 1)).value_or(-1.0);
  if (!kind || !may_be_put_in(*kind) || !(t_s >= 0.0))
    throw UsageError(
        "--event is cough, bleeding, pressure_drop, stylet_out, stylet_in or inject, @ and a time in seconds: "
        "cough@12.5");
  return {t_s, *kind};
}

std::vector<cases::Event> scenario_of(const Arguments& arguments) {
  std::vector<cases::Event> scenario;
  if (arguments.has("--event"))
    for (const std::string& text : arguments.all("--event")) scenario.push_back(put_in_event(text));
  std::stable_sort(scenario.begin(), scenario.end(),
                   [](const cases::Event& a, const cases::Event& b) { return a.t_s < b.t_s; });
  return scenario;
}

session::SimulatedAttempt graded(casedb::Library& library, casedb::Grader& grader,
                                 session::SimulatedAttempt attempt) {
  if (const auto row = casedb::find_attempt(library, attempt.attempt_id)) attempt.grade = grader.look_at(*row);
  return attempt;
}

// A line; with --details grade and metrics below it.
void print(const Arguments& arguments, const session::SimulatedAttempt& attempt) {
  const auto verdict = attempt.grade ? attempt.grade->grade.verdict : assessment::Verdict::no_rule;
  std::printf("attempt %s  simulated %s  seed %-4llu %s\n", attempt.attempt_id.c_str(),
              attempt.operator_name.c_str(), static_cast<unsigned long long>(attempt.seed),
              outcome_text(verdict, attempt.metrics).c_str());
  if (arguments.has("--details")) {
    if (attempt.grade) std::fputs(text_of_grade(*attempt.grade).c_str(), stdout);
    print_metrics(attempt.metrics);
  }
  std::fflush(stdout);  // it is stored: whoever reads along may know
}

void print_sum(const std::vector<session::SimulatedAttempt>& attempts) {
  std::size_t passed = 0, graded = 0;
  for (const session::SimulatedAttempt& one : attempts) {
    if (!one.grade || one.grade->grade.verdict == assessment::Verdict::no_rule) continue;
    ++graded;
    passed += one.grade->grade.verdict == assessment::Verdict::passed ? 1 : 0;
  }
  if (attempts.size() > 1 && graded > 0) std::printf("%zu of %zu passed\n", passed, graded);
}

// All that was asked for, what was made before among it, in the order of people and their attempts.
std::vector<session::SimulatedAttempt> with_those(std::vector<session::SimulatedAttempt> there,
                                                  std::vector<session::SimulatedAttempt> made,
                                                  casedb::Library& library, casedb::Grader& grader) {
  if (there.empty()) return made;
  for (session::SimulatedAttempt& one : there) made.push_back(graded(library, grader, std::move(one)));
  std::stable_sort(made.begin(), made.end(), [](const auto& a, const auto& b) {
    return std::pair(a.person, a.number) < std::pair(b.person, b.number);
  });
  return made;
}

int resume(const Arguments& arguments) {
  for (const char* option : {"--case", "--lesion", "--seed", "--count", "--people", "--days", "--cohort", "--shard",
                             "--jobs", "--instrument", "--modality", "--no-pictures"})
    if (arguments.has(option)) throw UsageError(std::string(option) + " does not go with --resume");
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  if (const auto by = acting(*library, arguments, casedb::Action::simulate_attempts); !by)
    return refuse(by.error());
  auto interrupted = session::InterruptedAttempt::take(*library, arguments.text("--resume"));
  if (!interrupted) return refuse(interrupted.error());
  const casedb::OpenAttempt& attempt = interrupted->attempt();
  if (!attempt.synthetic())
    return refuse({"not_simulated", "a person made this attempt: they can continue it in `seldinger train`"});
  auto profile = assessment::named_profile(attempt.operator_name);
  if (arguments.has("--operator")) {
    const auto given = profile_of(arguments.text("--operator"));
    if (!given) return refuse(given.error());
    profile = *given;
  }
  if (!profile) throw UsageError("the attempt's operator is unknown: --operator names the profile's file");
  auto simulation = session::Simulation::prepare(*library, this_program(), attempt.case_id, attempt.lesion_id,
                                                 attempt.instrument.kind, attempt.picture.modality);
  if (!simulation) return refuse(simulation.error());
  if (const auto set = simulation->set_scenario(scenario_of(arguments)); !set) return refuse(set.error());
  casedb::Grader grader(*library);
  auto made = simulation->resume(std::move(*interrupted), *profile);
  if (!made) return refuse(made.error());
  const session::SimulatedAttempt stored = graded(*library, grader, std::move(*made));
  if (arguments.has("--json"))
    std::fputs(json_of_simulation({stored}).c_str(), stdout);
  else
    print(arguments, stored);
  return kDone;
}

int run_simulate(const Arguments& arguments) {
  if (arguments.has("--resume")) return resume(arguments);
  arguments.required("--case");
  const auto seed = static_cast<std::uint64_t>(arguments.whole("--seed", 1, 0, 9'007'199'254'740'992));
  const auto count = arguments.whole("--count", 1, 1, 100'000);
  std::optional<std::size_t> people;
  if (arguments.has("--people")) people = static_cast<std::size_t>(arguments.whole("--people", 1, 1, 1'000'000));
  const auto jobs = arguments.whole("--jobs", std::clamp(std::thread::hardware_concurrency(), 1U, 16U), 1, 256);
  std::optional<cases::InstrumentKind> kind;
  if (arguments.has("--instrument")) {
    const std::string name = arguments.text("--instrument");
    if (name != "access" && name != "core") throw UsageError("--instrument is access or core");
    kind = name == "core" ? cases::InstrumentKind::core : cases::InstrumentKind::access;
  }
  std::optional<cases::Modality> modality;
  if (arguments.has("--modality")) {
    modality = casedb::modality_from(arguments.text("--modality"));
    if (!modality) throw UsageError("--modality is " + casedb::modality_names());
  }
  std::vector<cases::Event> scenario = scenario_of(arguments);
  auto wished = people_wish(arguments, people, seed, static_cast<std::size_t>(count));
  if (!wished) return refuse(wished.error());
  const std::optional<session::PeopleWish>& wish = *wished;
  const base::Result<assessment::OperatorProfile> profile =
      wish ? base::Result<assessment::OperatorProfile>(*assessment::named_profile("intermediate"))
           : profile_of(arguments.required("--operator"));
  if (!profile) return refuse(profile.error());
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  if (const auto by = acting(*library, arguments, casedb::Action::simulate_attempts); !by)
    return refuse(by.error());
  auto simulation = session::Simulation::prepare(*library, this_program(), arguments.text("--case"),
                                                 arguments.text("--lesion"), kind, modality);
  if (!simulation) return refuse(simulation.error());
  if (const auto set = simulation->set_scenario(std::move(scenario)); !set) return refuse(set.error());
  std::vector<session::SimulatedAttempt> attempts;
  casedb::Grader grader(*library);  // against the experts as they were before this run
  auto people_there = people_in_library(*library, arguments, wish, *simulation);
  if (!people_there) return refuse(people_there.error());
  const auto trials = wish ? std::move(people_there->trials)
                           : session::simulated_trials(*profile, seed, static_cast<std::size_t>(count), people);
  Progress progress(trials.size());
  const auto stored = [&](session::SimulatedAttempt attempt) {
    attempts.push_back(graded(*library, grader, std::move(attempt)));
    progress.clear();
    if (!arguments.has("--json")) print(arguments, attempts.back());
    progress.one_done();
  };
  if (!arguments.has("--real-time")) {
    const auto done =
        simulation->attempts(trials, static_cast<std::size_t>(jobs), !arguments.has("--no-pictures"), stored);
    if (!done) return refuse(done.error());
  } else {
    for (const session::SimulatedTrial& trial : trials) {
      auto attempt = simulation->live_attempt(trial.profile, trial.seed, [](const std::string& id) {
        std::fprintf(stderr, "attempt %s is being recorded; if this program dies, simulate --resume continues it\n",
                     id.c_str());
      });
      if (!attempt) return refuse(attempt.error());
      attempt->person = trial.person;
      attempt->number = trial.number;
      stored(std::move(*attempt));
    }
  }
  progress.clear();
  if (arguments.has("--json")) {
    std::fputs(json_of_simulation(with_those(std::move(people_there->there), std::move(attempts), *library, grader))
                   .c_str(),
               stdout);
  } else {
    print_sum(attempts);
    if (!people_there->there.empty())
      std::printf("%zu attempts of these people already existed\n", people_there->there.size());
  }
  return kDone;
}

constexpr Option kSimulateOptions[] = {
    kLibrary,
    {"--case", "CASE", "the case"},
    {"--lesion", "LESION", "the target; default the case's first lesion"},
    {"--operator", "novice|intermediate|expert|learner|FILE.json",
     "who (docs/operators.md); a learner improves with each attempt"},
    {"--seed", "N", "attempt i uses seed N + i"},
    {"--count", "K", "attempts per person; default 1"},
    {"--people", "P",
     "by P different people, the same for the same seed: for novice, intermediate, expert and a group's file they "
     "are people of the library, and only attempts not stored yet are made; default the profile itself"},
    {"--days", "D,D,…",
     "when these people have their sessions, in days from now; each makes --count attempts in each; default 0"},
    {"--cohort", "COHORT", "enrol these people as its learners"},
    {"--shard", "I/N", "only every N-th of these people, from the I-th: N calls make them all, each once"},
    {"--jobs", "N", "threads; default one for each core. The results are the same"},
    {"--details", nullptr, "grade, sentences and every metric of each, not just one line"},
    {"--no-pictures", nullptr, "do not store a picture of the moment of firing"},
    {"--instrument", "access|core", "default the case's. access: the tip decides; core: the fired notch"},
    {"--modality", "mpr|xray|ultrasound", "default the case's; or another that it allows"},
    {"--event", "KIND@SECONDS",
     "what happens at that time: a mentor's cough, bleeding or pressure_drop, or stylet_out, stylet_in or inject "
     "(2 ml of contrast) at an access needle's hub, or the first two at a core needle's introducer; may be given "
     "many times",
     true},
    {"--real-time", nullptr, "at a person's pace: 1 kHz by the clock, stored while it runs; not under xray"},
    {"--resume", "ATTEMPT",
     "continue an interrupted attempt in real time: it keeps its case, needle, seed and operator, unless "
     "--operator names the file it was made with; give its --event again"},
    kJson};

}  // namespace

Command simulate_command() {
  return {.name = "simulate",
          .options = kSimulateOptions,
          .acts = true,
          .summary = "Has a simulated operator make attempts, which are recorded and scored.",
          .run = &run_simulate};
}

}  // namespace seldinger::app

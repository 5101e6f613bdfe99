// simulate.
#include <algorithm>
#include <cstdio>
#include <thread>

#include "app/answers_json.h"
#include "app/command.h"
#include "app/file.h"
#include "app/grade_text.h"
#include "app/metrics_text.h"
#include "app/simulation.h"
#include "app/this_program.h"

namespace seldinger::app {
namespace {

base::Result<assessment::OperatorProfile> profile_of(const std::string& name) {
  if (const auto profile = assessment::named_profile(name)) return *profile;
  if (!name.ends_with(".json"))
    throw UsageError("--operator is novice, intermediate, expert, learner or a .json file");
  const auto text = read_text(name, 1U << 20U);
  if (!text) return text.error();
  return assessment::profile_from_json(*text);
}

// "cough@12.5"
cases::Event mentors_event(const std::string& text) {
  const std::size_t at = text.find('@');
  const auto kind = cases::event_from(text.substr(0, at));
  const double t_s = at == text.npos ? -1.0 : parse_number(text.substr(at + 1)).value_or(-1.0);
  if (!kind || cases::find_event(*kind)->source != cases::EventSource::mentor || !(t_s >= 0.0))
    throw UsageError("--event is cough, bleeding or pressure_drop, @ and a time in seconds: cough@12.5");
  return {t_s, *kind};
}

}  // namespace

int run_simulate(const Arguments& arguments) {
  const std::string folder = arguments.required("--library"), case_id = arguments.required("--case");
  const auto seed = static_cast<std::uint64_t>(arguments.whole("--seed", 1, 0, 9'007'199'254'740'992));
  const auto count = arguments.whole("--count", 1, 1, 100'000);
  std::optional<std::size_t> people;
  if (arguments.has("--people")) people = static_cast<std::size_t>(arguments.whole("--people", 1, 1, 1'000));
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
  std::vector<cases::Event> scenario;
  if (arguments.has("--event"))
    for (const std::string& text : arguments.all("--event")) scenario.push_back(mentors_event(text));
  std::stable_sort(scenario.begin(), scenario.end(),
                   [](const cases::Event& a, const cases::Event& b) { return a.t_s < b.t_s; });
  const auto profile = profile_of(arguments.required("--operator"));
  if (!profile) return refuse(profile.error());
  auto library = casedb::Library::open(folder);
  if (!library) return refuse(library.error());
  auto simulation =
      Simulation::prepare(*library, this_program(), case_id, arguments.text("--lesion"), kind, modality);
  if (!simulation) return refuse(simulation.error());
  if (const auto set = simulation->set_scenario(std::move(scenario)); !set) return refuse(set.error());
  std::vector<SimulatedAttempt> attempts;
  casedb::Grader grader(*library);  // against the experts as they were before this run
  const auto stored = [&](SimulatedAttempt attempt) {
    if (const auto row = casedb::find_attempt(*library, attempt.attempt_id)) attempt.grade = grader.look_at(*row);
    attempts.push_back(std::move(attempt));
    if (arguments.has("--json")) return;
    std::printf("attempt %s  simulated %s  seed %llu\n", attempts.back().attempt_id.c_str(),
                attempts.back().operator_name.c_str(), static_cast<unsigned long long>(attempts.back().seed));
    if (attempts.back().grade) std::fputs(text_of_grade(*attempts.back().grade).c_str(), stdout);
    print_metrics(attempts.back().metrics);
    std::fflush(stdout);  // it is stored: whoever reads along may know
  };
  const auto trials = simulated_trials(*profile, seed, static_cast<std::size_t>(count), people);
  if (!arguments.has("--real-time")) {
    const auto done =
        simulation->attempts(trials, static_cast<std::size_t>(jobs), !arguments.has("--no-pictures"), stored);
    if (!done) return refuse(done.error());
  } else {
    for (const SimulatedTrial& trial : trials) {
      auto attempt = simulation->live_attempt(trial.profile, trial.seed);
      if (!attempt) return refuse(attempt.error());
      attempt->person = trial.person;
      attempt->number = trial.number;
      stored(std::move(*attempt));
    }
  }
  if (arguments.has("--json")) std::fputs(json_of_simulation(attempts).c_str(), stdout);
  return kDone;
}

}  // namespace seldinger::app

// rating open.
#include <algorithm>
#include <cstdio>
#include <set>

#include "app/acting/acting.h"
#include "app/cli/file.h"
#include "app/cli/progress.h"
#include "app/ratings/known_csv.h"
#include "app/ratings/rating_json.h"
#include "app/replay/replay_output.h"
#include "casedb/attempts/attempts.h"
#include "casedb/people/cohorts.h"
#include "casedb/people/consent.h"
#include "casedb/studies/enrolments.h"

namespace seldinger::app {
namespace {

constexpr std::size_t kMostKnownBytes = 1U << 20U;

// Whose attempts are rated: a study's who consent, a cohort's who are in it now; or the attempts that are named.
base::Result<std::vector<casedb::AttemptRow>> attempts_to_rate(casedb::Library& library,
                                                               const Arguments& arguments) {
  std::vector<casedb::AttemptRow> rows;
  for (const std::string& id : arguments.all("--attempt")) {
    auto row = casedb::find_attempt(library, id);
    if (!row) return row.error();
    rows.push_back(std::move(*row));
  }
  std::set<std::string> people;
  if (arguments.has("--study") && rows.empty()) {
    const auto study = casedb::find_study(library, arguments.text("--study"));
    if (!study) return study.error();
    people = casedb::people_asked(library, study->study_id);
  }
  if (arguments.has("--cohort")) {
    const auto cohort = casedb::find_cohort(library, arguments.text("--cohort"));
    if (!cohort) return cohort.error();
    for (const casedb::Learner& one : cohort->learners)
      if (one.still) people.insert(one.person_id);
  }
  for (const std::string& person_id : people)
    for (casedb::AttemptRow& row : casedb::list_attempts_of(library, person_id)) rows.push_back(std::move(row));
  const std::string case_id = arguments.text("--case");
  std::erase_if(rows, [&](const casedb::AttemptRow& row) { return !case_id.empty() && row.case_id != case_id; });
  // By their ids, so that whose they are has no part in what the seed makes of them.
  std::sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.attempt_id < b.attempt_id; });
  rows.erase(std::unique(rows.begin(), rows.end(),
                         [](const auto& a, const auto& b) { return a.attempt_id == b.attempt_id; }),
             rows.end());
  if (rows.empty()) return base::Error{"bad_design", "there is no attempt to rate"};
  return rows;
}

// Only what somebody may see themselves do they hand to raters; of a study only whom its plan is of, by consent.
base::Result<void> may_hand_out(casedb::Library& library, const Arguments& arguments,
                                const std::optional<std::string>& study_id, const casedb::AttemptRow& row) {
  if (const auto by = acting_on(library, arguments, casedb::Action::see_attempt, row.person_id); !by)
    return by.error();
  if (study_id && row.person_id && !casedb::people_asked(library, *study_id).contains(*row.person_id))
    return base::Error{
        "no_consent",
        "the person who made it does not consent to the study, or the study is not about such people"};
  return {};
}

base::Result<casedb::NewRatedReplay> drawn(casedb::Library& library, const casedb::AttemptRow& row) {
  const auto recording = casedb::load_recording(library, row.attempt_id);
  if (!recording) return recording.error();
  auto sheet = replay_to_rate(library, row, *recording);
  if (!sheet) return sheet.error();
  return casedb::NewRatedReplay{row.attempt_id, std::move(*sheet), {}};
}

// Draws what is to be rated; what is in the calibration set is not rated beside.
base::Result<void> draw_all(casedb::Library& library, const Arguments& arguments,
                            const std::vector<KnownRow>& known, casedb::NewRatingRound& made) {
  auto rows = attempts_to_rate(library, arguments);
  if (!rows) return rows.error();
  std::erase_if(*rows, [&](const casedb::AttemptRow& row) {
    return std::any_of(known.begin(), known.end(),
                       [&](const KnownRow& one) { return one.attempt_id == row.attempt_id; });
  });
  std::vector<casedb::AttemptRow> calibration;
  for (const KnownRow& one : known) {
    auto row = casedb::find_attempt(library, one.attempt_id);
    if (!row) return row.error();
    calibration.push_back(std::move(*row));
  }
  for (const auto* all : {&calibration, &*rows})
    for (const casedb::AttemptRow& row : *all)
      if (const auto may = may_hand_out(library, arguments, made.round.study_id, row); !may) return may.error();
  Progress progress(calibration.size() + rows->size());
  for (std::size_t i = 0; i < calibration.size() + rows->size(); ++i) {
    const bool is_known = i < calibration.size();
    auto replay = drawn(library, is_known ? calibration[i] : (*rows)[i - calibration.size()]);
    if (!replay) return replay.error();
    if (is_known) replay->known = known[i].scores;
    (is_known ? made.calibration : made.replays).push_back(std::move(*replay));
    progress.one_done();
  }
  return {};
}

int run_rating_open(const Arguments& arguments) {
  casedb::NewRatingRound made;
  made.round.title = arguments.required("--title");
  made.round.form_id = arguments.positional(0);
  made.round.version = static_cast<int>(arguments.whole("--version", 0, 1, 1'000'000));
  made.raters = static_cast<std::size_t>(
      arguments.whole("--raters", 2, 1, static_cast<long long>(assessment::rating::kMostRaters)));
  made.each = static_cast<std::size_t>(arguments.whole("--each",
                                                       std::min<long long>(2, static_cast<long long>(made.raters)),
                                                       1, static_cast<long long>(made.raters)));
  made.repeats = static_cast<std::size_t>(arguments.whole("--repeats", 0, 0, 100));
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  const auto by = acting(*library, arguments, casedb::Action::manage_questionnaires);
  if (!by) return refuse(by.error());
  if (arguments.has("--study")) {
    const auto study = casedb::find_study(*library, arguments.text("--study"));
    if (!study) return refuse(study.error());
    made.round.study_id = study->study_id;
  }
  const auto forms = casedb::find_forms(*library, made.round.form_id, made.round.version);
  if (!forms) return refuse(forms.error());  // before anything is drawn
  std::vector<KnownRow> known;
  if (arguments.has("--known")) {
    const auto text = read_text_of(arguments, "--known", kMostKnownBytes);
    if (!text) return refuse(text.error());
    auto rows = known_in_csv(*text);
    if (!rows) return refuse(rows.error());
    known = std::move(*rows);
  }
  if (const auto all = draw_all(*library, arguments, known, made); !all) return refuse(all.error());
  const auto opened = casedb::open_rating_round(*library, made);
  if (!opened) return refuse(opened.error());
  if (arguments.has("--json")) {
    std::fputs(json_of_opened(*opened, made.replays.size(), made.calibration.size()).c_str(), stdout);
    return kDone;
  }
  std::printf("%s: %zu to rate, %zu to calibrate\n", opened->round.code.c_str(), made.replays.size(),
              made.calibration.size());
  for (std::size_t i = 0; i < opened->keys.size(); ++i) std::printf("R%zu  %s\n", i + 1, opened->keys[i].c_str());
  std::puts("Each rater types their key at /rate where `seldinger serve` runs. The keys are not shown again.");
  return kDone;
}

constexpr Option kRatingOpenOptions[] = {
    kLibrary,
    {"--title", "TEXT", "the title that raters read; it should not name a person, group or day"},
    {"--version", "N", "of this version of the form; default: the newest"},
    {"--attempt", "ATTEMPT", "an attempt to be rated", true},
    {"--study", "STUDY",
     "ratings belong to this study; without --attempt or --cohort: every attempt of its consenting people"},
    {"--cohort", "COHORT", "every attempt of its current members"},
    {"--case", "CASE", "only attempts on this case"},
    {"--raters", "N", "how many raters, 1 to 12; default 2"},
    {"--each", "N", "how many of them rate each replay; default 2"},
    {"--repeats", "N", "how many replays each rater rates twice, at most a third of theirs; default 0"},
    {"--known", "FILE.csv", "the calibration set: a column attempt, and one for each item with an agreed score"},
    kJson};

}  // namespace

Command rating_open_command() {
  return {.name = "rating open",
          .positionals = "FORM",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kRatingOpenOptions,
          .acts = true,
          .summary =
              "Draws replays without saying whose they are, assigns them to raters, and prints the raters' keys "
              "(docs/ratings.md).",
          .run = &run_rating_open};
}

}  // namespace seldinger::app

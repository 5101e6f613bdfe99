#include <algorithm>
#include <set>
#include <unordered_map>

#include "casedb/attempts/add_unless.h"
#include "casedb/attempts/attempt_columns.h"
#include "casedb/attempts/attempts.h"
#include "casedb/database/new_assets.h"
#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/uuid.h"
#include "sim/base/check.h"

namespace seldinger::casedb {
namespace {

// Of simulated experts as many as a hint needs: thousands are made in a minute, and each page would read them all.
constexpr int kMostSimulated = 200;

void insert_attempt(Sqlite& database, const NewAttempt& attempt, const std::string& attempt_id,
                    std::size_t recording_chunks, const std::optional<std::string>& picture_sha256) {
  Statement insert = question(database, "add_attempt");
  bind_head(insert, attempt_id, attempt);
  insert.bind("step_version", std::int64_t{attempt.recording.step_version});
  insert.bind("duration_s", attempt.duration_s);
  insert.bind("state", attempt.recording.endpoint ? "complete" : "unfinished");
  insert.bind("recording_chunks", static_cast<std::int64_t>(recording_chunks));
  insert.bind("picture_sha256", picture_sha256);
  insert.bind("end_reason", attempt.end ? std::optional(name_of(*attempt.end)) : std::nullopt);
  insert.bind("away_s", attempt.away_s).run();
}

void insert_chunks(Sqlite& database, const std::string& attempt_id,
                   const std::vector<cases::RecordingChunk>& chunks) {
  Statement insert = question(database, "add_recording_chunk");
  for (const cases::RecordingChunk& chunk : chunks) bind_chunk(insert, attempt_id, chunk).run();
}

void insert_metrics(Sqlite& database, const std::string& attempt_id, const std::vector<MetricValue>& metrics) {
  Statement insert = question(database, "add_metric_value");
  for (std::size_t i = 0; i < metrics.size(); ++i)
    insert.bind("attempt_id", attempt_id)
        .bind("metric_id", metrics[i].id)
        .bind("version", metrics[i].version)
        .bind("position", static_cast<std::int64_t>(i))
        .bind("value", metrics[i].value)
        .bind("unit", metrics[i].unit)
        .bind("reason", metrics[i].reason)
        .run();
}

void insert_steps(Sqlite& database, const std::string& attempt_id,
                  const std::vector<assessment::StepResult>& steps) {
  Statement insert = question(database, "add_attempt_step");
  for (std::size_t i = 0; i < steps.size(); ++i)
    insert.bind("attempt_id", attempt_id)
        .bind("step_id", steps[i].id)
        .bind("version", steps[i].version)
        .bind("position", static_cast<std::int64_t>(i))
        .bind("state", std::string(assessment::name_of(steps[i].state)))
        .bind("t_s", steps[i].t_s)
        .bind("reason", steps[i].reason)
        .bind("how", steps[i].how ? std::optional(std::string(assessment::name_of(*steps[i].how))) : std::nullopt)
        .run();
}

// `told`: by whoever ran it.
void keep_conditions(Sqlite& database, const std::string& attempt_id, const NewAttempt& attempt,
                     const Conditions& told) {
  Conditions known = attempt.synthetic() ? joined(simulated_conditions(), told) : told;
  add_recorded(attempt.recording, known);
  insert_conditions(database, "add_attempt_condition", attempt_id, known);
}

AttemptRow read_attempt(const Statement& from) {
  AttemptRow row;
  static_cast<AttemptHead&>(row) = read_head(from);
  row.attempt_id = from.text("attempt_id");
  row.case_title = from.text("case_title");
  row.picture_sha256 = from.text("picture_sha256");
  row.lesion.center_lps_mm = {from.real("center_x_lps_mm"), from.real("center_y_lps_mm"),
                              from.real("center_z_lps_mm")};
  row.lesion.radius_mm = from.real("radius_mm");
  row.lesion.hu = from.real("lesion_hu");
  row.duration_s = from.real("duration_s");
  row.step_version = static_cast<std::uint32_t>(from.integer("step_version"));
  if (!from.is_null("end_reason")) row.end = end_from(from.text("end_reason"));
  return row;
}

// `attempts` and `metrics` are the two questions with their parameters; metrics come by attempt, metric and
// version.
std::vector<AttemptRow> read_bare(Statement attempts) {
  std::vector<AttemptRow> rows;
  while (attempts.step()) rows.push_back(read_attempt(attempts));
  return rows;
}

std::vector<AttemptRow> read_attempts(Statement attempts, Statement metrics) {
  std::vector<AttemptRow> rows = read_bare(std::move(attempts));
  std::unordered_map<std::string, std::size_t> place;
  for (std::size_t i = 0; i < rows.size(); ++i) place.emplace(rows[i].attempt_id, i);
  struct Positioned {
    std::int64_t position;
    MetricValue value;
  };
  std::vector<Positioned> of_one;
  std::vector<MetricValue> older;
  std::string attempt_id;
  const auto hand_over = [&] {
    std::sort(of_one.begin(), of_one.end(), [](const Positioned& a, const Positioned& b) {
      return a.position != b.position ? a.position < b.position : a.value.id < b.value.id;
    });
    // An attempt added between the two questions is not in `place`.
    if (const auto at = place.find(attempt_id); at != place.end()) {
      for (Positioned& metric : of_one) rows[at->second].metrics.push_back(std::move(metric.value));
      rows[at->second].older_metrics = std::move(older);
    }
    of_one.clear();
    older.clear();
  };
  while (metrics.step()) {
    if (metrics.view("attempt_id") != attempt_id) {
      hand_over();
      attempt_id = metrics.text("attempt_id");
    }
    MetricValue value = read_metric(metrics);
    if (!of_one.empty() && of_one.back().value.id == value.id) {  // an older version
      older.push_back(std::move(of_one.back().value));
      of_one.pop_back();
    }
    of_one.push_back({metrics.integer("position"), std::move(value)});
  }
  hand_over();
  return rows;
}

}  // namespace

base::Result<std::string> add_attempt(Library& library, const NewAttempt& attempt) {
  const auto added = add_attempt_unless(library, attempt, [] { return false; });
  return added ? base::Result<std::string>(**added) : added.error();
}

base::Result<std::optional<std::string>> add_attempt_unless(Library& library, const NewAttempt& attempt,
                                                            const std::function<bool()>& is_there) {
  Sqlite& database = library.database();
  const std::vector<cases::RecordingChunk> chunks = cases::chunks_from_recording(attempt.recording);
  NewAssets assets(library);
  std::optional<std::string> picture_sha256;
  if (!attempt.picture_png.empty()) picture_sha256 = assets.add(attempt.picture_png);

  Transaction transaction(database);
  if (is_there()) return std::optional<std::string>();
  if (const auto known = check_head(database, attempt); !known) return known.error();
  assets.make_sure();
  std::string attempt_id = new_uuid();
  insert_attempt(database, attempt, attempt_id, chunks.size(), picture_sha256);
  insert_chunks(database, attempt_id, chunks);
  insert_metrics(database, attempt_id, attempt.metrics);
  insert_steps(database, attempt_id, attempt.steps);
  if (attempt.servo) insert_servo_record(database, attempt_id, *attempt.servo);
  keep_conditions(database, attempt_id, attempt, attempt.conditions);
  transaction.commit();
  assets.keep();
  return std::optional(std::move(attempt_id));
}

base::Result<void> close_attempt(Library& library, const std::string& attempt_id, const AttemptOutcome& outcome) {
  Sqlite& database = library.database();
  NewAssets assets(library);
  std::optional<std::string> picture_sha256;
  if (!outcome.picture_png.empty()) picture_sha256 = assets.add(outcome.picture_png);

  Transaction transaction(database);
  NewAttempt attempt;
  static_cast<AttemptOutcome&>(attempt) = outcome;
  {
    Statement open = question(database, "open_attempt");
    if (!open.bind("attempt_id", attempt_id).step())
      return base::Error{"no_attempt", "there is no such open attempt in the library"};
    static_cast<AttemptHead&>(attempt) = read_head(open);
  }
  std::vector<cases::RecordingChunk> chunks = read_chunks(question(database, "open_chunks"), attempt_id);
  if (chunks.empty()) chunks.push_back(cases::chunk_of({}, 0));  // it died within its first chunk
  auto recording = cases::recording_from_chunks(chunks);
  if (!recording) return recording.error();
  attempt.recording = std::move(*recording);
  attempt.duration_s = static_cast<double>(attempt.recording.inputs.size()) * attempt.recording.dt_s;
  assets.make_sure();
  insert_attempt(database, attempt, attempt_id, chunks.size(), picture_sha256);
  insert_chunks(database, attempt_id, chunks);
  insert_metrics(database, attempt_id, attempt.metrics);
  insert_steps(database, attempt_id, attempt.steps);
  if (attempt.servo) insert_servo_record(database, attempt_id, *attempt.servo);
  keep_conditions(
      database, attempt_id, attempt,
      joined(read_conditions(question(database, "conditions_of_open_attempt"), attempt_id), attempt.conditions));
  question(database, "remove_open_attempt").bind("attempt_id", attempt_id).run();
  transaction.commit();
  assets.keep();
  return {};
}

base::Result<std::size_t> add_metrics(Library& library, const std::string& attempt_id,
                                      const std::vector<MetricValue>& metrics) {
  Sqlite& database = library.database();
  Transaction transaction(database);
  Statement attempt = question(database, "recording_size");
  if (!attempt.bind("attempt_id", attempt_id).step())
    return base::Error{"no_attempt", "there is no such attempt in the library"};
  attempt.rewind();
  std::set<std::pair<std::string, int>> there;
  Statement known = question(database, "metric_values_of_attempt");
  for (known.bind("attempt_id", attempt_id); known.step();)
    there.emplace(known.text("metric_id"), known.small_integer("version"));
  std::vector<MetricValue> news;
  for (const MetricValue& metric : metrics)
    if (!there.contains({metric.id, metric.version})) news.push_back(metric);
  insert_metrics(database, attempt_id, news);
  transaction.commit();
  return news.size();
}

base::Result<std::size_t> add_steps(Library& library, const std::string& attempt_id,
                                    const std::vector<assessment::StepResult>& steps) {
  Sqlite& database = library.database();
  Transaction transaction(database);
  Statement attempt = question(database, "recording_size");
  if (!attempt.bind("attempt_id", attempt_id).step())
    return base::Error{"no_attempt", "there is no such attempt in the library"};
  attempt.rewind();
  std::set<int> there;
  Statement known = question(database, "step_versions_of_attempt");
  for (known.bind("attempt_id", attempt_id); known.step();) there.insert(known.small_integer("version"));
  std::vector<assessment::StepResult> news;
  for (const assessment::StepResult& step : steps)
    if (!there.contains(step.version)) news.push_back(step);
  insert_steps(database, attempt_id, news);
  transaction.commit();
  return news.size();
}

std::vector<assessment::StepResult> list_steps(Library& library, const std::string& attempt_id) {
  std::vector<assessment::StepResult> steps;
  Statement rows = question(library.database(), "steps_of_attempt");
  for (rows.bind("attempt_id", attempt_id); rows.step();) {
    assessment::StepResult& step = steps.emplace_back();
    step.id = rows.text("step_id");
    step.version = rows.small_integer("version");
    const auto state = assessment::step_state_from(rows.text("state"));
    CHECK(state.has_value());  // the column's own check
    step.state = *state;
    if (!rows.is_null("t_s")) step.t_s = rows.real("t_s");
    step.reason = rows.text("reason");
    if (!rows.is_null("how")) step.how = assessment::step_how_from(rows.text("how"));
  }
  return steps;
}

namespace {

std::int64_t bounded(std::size_t value) {
  return static_cast<std::int64_t>(std::min<std::size_t>(value, std::numeric_limits<std::int64_t>::max()));
}

}  // namespace

std::vector<AttemptRow> list_attempts(Library& library, const WhoseAttempts& whose, std::size_t first,
                                      std::size_t count) {
  Sqlite& database = library.database();
  const Snapshot one_state(database);
  std::vector<std::string> ids;
  Statement wanted = question(database, "attempts_of_people");
  wanted.bind("people", json_of_ids(whose.people)).bind("nobodys", whose.nobodys ? 1 : 0);
  for (wanted.bind("first", bounded(first)).bind("count", bounded(count)); wanted.step();)
    ids.push_back(wanted.text("attempt_id"));
  Statement attempts = question(database, "attempts_by_id"), metrics = question(database, "metric_values_by_id");
  for (Statement* part : {&attempts, &metrics}) part->bind("attempts", json_of_ids(ids));
  return read_attempts(std::move(attempts), std::move(metrics));
}

std::size_t count_attempts(Library& library, const WhoseAttempts& whose) {
  Statement counted = question(library.database(), "attempt_count_of_people");
  counted.bind("people", json_of_ids(whose.people)).bind("nobodys", whose.nobodys ? 1 : 0);
  CHECK(counted.step());
  return static_cast<std::size_t>(counted.integer("attempts"));
}

std::vector<AttemptRow> list_attempts(Library& library, std::size_t first, std::size_t count) {
  Sqlite& database = library.database();
  Statement attempts = question(database, "attempts"), metrics = question(database, "metric_values");
  for (Statement* part : {&attempts, &metrics}) part->bind("first", bounded(first)).bind("count", bounded(count));
  const Snapshot one_state(database);  // both questions mean the same attempts
  return read_attempts(std::move(attempts), std::move(metrics));
}

std::size_t count_attempts(Library& library) {
  Statement counted = question(library.database(), "attempt_count");
  CHECK(counted.step());
  return static_cast<std::size_t>(counted.integer("attempts"));
}

std::vector<AttemptRow> list_attempts_of(Library& library, const std::string& person_id) {
  Sqlite& database = library.database();
  Statement attempts = question(database, "attempts_of_person");
  Statement metrics = question(database, "metric_values_of_person");
  attempts.bind("person_id", person_id);
  metrics.bind("person_id", person_id);
  return read_attempts(std::move(attempts), std::move(metrics));
}

std::vector<AttemptRow> list_bare_attempts_of(Library& library, const std::string& person_id) {
  Statement attempts = question(library.database(), "attempts_of_person");
  attempts.bind("person_id", person_id);
  return read_bare(std::move(attempts));
}

std::vector<AttemptRow> list_attempts_of_seed(Library& library, const std::string& person_id, std::uint64_t seed) {
  Statement attempts = question(library.database(), "attempts_of_seed");
  attempts.bind("person_id", person_id).bind("seed", static_cast<std::int64_t>(seed));
  return read_bare(std::move(attempts));
}

std::vector<AttemptRow> list_attempts_of(Library& library, const std::string& person_id,
                                         const std::set<std::string>& metrics) {
  Sqlite& database = library.database();
  Statement attempts = question(database, "attempts_of_person");
  Statement values = question(database, "metric_values_of_person_among");
  std::string names = " ";
  for (const std::string& one : metrics) names += one + " ";
  attempts.bind("person_id", person_id);
  values.bind("person_id", person_id).bind("metrics", names);
  return read_attempts(std::move(attempts), std::move(values));
}

std::vector<AttemptRow> list_attempts_on(Library& library, const std::string& case_id) {
  Sqlite& database = library.database();
  Statement attempts = question(database, "attempts_on_case"),
            metrics = question(database, "metric_values_on_case");
  for (Statement* part : {&attempts, &metrics}) part->bind("case_id", case_id);
  const Snapshot one_state(database);
  return read_attempts(std::move(attempts), std::move(metrics));
}

std::vector<AttemptRow> list_expert_attempts(Library& library, const std::string& case_id,
                                             assessment::SetKind kind) {
  Sqlite& database = library.database();
  const bool consultants = kind == assessment::SetKind::consultants;
  Statement attempts = question(database, consultants ? "consultant_attempts" : "expert_attempts");
  Statement metrics = question(database, consultants ? "metric_values_of_consultants" : "metric_values_of_experts");
  for (Statement* part : {&attempts, &metrics}) {
    part->bind("case_id", case_id);
    if (!consultants) part->bind("most", kMostSimulated);
  }
  const Snapshot one_state(database);
  return read_attempts(std::move(attempts), std::move(metrics));
}

base::Result<AttemptRow> find_attempt(Library& library, const std::string& attempt_id) {
  Sqlite& database = library.database();
  Statement attempt = question(database, "attempt");
  Statement metrics = question(database, "metric_values_of_attempt");
  attempt.bind("attempt_id", attempt_id);
  metrics.bind("attempt_id", attempt_id);
  std::vector<AttemptRow> rows = read_attempts(std::move(attempt), std::move(metrics));
  if (rows.empty()) return base::Error{"no_attempt", "there is no such attempt in the library"};
  rows.front().conditions = find_conditions(library, attempt_id);
  return std::move(rows.front());
}

base::Result<cases::Recording> load_recording(Library& library, const std::string& attempt_id) {
  Sqlite& database = library.database();
  Statement size = question(database, "recording_size");
  if (!size.bind("attempt_id", attempt_id).step())
    return base::Error{"no_attempt", "there is no such attempt in the library"};
  const std::int64_t expected = size.integer("recording_chunks");
  size.rewind();
  const auto chunks = read_chunks(question(database, "recording_chunks"), attempt_id);
  if (static_cast<std::int64_t>(chunks.size()) != expected)
    return base::Error{"incomplete", "a piece of the recording is missing"};
  return cases::recording_from_chunks(chunks);
}

std::map<std::string, std::string> condition_words_of(Library& library, const std::string& person_id,
                                                      const std::string& condition_id) {
  std::map<std::string, std::string> words;
  Statement rows = question(library.database(), "condition_words_of_person");
  for (rows.bind("person_id", person_id).bind("condition_id", condition_id); rows.step();)
    words.emplace(rows.text("attempt_id"), rows.text("words"));
  return words;
}

}  // namespace seldinger::casedb

#include <algorithm>
#include <bit>
#include <unordered_map>

#include "casedb/new_assets.h"
#include "casedb/question.h"
#include "casedb/sqlite.h"
#include "casedb/store.h"
#include "casedb/uuid.h"
#include "sim/base/check.h"

namespace seldinger::casedb {
namespace {

// Unsigned 64-bit numbers as the database's signed ones: the same bits.
std::int64_t stored_bits(std::uint64_t value) noexcept {
  return std::bit_cast<std::int64_t>(value);
}
std::uint64_t bits_from_stored(std::int64_t value) noexcept {
  return std::bit_cast<std::uint64_t>(value);
}

const char* kind_name(cases::InstrumentKind kind) {
  return kind == cases::InstrumentKind::core ? "core" : "access";
}
const char* approach_name(cases::Approach approach) {
  return approach == cases::Approach::out_of_plane ? "out_of_plane" : "in_plane";
}
void insert_attempt(Sqlite& database, const NewAttempt& attempt, const std::string& attempt_id,
                    std::size_t recording_chunks, const std::optional<std::string>& picture_sha256) {
  Statement insert = question(database, "add_attempt");
  insert.bind("attempt_id", attempt_id).bind("case_id", attempt.case_id).bind("lesion_id", attempt.lesion_id);
  insert.bind("person_id", attempt.person_id).bind("operator_name", attempt.operator_name);
  insert.bind("seed", stored_bits(attempt.seed)).bind("program_version", attempt.program_version);
  insert.bind("step_version", std::int64_t{attempt.recording.step_version});
  insert.bind("approach", approach_name(attempt.approach));
  const cases::Instrument& instrument = attempt.instrument;
  insert.bind("instrument_kind", kind_name(instrument.kind)).bind("instrument_length_mm", instrument.length_mm);
  insert.bind("instrument_radius_mm", instrument.radius_mm);
  insert.bind("instrument_inner_radius_mm", instrument.inner_radius_mm).bind("instrument_hu", instrument.hu);
  insert.bind("instrument_throw_mm", instrument.throw_mm).bind("instrument_notch_mm", instrument.notch_mm);
  insert.bind("instrument_dead_tip_mm", instrument.dead_tip_mm);
  const cases::Picture& picture = attempt.picture;
  insert.bind("picture_modality", name_of(picture.modality)).bind("picture_depth_mm", picture.depth_mm);
  insert.bind("picture_width_mm", picture.width_mm).bind("picture_rate_hz", picture.rate_hz);
  insert.bind("picture_probe", picture.probe.empty() ? std::nullopt : std::optional(picture.probe));
  insert.bind("started_us", attempt.started_us).bind("duration_s", attempt.duration_s);
  insert.bind("state", attempt.recording.endpoint ? "complete" : "unfinished");
  insert.bind("recording_chunks", static_cast<std::int64_t>(recording_chunks));
  insert.bind("picture_sha256", picture_sha256).run();
}

void insert_chunks(Sqlite& database, const std::string& attempt_id,
                   const std::vector<cases::RecordingChunk>& chunks) {
  Statement insert = question(database, "add_recording_chunk");
  for (const cases::RecordingChunk& chunk : chunks)
    insert.bind("attempt_id", attempt_id)
        .bind("sequence", std::int64_t{chunk.sequence})
        .bind("checksum", stored_bits(chunk.checksum))
        .bind("data", std::span(chunk.data))
        .run();
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

AttemptRow read_attempt(const Statement& from) {
  AttemptRow row;
  row.attempt_id = from.text("attempt_id");
  row.case_id = from.text("case_id");
  row.case_title = from.text("case_title");
  row.lesion_id = from.text("lesion_id");
  row.operator_name = from.text("operator_name");
  row.program_version = from.text("program_version");
  row.picture_sha256 = from.text("picture_sha256");
  if (!from.is_null("person_id")) row.person_id = from.text("person_id");
  row.seed = bits_from_stored(from.integer("seed"));
  row.instrument.kind = from.text("instrument_kind") == kind_name(cases::InstrumentKind::core)
                            ? cases::InstrumentKind::core
                            : cases::InstrumentKind::access;
  row.instrument.length_mm = from.real("instrument_length_mm");
  row.instrument.radius_mm = from.real("instrument_radius_mm");
  row.instrument.inner_radius_mm = from.real("instrument_inner_radius_mm");
  row.instrument.hu = from.real("instrument_hu");
  row.instrument.throw_mm = from.real("instrument_throw_mm");
  row.instrument.notch_mm = from.real("instrument_notch_mm");
  row.instrument.dead_tip_mm = from.real("instrument_dead_tip_mm");
  row.picture.modality = *modality_from(from.text("picture_modality"));  // the schema takes no others
  row.picture.depth_mm = from.real("picture_depth_mm");
  row.picture.width_mm = from.real("picture_width_mm");
  row.picture.rate_hz = from.real("picture_rate_hz");
  row.picture.probe = from.text("picture_probe");
  row.approach = from.text("approach") == approach_name(cases::Approach::out_of_plane)
                     ? cases::Approach::out_of_plane
                     : cases::Approach::in_plane;
  row.lesion.center_lps_mm = {from.real("center_x_lps_mm"), from.real("center_y_lps_mm"),
                              from.real("center_z_lps_mm")};
  row.lesion.radius_mm = from.real("radius_mm");
  row.lesion.hu = from.real("lesion_hu");
  row.started_us = from.integer("started_us");
  row.duration_s = from.real("duration_s");
  row.step_version = static_cast<std::uint32_t>(from.integer("step_version"));
  return row;
}

// `attempts` and `metrics` are the two questions with their parameters; metrics come by attempt, metric and
// version.
std::vector<AttemptRow> read_attempts(Statement attempts, Statement metrics) {
  std::vector<AttemptRow> rows;
  std::unordered_map<std::string, std::size_t> place;
  while (attempts.step()) {
    rows.push_back(read_attempt(attempts));
    place.emplace(rows.back().attempt_id, rows.size() - 1);
  }
  struct Positioned {
    std::int64_t position;
    MetricValue value;
  };
  std::vector<Positioned> of_one;
  std::string attempt_id;
  const auto hand_over = [&] {
    std::sort(of_one.begin(), of_one.end(), [](const Positioned& a, const Positioned& b) {
      return a.position != b.position ? a.position < b.position : a.value.id < b.value.id;
    });
    // An attempt added between the two questions is not in `place`.
    if (const auto at = place.find(attempt_id); at != place.end())
      for (Positioned& metric : of_one) rows[at->second].metrics.push_back(std::move(metric.value));
    of_one.clear();
  };
  while (metrics.step()) {
    if (metrics.view("attempt_id") != attempt_id) {
      hand_over();
      attempt_id = metrics.text("attempt_id");
    }
    MetricValue value;
    value.id = metrics.text("metric_id");
    value.version = metrics.small_integer("version");
    if (!metrics.is_null("value")) value.value = metrics.real("value");
    value.unit = metrics.text("unit");
    value.reason = metrics.text("reason");
    if (!of_one.empty() && of_one.back().value.id == value.id) of_one.pop_back();  // an older version
    of_one.push_back({metrics.integer("position"), std::move(value)});
  }
  hand_over();
  return rows;
}

}  // namespace

base::Result<std::string> add_attempt(Library& library, const NewAttempt& attempt) {
  Sqlite& database = library.database();
  const std::vector<cases::RecordingChunk> chunks = cases::chunks_from_recording(attempt.recording);
  NewAssets assets(library);
  std::optional<std::string> picture_sha256;
  if (!attempt.picture_png.empty()) picture_sha256 = assets.add(attempt.picture_png);

  Transaction transaction(database);
  Statement parts = question(database, "case_has_lesion");
  parts.bind("case_id", attempt.case_id).bind("lesion_id", attempt.lesion_id);
  CHECK(parts.step());
  if (parts.integer("case_exists") == 0) return base::Error{"no_case", "there is no such case in the library"};
  if (parts.integer("lesion_exists") == 0) return base::Error{"no_lesion", "there is no such lesion in the case"};
  if (attempt.person_id) {
    Statement person = question(database, "person_exists");
    CHECK(person.bind("person_id", *attempt.person_id).step());
    if (person.integer("found") == 0) return base::Error{"no_person", "there is no such person in the library"};
  }
  parts.rewind();
  assets.make_sure();
  std::string attempt_id = new_uuid();
  insert_attempt(database, attempt, attempt_id, chunks.size(), picture_sha256);
  insert_chunks(database, attempt_id, chunks);
  insert_metrics(database, attempt_id, attempt.metrics);
  transaction.commit();
  assets.keep();
  return attempt_id;
}

std::vector<AttemptRow> list_attempts(Library& library) {
  Sqlite& database = library.database();
  return read_attempts(question(database, "attempts"), question(database, "metric_values"));
}

std::vector<AttemptRow> list_attempts_of(Library& library, const std::string& person_id) {
  Sqlite& database = library.database();
  Statement attempts = question(database, "attempts_of_person");
  Statement metrics = question(database, "metric_values_of_person");
  attempts.bind("person_id", person_id);
  metrics.bind("person_id", person_id);
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
  return std::move(rows.front());
}

base::Result<cases::Recording> load_recording(Library& library, const std::string& attempt_id) {
  Sqlite& database = library.database();
  Statement size = question(database, "recording_size");
  if (!size.bind("attempt_id", attempt_id).step())
    return base::Error{"no_attempt", "there is no such attempt in the library"};
  const std::int64_t expected = size.integer("recording_chunks");
  size.rewind();
  std::vector<cases::RecordingChunk> chunks;
  Statement rows = question(database, "recording_chunks");
  for (rows.bind("attempt_id", attempt_id); rows.step();) {
    cases::RecordingChunk& chunk = chunks.emplace_back();
    chunk.sequence = static_cast<std::uint32_t>(rows.integer("sequence"));
    chunk.checksum = bits_from_stored(rows.integer("checksum"));
    chunk.data = rows.bytes("data");
  }
  if (static_cast<std::int64_t>(chunks.size()) != expected)
    return base::Error{"incomplete", "a piece of the recording is missing"};
  return cases::recording_from_chunks(chunks);
}

}  // namespace seldinger::casedb

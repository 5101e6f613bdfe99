#include "casedb/attempts/attempt_columns.h"

#include "casedb/cases/cases.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "casedb/attempts/condition_table.h"
#include "casedb/cases/setting_columns.h"
#include "casedb/database/question.h"
#include "sim/base/check.h"
#include "sim/base/codec.h"
#include "sim/base/names.h"

namespace seldinger::casedb {
namespace {

// Unsigned 64-bit numbers as the database's signed ones: the same bits.
std::int64_t stored_bits(std::uint64_t value) noexcept {
  return std::bit_cast<std::int64_t>(value);
}
std::uint64_t bits_from_stored(std::int64_t value) noexcept {
  return std::bit_cast<std::uint64_t>(value);
}

constexpr auto kEnds = base::names<AttemptEnd>({{AttemptEnd::fired, "fired"},
                                                {AttemptEnd::stopped, "stopped"},
                                                {AttemptEnd::time_limit, "time_limit"},
                                                {AttemptEnd::device_lost, "device_lost"},
                                                {AttemptEnd::interrupted, "interrupted"}});

// A histogram as a table's cell: its counts, how many and the most, compressed.
std::vector<std::byte> cell_of(const cases::TimeHistogram& histogram) {
  std::array<std::uint64_t, cases::TimeHistogram::kBins + 2> words{};
  std::copy(histogram.counts.begin(), histogram.counts.end(), words.begin());
  words[cases::TimeHistogram::kBins] = histogram.n;
  words[cases::TimeHistogram::kBins + 1] = histogram.most_ns;
  return base::compress(std::as_bytes(std::span(words)));
}

cases::TimeHistogram histogram_of(const std::vector<std::byte>& cell) {
  std::array<std::uint64_t, cases::TimeHistogram::kBins + 2> words{};
  const auto bytes = base::decompress(cell, sizeof words);
  if (!bytes || bytes->size() != sizeof words)
    throw DatabaseFailure(DatabaseFailure::Kind::damaged, "a servo record cannot be read");
  std::memcpy(words.data(), bytes->data(), sizeof words);
  cases::TimeHistogram histogram;
  std::copy_n(words.begin(), cases::TimeHistogram::kBins, histogram.counts.begin());
  histogram.n = words[cases::TimeHistogram::kBins];
  histogram.most_ns = words[cases::TimeHistogram::kBins + 1];
  return histogram;
}

}  // namespace

std::string name_of(AttemptEnd end) {
  return std::string(base::name_of(kEnds, end));
}

AttemptEnd end_from(const std::string& name) {
  const auto end = base::from_name(kEnds, name);
  CHECK(end.has_value());
  return *end;
}

Statement& bind_head(Statement& insert, const std::string& attempt_id, const AttemptHead& head) {
  insert.bind("attempt_id", attempt_id).bind("case_id", head.case_id).bind("lesion_id", head.lesion_id);
  insert.bind("person_id", head.person_id).bind("operator_name", head.operator_name);
  insert.bind("seed", stored_bits(head.seed)).bind("program_version", head.program_version);
  bind_needle(insert, head.instrument, head.approach);
  const cases::Picture& picture = head.picture;
  insert.bind("picture_modality", name_of(picture.modality)).bind("picture_depth_mm", picture.depth_mm);
  insert.bind("picture_width_mm", picture.width_mm).bind("picture_rate_hz", picture.rate_hz);
  insert.bind("picture_probe", picture.probe.empty() ? std::nullopt : std::optional(picture.probe));
  return insert.bind("started_us", head.started_us);
}

AttemptHead read_head(const Statement& from) {
  AttemptHead head;
  head.case_id = from.text("case_id");
  head.lesion_id = from.text("lesion_id");
  head.operator_name = from.text("operator_name");
  head.program_version = from.text("program_version");
  if (!from.is_null("person_id")) head.person_id = from.text("person_id");
  head.seed = bits_from_stored(from.integer("seed"));
  read_needle(from, head.instrument, head.approach);
  head.picture.modality = *modality_from(from.text("picture_modality"));  // the schema takes no others
  head.picture.depth_mm = from.real("picture_depth_mm");
  head.picture.width_mm = from.real("picture_width_mm");
  head.picture.rate_hz = from.real("picture_rate_hz");
  head.picture.probe = from.text("picture_probe");
  head.started_us = from.integer("started_us");
  if (!from.is_null("away_s")) head.away_s = from.real("away_s");
  return head;
}

base::Result<void> check_head(Sqlite& database, const AttemptHead& head) {
  Statement parts = question(database, "case_has_lesion");
  parts.bind("case_id", head.case_id).bind("lesion_id", head.lesion_id);
  CHECK(parts.step());
  if (parts.integer("case_exists") == 0) return base::Error{"no_case", "there is no such case in the library"};
  if (parts.integer("lesion_exists") == 0) return base::Error{"no_lesion", "there is no such lesion in the case"};
  if (head.person_id) {
    Statement person = question(database, "person_exists");
    CHECK(person.bind("person_id", *head.person_id).step());
    if (person.integer("found") == 0) return base::Error{"no_person", "there is no such person in the library"};
  }
  if (head.person_id && head.operator_name == kPersonOperator) {
    Statement begun = question(database, "attempts_begun");
    CHECK(begun.bind("case_id", head.case_id).bind("person_id", *head.person_id).step());
    if (!begun.is_null("attempt_limit") && begun.integer("begun") >= begun.integer("attempt_limit"))
      return base::Error{"no_attempts_left", "as many attempts as case or curriculum allow have been made"};
  }
  return {};
}

Statement& bind_chunk(Statement& insert, const std::string& attempt_id, const cases::RecordingChunk& chunk) {
  return insert.bind("attempt_id", attempt_id)
      .bind("sequence", std::int64_t{chunk.sequence})
      .bind("checksum", stored_bits(chunk.checksum))
      .bind("data", std::span(chunk.data));
}

std::vector<cases::RecordingChunk> read_chunks(Statement rows, const std::string& attempt_id) {
  std::vector<cases::RecordingChunk> chunks;
  for (rows.bind("attempt_id", attempt_id); rows.step();) {
    cases::RecordingChunk& chunk = chunks.emplace_back();
    chunk.sequence = static_cast<std::uint32_t>(rows.integer("sequence"));
    chunk.checksum = bits_from_stored(rows.integer("checksum"));
    chunk.data = rows.bytes("data");
  }
  return chunks;
}

void insert_servo_record(Sqlite& database, const std::string& attempt_id, const cases::ServoRecord& record) {
  const auto period = cell_of(record.period), latency = cell_of(record.latency), compute = cell_of(record.compute);
  question(database, "add_servo_record")
      .bind("attempt_id", attempt_id)
      .bind("tick_s", record.tick_s)
      .bind("scheduler", record.scheduler == cases::ServoScheduler::fifo ? "fifo" : "other")
      .bind("memory_locked", record.memory_locked ? 1 : 0)
      .bind("ticks", static_cast<std::int64_t>(record.ticks))
      .bind("missed", static_cast<std::int64_t>(record.missed))
      .bind("period", std::span(period))
      .bind("latency", std::span(latency))
      .bind("compute", std::span(compute))
      .run();
}

void insert_conditions(Sqlite& database, const char* into, const std::string& attempt_id,
                       const Conditions& conditions) {
  Statement insert = question(database, into);
  for (const ConditionRow& row : condition_rows()) {
    const ConditionValue value = row.read(conditions);
    if (std::holds_alternative<std::monostate>(value)) continue;
    std::optional<double> number;
    std::optional<std::string> words;
    if (const bool* flag = std::get_if<bool>(&value)) number = *flag ? 1.0 : 0.0;
    if (const double* held = std::get_if<double>(&value)) number = *held;
    if (const std::string* held = std::get_if<std::string>(&value)) words = *held;
    insert.bind("attempt_id", attempt_id)
        .bind("condition_id", row.id)
        .bind("number", number)
        .bind("words", words)
        .run();
  }
}

Conditions read_conditions(Statement rows, const std::string& attempt_id) {
  Conditions conditions;
  for (rows.bind("attempt_id", attempt_id); rows.step();) {
    const ConditionRow* row = find_condition(rows.view("condition_id"));
    if (row == nullptr) continue;
    ConditionValue value;
    if (!rows.is_null("words"))
      value = rows.text("words");
    else if (row->kind == ConditionKind::flag)
      value = rows.real("number") != 0.0;
    else
      value = rows.real("number");
    row->write(conditions, value);
  }
  return conditions;
}

Conditions find_conditions(Library& library, const std::string& attempt_id) {
  return read_conditions(question(library.database(), "conditions_of_attempt"), attempt_id);
}

MetricValue read_metric(const Statement& from) {
  MetricValue metric;
  metric.id = from.text("metric_id");
  metric.version = from.small_integer("version");
  if (!from.is_null("value")) metric.value = from.real("value");
  metric.unit = from.text("unit");
  metric.reason = from.text("reason");
  return metric;
}

std::string json_of_ids(const std::vector<std::string>& ids) {
  std::string json = "[";
  for (const std::string& id : ids) {
    CHECK(id.find_first_not_of("0123456789abcdef-") == id.npos);
    json += (json.size() > 1 ? ",\"" : "\"") + id + "\"";
  }
  return json + "]";
}

std::optional<cases::ServoRecord> find_servo_record(Library& library, const std::string& attempt_id) {
  Statement row = question(library.database(), "servo_record");
  if (!row.bind("attempt_id", attempt_id).step()) return std::nullopt;
  return read_servo_record(row);
}

cases::ServoRecord read_servo_record(const Statement& row) {
  cases::ServoRecord record;
  record.tick_s = row.real("tick_s");
  record.scheduler = row.text("scheduler") == "fifo" ? cases::ServoScheduler::fifo : cases::ServoScheduler::other;
  record.memory_locked = row.integer("memory_locked") != 0;
  record.ticks = static_cast<std::uint64_t>(row.integer("ticks"));
  record.missed = static_cast<std::uint64_t>(row.integer("missed"));
  record.period = histogram_of(row.bytes("period"));
  record.latency = histogram_of(row.bytes("latency"));
  record.compute = histogram_of(row.bytes("compute"));
  return record;
}

}  // namespace seldinger::casedb

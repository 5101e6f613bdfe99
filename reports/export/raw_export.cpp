#include "reports/export/raw_export.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <span>

#include "casedb/attempts/attempt_history.h"
#include "casedb/database/disk.h"
#include "casedb/grading/grading.h"
#include "casedb/people/consent.h"
#include "casedb/people/facts.h"
#include "reports/export/data_package_json.h"
#include "reports/export/formats/motion_bids_json.h"
#include "reports/export/formats/slicer_json.h"
#include "reports/export/formats/xapi_json.h"
#include "reports/export/raw_tables.h"
#include "reports/export/redcap.h"
#include "reports/export/sqlite_tables.h"
#include "sim/base/hex.h"

namespace seldinger::reports {
namespace {

// Nobody ended it.
bool is_cut_off(const casedb::AttemptRow& row) {
  using casedb::AttemptEnd;
  return row.end == AttemptEnd::time_limit || row.end == AttemptEnd::device_lost ||
         row.end == AttemptEnd::interrupted;
}

namespace fs = std::filesystem;

constexpr std::size_t kPieceBytes = std::size_t{1} << 18;
constexpr double kDayUs = 86'400e6;

// A file of the new folder, written in pieces.
class Table {
 public:
  Table(const fs::path& file, const std::string& header) : file_(file), text_(header) {}
  void add(const std::string& line) {
    text_ += line;
    if (text_.size() >= kPieceBytes) flush();
  }
  void close() {
    flush();
    file_.keep_unsynced();
  }

 private:
  void flush() {
    file_.write(std::as_bytes(std::span(text_)));
    text_.clear();
  }
  casedb::NewFile file_;
  std::string text_;
};

// Whole ones, rounded down, where numbers are coarse.
double days(std::int64_t from_us, std::int64_t to_us, Precision precision) {
  const double exact = static_cast<double>(to_us - from_us) / kDayUs;
  return precision == Precision::exact ? exact : std::floor(exact);
}

void write_whole(const fs::path& file, const std::string& text) {
  Table(file, text).close();
}

// Ids hold the time at which they were made, and link exports to each other.
class Names {
 public:
  explicit Names(const casedb::HashKey& key) : key_(key) {}
  std::string of(const char* kind, const std::string& id) const {
    const auto hash = casedb::keyed_hash(key_, std::string(kind) + id);
    return kind + base::hex_from_bytes(std::span(hash).first(8));
  }
  // The same as a UUID by its name (RFC 9562, version 8: the bits are ours).
  std::string uuid_of(const std::string& id) const {
    auto hash = casedb::keyed_hash(key_, "uuid" + id);
    hash[6] = (hash[6] & std::byte{0x0f}) | std::byte{0x80};
    hash[8] = (hash[8] & std::byte{0x3f}) | std::byte{0x80};
    std::string text = base::hex_from_bytes(std::span(hash).first(16));
    for (const std::size_t at : {20U, 16U, 12U, 8U}) text.insert(at, 1, '-');
    return text;
  }

 private:
  const casedb::HashKey& key_;
};

// Nobody takes a simulated person for another.
const char* prefix_of(const casedb::AttemptKey& key) noexcept {
  return key.of_simulated_person ? "S-" : "P-";
}

// An attempt in the order of the rows: a person's attempts lie together as they were made, people and the
// simulations of nobody in the order of their names, which tells nothing.
struct Place {
  const casedb::AttemptKey* key = nullptr;
  std::string person, attempt;
  int person_attempt = 0;
  double days = 0.0;
  Precision precision = Precision::exact;
};

std::vector<Place> places_of(std::span<const casedb::AttemptKey> keys, const RawChoice& choice, const Names& names,
                             const std::set<std::string>& consenting) {
  struct Person {
    std::int64_t first_us = 0;
    int attempts = 0;
    std::string name;
  };
  std::map<std::string, Person> people;
  std::vector<Place> places;
  for (const casedb::AttemptKey& key : keys) {
    // What a simulated operator made is about nobody, also in somebody's name.
    if (!key.synthetic && !(key.person_id && consenting.contains(*key.person_id))) continue;
    Place place{&key, {}, names.of("A-", key.attempt_id)};
    if (!key.synthetic && !choice.exact) place.precision = Precision::coarse;
    if (!key.synthetic || key.of_simulated_person) {
      auto [at, is_new] = people.try_emplace(*key.person_id);
      if (is_new) at->second = {key.started_us, 0, names.of(prefix_of(key), *key.person_id)};
      place.person = at->second.name;
      place.person_attempt = ++at->second.attempts;
      place.days = days(at->second.first_us, key.started_us, place.precision);
    }
    if (!choice.case_id || key.case_id == *choice.case_id) places.push_back(std::move(place));
  }
  std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
    if (a.person.empty() != b.person.empty()) return b.person.empty();
    if (a.person != b.person) return a.person < b.person;
    if (a.person_attempt != b.person_attempt) return a.person_attempt < b.person_attempt;
    return a.attempt < b.attempt;
  });
  return places;
}

template <typename Row, typename Rows>
void write_samples(const fs::path& file, const std::vector<Column<Row>>& columns, const Rows& rows) {
  Table table(file, header_of(columns));
  for (const auto& row : rows) table.add(line_of(columns, row));
  table.close();
}

void write_recording(const fs::path& folder, const RawChoice& choice, const std::string& attempt,
                     const cases::Recording& recording, Precision precision, Table* events, RawExport& sum) {
  const std::string name = attempt + ".csv";
  if (choice.poses) {
    write_samples(folder / "poses" / name, pose_columns(), pose_facts(attempt, recording));
    ++sum.files;
  }
  if (choice.forces && !recording.forces.empty()) {
    std::vector<ForceFact> facts;
    for (const cases::ForceSample& force : recording.forces) facts.push_back({&attempt, force});
    write_samples(folder / "forces" / name, force_columns(), facts);
    ++sum.files;
  }
  if (choice.frames) {
    std::vector<FrameFact> facts;
    cases::ConsoleSetting console;
    std::size_t ticks = 0;
    for (const cases::FrameTruth& frame : recording.frames) {
      const auto until = static_cast<std::size_t>(std::max(0.0, std::round(frame.t_s / recording.dt_s)));
      for (; ticks < std::min(until, recording.inputs.size()); ++ticks)
        cases::turn(console, recording.inputs[ticks].console);
      facts.push_back({&attempt, frame, console});
    }
    write_samples(folder / "frames" / name, frame_columns(), facts);
    ++sum.files;
  }
  if (events != nullptr)
    for (const RecordedEvent& event : recorded_events(recording))
      events->add(line_of(event_columns(), EventFact{&attempt, event}, precision));
}

// The same in formats of other programs.
class OtherFormats {
 public:
  OtherFormats(casedb::Library& library, fs::path folder, const RawChoice& choice)
      : library_(library), folder_(std::move(folder)), choice_(choice), grader_(library) {}

  // `recording` null: it stays in the library.
  base::Result<void> add(const casedb::AttemptRow& row, const AttemptFacts& facts,
                         const cases::Recording* recording, Precision precision, std::string id) {
    const std::string person = facts.names.person.value_or("");
    if (choice_.xapi)
      statements_.push_back({std::move(id), person, facts.names.attempt, facts.names.case_id, row.synthetic(),
                             grader_.grade(row).verdict, is_cut_off(row), as_told(row.duration_s, precision)});
    if (recording == nullptr) return {};
    if (choice_.motion_bids) {
      subjects_.push_back(bids_subject(person));
      write(motion_bids_files(person, facts.names.attempt, *recording));
    }
    if (!choice_.slicer) return {};
    auto skin = skins_.find(row.case_id);
    if (skin == skins_.end()) {
      const auto mesh = casedb::load_skin(library_, *facts.of_case);
      if (!mesh) return mesh.error();
      skin = skins_.emplace(row.case_id, cases::MeshIndex(*mesh)).first;
    }
    write(slicer_files(facts.names.attempt, row.synthetic(), *recording, row.lesion.center_lps_mm, skin->second));
    return {};
  }
  // When all tables are written.
  void close() {
    if (choice_.xapi) write({{"xapi.json", xapi_statements(statements_)}});
    if (choice_.motion_bids) write(motion_bids_head(subjects_));
    if (!choice_.sqlite) return;
    write_sqlite_tables(folder_);
    ++files_;
  }
  std::size_t files() const noexcept { return files_; }

 private:
  void write(const std::vector<FormatFile>& files) {
    for (const FormatFile& one : files) {
      casedb::without_paths([&] { return fs::create_directories((folder_ / one.name).parent_path()); });
      write_whole(folder_ / one.name, one.content);
      ++files_;
    }
  }
  casedb::Library& library_;
  fs::path folder_;
  RawChoice choice_;
  casedb::Grader grader_;
  std::map<std::string, cases::MeshIndex> skins_;  // by case
  std::vector<XapiAttempt> statements_;
  std::vector<std::string> subjects_;
  std::size_t files_ = 0;
};

// attempts.csv, metrics.csv, steps.csv and, where it is asked for, events.csv.
class AttemptTables {
 public:
  AttemptTables(const fs::path& at, bool with_events)
      : attempts_(at / "attempts.csv", attempts_header()),
        metrics_(at / "metrics.csv", header_of(metric_columns())),
        steps_(at / "steps.csv", header_of(step_columns())) {
    if (with_events) events_.emplace(at / "events.csv", header_of(event_columns()));
  }
  // All but the events, which the recording tells.
  void add(casedb::Library& library, const AttemptFacts& facts, Precision precision, RawExport& sum) {
    const std::string& name = facts.names.attempt;
    attempts_.add(attempt_line(facts, precision));
    for (const casedb::MetricValue& metric : casedb::list_metric_versions(library, facts.row->attempt_id)) {
      metrics_.add(line_of(metric_columns(), MetricFact{&name, &metric}, precision));
      ++sum.metrics;
    }
    for (const assessment::StepResult& step : casedb::list_steps(library, facts.row->attempt_id))
      steps_.add(line_of(step_columns(), StepFact{&name, &step}, precision));
    ++sum.attempts;
    if (facts.row->synthetic()) ++sum.synthetic;
  }
  Table* events() noexcept { return events_ ? &*events_ : nullptr; }
  void close() {
    for (Table* one : {&attempts_, &metrics_, &steps_, events()})
      if (one != nullptr) one->close();
  }

 private:
  Table attempts_, metrics_, steps_;
  std::optional<Table> events_;
};

// What those people said of themselves, in the order of their names; times since the person's first attempt.
void write_facts(casedb::Library& library, std::span<const casedb::AttemptKey> keys, const Names& names,
                 const std::set<std::string>& people, Precision precision, Table& table) {
  std::map<std::string, std::int64_t> first_us;
  std::map<std::string, std::string> by_name;
  for (const casedb::AttemptKey& key : keys)
    if (key.person_id && (!key.synthetic || key.of_simulated_person)) {
      first_us.try_emplace(*key.person_id, key.started_us);
      if (people.contains(*key.person_id))
        by_name.try_emplace(names.of(prefix_of(key), *key.person_id), *key.person_id);
    }
  for (const auto& [name, person_id] : by_name)
    for (const casedb::FactGiven& one : casedb::list_facts(library, person_id))
      table.add(line_of(fact_columns(),
                        PersonFact{&name, &one, days(first_us.at(person_id), one.given_us, precision)}, precision));
}

// What says what the tables are: to people, to programs, to REDCap.
void write_descriptions(const fs::path& at, bool with_events) {
  std::vector<std::string> tables{"attempts.csv", "metrics.csv", "steps.csv", "facts.csv"};
  if (with_events) tables.emplace_back("events.csv");
  write_whole(at / "data_dictionary.csv", data_dictionary());
  write_whole(at / "datapackage.json", data_package(tables));
  write_whole(at / "redcap_dictionary.csv", redcap_dictionary());
  write_whole(at / "README.txt", raw_readme());
}

}  // namespace

base::Result<RawExport> export_raw(casedb::Library& library, const fs::path& out, const RawChoice& choice,
                                   const casedb::HashKey& key) {
  if (casedb::without_paths([&] { return fs::exists(fs::symlink_status(out)); }))
    return base::Error{"exists", "there is already something of that name"};
  if (choice.case_id)
    if (const auto known = casedb::find_case(library, *choice.case_id); !known) return known.error();
  if (choice.study_id)
    if (const auto known = casedb::find_study(library, *choice.study_id); !known) return known.error();
  const Names names(key);
  const std::set<std::string> consenting = casedb::consenting_people(library, choice.study_id);
  const std::vector<casedb::AttemptKey> keys = casedb::list_attempt_keys(library);
  std::map<std::string, casedb::CaseRow> cases_by_id;
  for (casedb::CaseRow& row : casedb::list_case_heads(library)) {
    std::string case_id = row.case_id;
    cases_by_id.emplace(std::move(case_id), std::move(row));
  }

  casedb::NewFolders parents(casedb::without_paths([&] { return fs::absolute(out); }).parent_path());
  casedb::NewFolder folder(out);
  const fs::path& at = folder.unfinished();
  RawExport sum;
  for (const auto& [wanted, name] :
       {std::pair{choice.poses, "poses"}, {choice.forces, "forces"}, {choice.frames, "frames"}})
    if (wanted) casedb::without_paths([&, name = name] { return fs::create_directory(at / name); });
  AttemptTables tables(at, choice.events);
  const bool recorded =
      choice.poses || choice.forces || choice.frames || choice.events || choice.slicer || choice.motion_bids;
  OtherFormats formats(library, at, choice);
  std::string person_before;
  std::set<std::string> people;  // whose own attempts are among them
  for (const Place& place : places_of(keys, choice, names, consenting)) {
    auto row = casedb::find_attempt(library, place.key->attempt_id);
    if (!row) return row.error();
    if (auto& station = row->conditions.station) station = names.of("W-", *station);  // somebody wrote it
    AttemptFacts facts;
    facts.names = {place.attempt, names.of("C-", row->case_id), names.of("T-", row->lesion_id), std::nullopt};
    facts.row = &*row;
    facts.of_case = &cases_by_id.at(row->case_id);
    if (!place.person.empty()) {
      facts.names.person = place.person;
      facts.person_attempt = place.person_attempt;
      facts.days_since_first = place.days;
      if (place.person != person_before) {
        ++sum.people;
        sum.simulated_people += place.key->of_simulated_person ? 1U : 0U;
      }
      people.insert(*place.key->person_id);
      person_before = place.person;
    }
    tables.add(library, facts, place.precision, sum);
    std::optional<cases::Recording> recording;
    if (recorded) {
      auto loaded = casedb::load_recording(library, row->attempt_id);
      if (!loaded) return loaded.error();
      recording = std::move(*loaded);
      RawChoice of_row = choice;
      if (place.precision == Precision::coarse) of_row.poses = of_row.forces = of_row.frames = false;
      write_recording(at, of_row, place.attempt, *recording, place.precision, tables.events(), sum);
    }
    const bool leaves = recording && place.precision == Precision::exact;
    if (const auto added = formats.add(*row, facts, leaves ? &*recording : nullptr, place.precision,
                                       names.uuid_of(row->attempt_id));
        !added)
      return added.error();
  }
  Table facts(at / "facts.csv", header_of(fact_columns()));
  write_facts(library, keys, names, people, choice.exact ? Precision::exact : Precision::coarse, facts);
  facts.close();
  tables.close();
  write_descriptions(at, choice.events);
  formats.close();
  sum.files += formats.files() + (choice.events ? 9 : 8);
  if (!folder.keep()) return base::Error{"exists", "there is already something of that name"};
  parents.keep();
  return sum;
}

}  // namespace seldinger::reports

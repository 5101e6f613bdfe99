// The tables of the raw export. A column stands here once: its name, what it means, and how its cell is written;
// header, cells, the data dictionary and docs/export.md come from here.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "casedb/attempts/attempts.h"
#include "casedb/cases/cases.h"
#include "casedb/people/facts.h"
#include "reports/charts/recorded_events.h"
#include "reports/export/csv_line.h"
#include "sim/case/record/recording.h"

namespace seldinger::reports {

struct ColumnInfo {
  std::string name;
  std::string type;     // text, number, integer, flag (1 or 0)
  std::string unit;     // empty: none
  std::string missing;  // when the cell is empty; empty text: never
  std::string what;
  std::optional<int> version{};  // of a metric's definition
  // Of a metric: how it is compared. Empty: of none.
  std::string better{}, scale{}, without_endpoint{}, of_a_person{};
};

template <typename Row>
struct Column : ColumnInfo {
  void (*write)(CsvLine&, const Row&);
};

// How a row of each table is called outside of the library.
struct Pseudonyms {
  std::string attempt, case_id, target;
  std::optional<std::string> person;
};

struct AttemptFacts {
  Pseudonyms names;
  const casedb::AttemptRow* row = nullptr;
  const casedb::CaseRow* of_case = nullptr;
  std::optional<int> person_attempt;       // from 1, among all attempts of that person
  std::optional<double> days_since_first;  // of that person
};
struct MetricFact {
  const std::string* attempt = nullptr;
  const casedb::MetricValue* metric = nullptr;
};
struct StepFact {
  const std::string* attempt = nullptr;
  const assessment::StepResult* step = nullptr;
};
struct PoseFact {
  const std::string* attempt = nullptr;
  cases::PoseSample pose;
  bool fire = false;
};
struct ForceFact {
  const std::string* attempt = nullptr;
  cases::ForceSample force;
};
struct FrameFact {
  const std::string* attempt = nullptr;
  cases::FrameTruth frame;
  cases::ConsoleSetting console;  // as it was set then
};
struct EventFact {
  const std::string* attempt = nullptr;
  RecordedEvent event;
};

// Without the conditions and the metrics, which are attempt_conditions() and attempt_metrics().
const std::vector<Column<AttemptFacts>>& attempt_columns();
struct PersonFact {
  const std::string* person = nullptr;
  const casedb::FactGiven* fact = nullptr;
  double days_since_first = 0.0;  // of that person's attempts; negative: answered before it
};

const std::vector<Column<AttemptFacts>>& attempt_columns();  // without the metrics, which are attempt_metrics()
const std::vector<Column<MetricFact>>& metric_columns();
const std::vector<Column<StepFact>>& step_columns();
// After `attempt`: a pose file's columns (app/attempts/poses_csv.h), kPoseFileColumns, and what a patient who moves
// has beside.
constexpr std::size_t kPoseFileColumns = 17;
const std::vector<Column<PoseFact>>& pose_columns();
const std::vector<Column<ForceFact>>& force_columns();
const std::vector<Column<FrameFact>>& frame_columns();
const std::vector<Column<EventFact>>& event_columns();
// A column for each row of casedb/attempts/condition_table.h, behind those.
const std::vector<ColumnInfo>& attempt_conditions();
const std::vector<Column<PersonFact>>& fact_columns();
// A column for each metric of the registry, behind the others of attempts.csv: its value in today's version.
const std::vector<ColumnInfo>& attempt_metrics();

std::string attempts_header();
std::string attempt_line(const AttemptFacts& facts, Precision precision = Precision::exact);

template <typename Row>
std::string header_of(const std::vector<Column<Row>>& columns) {
  CsvLine line;
  for (const Column<Row>& column : columns) line.text(column.name);
  return line.take();
}
template <typename Row>
std::string line_of(const std::vector<Column<Row>>& columns, const Row& row,
                    Precision precision = Precision::exact) {
  CsvLine line(precision);
  for (const Column<Row>& column : columns) column.write(line, row);
  return line.take();
}

// As a pose file has them (app/attempts/poses_csv.h): the endpoint is a row of its own time, with fire.
std::vector<PoseFact> pose_facts(const std::string& attempt, const cases::Recording& recording);

struct TableInfo {
  std::string file;  // "poses/ATTEMPT.csv": one a attempt
  std::string what;
  std::vector<ColumnInfo> columns;
};
const std::vector<TableInfo>& raw_tables();
const TableInfo& dictionary_table();  // data_dictionary.csv: a row a column of these
std::string data_dictionary();        // CSV
std::string raw_readme();             // text for who opens the folder

}  // namespace seldinger::reports

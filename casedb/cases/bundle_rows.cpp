#include "casedb/cases/bundle_rows.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <map>
#include <set>
#include <string_view>

#include "casedb/cases/case_rows.h"
#include "casedb/cases/received.h"
#include "casedb/database/credentials.h"
#include "casedb/database/migrate.h"
#include "casedb/database/question.h"
#include "casedb/database/tables.h"
#include "casedb/database/utf8.h"
#include "casedb/database/uuid.h"
#include "sim/base/check.h"

namespace seldinger::casedb {
namespace {

static_assert(std::endian::native == std::endian::little);  // numbers are copied as they lie

using Kind = Statement::Kind;

// --- writing
void put(std::vector<std::byte>& out, std::span<const std::byte> bytes) {
  const std::size_t at = out.size();
  out.resize(at + bytes.size());
  if (!bytes.empty()) std::memcpy(out.data() + at, bytes.data(), bytes.size());
}
template <typename Number>
void put_number(std::vector<std::byte>& out, Number value) {
  put(out, std::as_bytes(std::span(&value, 1)));
}
void put_text(std::vector<std::byte>& out, std::string_view text) {
  put_number(out, static_cast<std::uint32_t>(text.size()));
  put(out, std::as_bytes(std::span(text)));
}

void put_value(std::vector<std::byte>& out, const Statement& row, const std::string& column) {
  const Kind kind = row.kind(column);
  out.push_back(static_cast<std::byte>(kind));
  if (kind == Kind::integer) put_number(out, row.integer(column));
  if (kind == Kind::real) put_number(out, row.real(column));
  if (kind == Kind::text) put_text(out, row.view(column));
  if (kind == Kind::blob) {
    const std::vector<std::byte> bytes = row.bytes(column);
    put_number(out, static_cast<std::uint32_t>(bytes.size()));
    put(out, bytes);
  }
}

std::string joined(const std::vector<std::string>& words, std::string_view before = {}) {
  std::string text;
  for (const std::string& word : words) {
    if (!text.empty()) text += ", ";
    text += before;
    text += word;
  }
  return text;
}

bool has(const std::vector<std::string>& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

// The rows of one case; columns that refer to what stays are empty. In an order that is always the same.
Statement rows_of(Sqlite& database, const TravellingTable& table, const std::string& case_id) {
  const std::set<std::string> empty = columns_to_staying_tables(database, table.name);
  std::vector<std::string> columns, places;
  for (const std::string& column : columns_of(database, table.name)) {
    columns.push_back(empty.contains(column) ? "NULL AS " + column : column);
    places.push_back(std::to_string(columns.size()));
  }
  Statement rows = database.prepare("SELECT " + joined(columns) + " FROM " + std::string(table.name) + " WHERE " +
                                    std::string(table.of_case) + " ORDER BY " + joined(places));
  rows.bind("case_id", case_id);
  return rows;
}

Statement insertion(Sqlite& database, std::string_view table, const std::vector<std::string>& columns) {
  return database.prepare("INSERT INTO " + std::string(table) + " (" + joined(columns) + ") VALUES (" +
                          joined(columns, ":") + ")");
}

// --- reading
struct Damaged {};

// Takes pieces off the front; throws Damaged where there are too few bytes.
class Pieces {
 public:
  explicit Pieces(std::span<const std::byte> bytes) : rest_(bytes) {}
  std::span<const std::byte> take(std::size_t count) {
    if (count > rest_.size()) throw Damaged();
    const auto taken = rest_.first(count);
    rest_ = rest_.subspan(count);
    return taken;
  }
  template <typename Number>
  Number number() {
    Number value{};
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }
  std::string_view text() {
    const auto bytes = take(number<std::uint32_t>());
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (!is_text(text)) throw Damaged();
    return text;
  }
  bool empty() const noexcept { return rest_.empty(); }

 private:
  std::span<const std::byte> rest_;
};

void bind_value(Statement& to, const std::string& column, Pieces& from) {
  switch (static_cast<Kind>(from.number<std::uint8_t>())) {
    case Kind::null:
      to.bind_null(column);
      return;
    case Kind::integer:
      to.bind(column, from.number<std::int64_t>());
      return;
    case Kind::real:
      to.bind(column, from.number<double>());
      return;
    case Kind::text:
      to.bind(column, from.text());
      return;
    case Kind::blob:
      to.bind(column, from.take(from.number<std::uint32_t>()));
      return;
  }
  throw Damaged();
}

// One table's rows into the database.
void read_table(Pieces& from, Sqlite& database, const std::string& case_id, std::set<std::string_view>& seen) {
  const std::string_view name = from.text();
  const auto known = travelling_tables();
  const auto table = std::ranges::find(known, name, &TravellingTable::name);
  if (table == known.end() || !seen.insert(table->name).second) throw Damaged();
  const std::vector<std::string> there = columns_of(database, name);
  std::vector<std::string> columns(std::min<std::size_t>(from.number<std::uint32_t>(), there.size() + 1));
  if (columns.empty() || columns.size() > there.size()) throw Damaged();
  std::set<std::string> different;
  for (std::string& column : columns) {
    column = from.text();
    if (!has(there, column) || !different.insert(column).second) throw Damaged();
  }
  const std::set<std::string> empty = columns_to_staying_tables(database, name);
  Statement insert = insertion(database, name, columns);
  const auto rows = from.number<std::uint32_t>();
  const bool is_case = table == known.begin();
  for (std::uint32_t row = 0; row < rows; ++row) {
    for (const std::string& column : columns) {
      Pieces value = from;
      bind_value(insert, column, from);
      if (is_case && column == "title" && static_cast<Kind>(value.number<std::uint8_t>()) == Kind::text)
        insert.bind(column, fitted_title(value.text()));
    }
    insert.run();
  }
  // None belongs to another case, or to nobody known here.
  Statement own = database.prepare("SELECT count(*) AS own FROM " + std::string(name) + " WHERE " +
                                   std::string(table->of_case));
  if (!own.bind("case_id", case_id).step() || own.integer("own") != rows) throw Damaged();
}

std::int64_t count_of(Sqlite& database, std::string_view table) {
  return database.integer("SELECT count(*) FROM " + std::string(table));
}

// The case last, in a bundle and in the library: to a published one nothing may be added.
std::vector<TravellingTable> case_last() {
  const auto tables = travelling_tables();
  return {tables.rbegin(), tables.rend()};
}

// The empty schema of each version, made once in a thread: walking the migrations takes longer than most bundles. A
// jail has what its parent had.
Sqlite& empty_of(int version) {
  thread_local std::map<int, std::unique_ptr<Sqlite>> known;
  std::unique_ptr<Sqlite>& empty = known[version];
  if (!empty) {
    auto made = std::make_unique<Sqlite>(":memory:", Sqlite::Mode::create);
    build(*made, library_schema(), version);
    empty = std::move(made);
  }
  return *empty;
}

}  // namespace

std::vector<std::byte> bytes_from_rows(Sqlite& library, const std::string& case_id) {
  std::vector<std::byte> out;
  std::uint32_t tables = 0;
  put_number(out, tables);
  for (const TravellingTable& table : case_last()) {
    const std::vector<std::string> columns = columns_of(library, table.name);
    if (columns.empty()) continue;  // of a later schema
    ++tables;
    put_text(out, table.name);
    put_number(out, static_cast<std::uint32_t>(columns.size()));
    for (const std::string& column : columns) put_text(out, column);
    const std::size_t count_at = out.size();
    std::uint32_t count = 0;
    put_number(out, count);
    for (Statement rows = rows_of(library, table, case_id); rows.step(); ++count)
      for (const std::string& column : columns) put_value(out, rows, column);
    std::memcpy(out.data() + count_at, &count, sizeof count);
  }
  std::memcpy(out.data(), &tables, sizeof tables);
  return out;
}

RowsReader::RowsReader(int version) : empty_(empty_of(version)) {}

base::Result<std::unique_ptr<Sqlite>> RowsReader::read(std::span<const std::byte> bytes,
                                                       const std::string& case_id) {
  const base::Error damaged{"damaged", "the rows of a case in the bundle are damaged"};
  const Schema schema = library_schema();
  auto database = std::make_unique<Sqlite>(":memory:", Sqlite::Mode::create);
  empty_.copy_to(*database);
  try {
    Transaction transaction(*database);
    database->run("PRAGMA defer_foreign_keys = ON");
    Pieces from(bytes);
    std::set<std::string_view> seen;
    for (auto tables = from.number<std::uint32_t>(); tables > 0; --tables)
      read_table(from, *database, case_id, seen);
    if (!from.empty() || count_of(*database, travelling_tables().front().name) != 1) return damaged;
    transaction.commit();
    build(*database, schema, newest_version(schema));
    if (!rows_are_sound(*database, case_id))
      return base::Error{"bundle_values", "a case of the bundle has a value that this program never stores"};
  } catch (const Damaged&) {
    return damaged;
  } catch (const DatabaseFailure& failure) {
    if (failure.kind() == DatabaseFailure::Kind::constraint) return damaged;
    throw;
  }
  return database;
}

std::string mark_of_rows(Sqlite& library, const std::string& case_id) {
  std::vector<std::byte> all;
  for (const TravellingTable& table : travelling_tables()) {
    std::vector<std::string> marked = columns_of(library, table.name);
    std::erase_if(marked, [&](const std::string& column) {
      return std::ranges::find(table.changing, column) != table.changing.end();
    });
    // Marks are kept, in surrogates: where there is nothing in a table that came after them, it is not named. A
    // later travelling table belongs here too.
    const bool came_later = table.name == "case_preparation";
    if (!came_later) put_text(all, table.name);
    if (marked.empty()) continue;  // of a later schema
    bool first = came_later;
    for (Statement row = rows_of(library, table, case_id); row.step(); first = false) {
      if (first) put_text(all, table.name);
      for (const std::string& column : marked) put_value(all, row, column);
    }
  }
  return sha256_hex(all);
}

Presence presence(Sqlite& rows, Sqlite& library, const std::string& case_id) {
  bool first = true;
  for (const TravellingTable& table : travelling_tables()) {
    const std::set<std::string> empty = columns_to_staying_tables(library, table.name);
    std::vector<std::string> compared;
    std::string where;
    for (const std::string& column : columns_of(library, table.name)) {
      if (std::ranges::find(table.changing, column) != table.changing.end() || empty.contains(column)) continue;
      compared.push_back(column);
      where += (where.empty() ? "" : " AND ") + column + " IS :" + column;
    }
    if (first) {  // the case itself
      Statement there = library.prepare("SELECT count(*) AS there FROM " + std::string(table.name) + " WHERE " +
                                        std::string(table.of_case));
      CHECK(there.bind("case_id", case_id).step());
      if (there.integer("there") == 0) return Presence::absent;
      first = false;
    }
    Statement same = library.prepare("SELECT count(*) AS same FROM " + std::string(table.name) + " WHERE " + where);
    for (Statement row = rows_of(rows, table, case_id); row.step(); same.rewind()) {
      for (const std::string& column : compared) same.bind_value(column, row);
      CHECK(same.step());
      if (same.integer("same") == 0) return Presence::different;
    }
  }
  return Presence::same;
}

void insert_rows(Sqlite& rows, Sqlite& library, const std::string& case_id,
                 const std::optional<std::string>& signing_key) {
  CHECK(library.in_transaction());
  const CaseRow sent = read_cases(rows, case_id).at(0);
  // Nobody here has looked yet.
  const std::map<std::string_view, std::optional<std::string>> here = {
      {"state", name_of(arriving(sent.state))},
      {"audience", "everyone"},
      {"face_state", name_of(FaceState::unchecked)},
      {"burned_in_checked_us", std::nullopt}};
  library.run("PRAGMA defer_foreign_keys = ON");  // until the commit: the tables' order is none
  for (const TravellingTable& table : case_last()) {
    const bool is_case = table.name == travelling_tables().front().name;
    const std::vector<std::string> columns = columns_of(library, table.name);
    Statement insert = insertion(library, table.name, columns);
    for (Statement row = rows_of(rows, table, case_id); row.step();) {
      for (const std::string& column : columns)
        if (const auto ours = here.find(column); is_case && ours != here.end())
          insert.bind(column, ours->second);
        else
          insert.bind_value(column, row);
      insert.run();
    }
  }
  question(library, "add_received")
      .bind("case_id", case_id)
      .bind("received_us", now_us())
      .bind("state", name_of(sent.state))
      .bind("face_state", name_of(sent.face_state))
      .bind("burned_in_checked_us",
            sent.burned_in_checked ? std::optional(sent.burned_in_checked->checked_us) : std::nullopt)
      .bind("signing_key", signing_key)
      .run();
}

}  // namespace seldinger::casedb

#include "casedb/cases/preparation.h"

#include <cmath>
#include <cstdio>

#include "casedb/database/sqlite.h"

namespace seldinger::casedb {
namespace {

std::string number_of(const PreparationRow& row, double value) {
  char text[48];
  std::snprintf(text, sizeof text, "%.*f", row.digits, value);
  return text;
}

// With a comma after each, of names that are in the table and of nothing else.
std::string columns(const char* before) {
  std::string all;
  for (const PreparationRow& row : kPreparationRows) all.append(", ").append(before).append(row.name);
  return all;
}

}  // namespace

bool Preparation::changes_volume() const noexcept {
  const Preparation usual;
  return clamp_low_hu != usual.clamp_low_hu || clamp_high_hu != usual.clamp_high_hu || denoise != usual.denoise ||
         shrinks();
}

base::Result<void> check_preparation(const Preparation& preparation) {
  base::Error error{"bad_preparation", "the CT cannot be prepared so"};
  for (const PreparationRow& row : kPreparationRows) {
    const double value = preparation.*row.value;
    const bool within = value >= row.least && value <= row.most;  // false for NaN
    if (!within || (row.digits == 0 && value != std::floor(value)))
      error.findings.push_back(
          {"bad_preparation", std::string(row.option) + " is " + (row.digits == 0 ? "a whole number " : "") +
                                  "from " + number_of(row, row.least) + " to " + number_of(row, row.most)});
  }
  // What is less becomes the lower clamp: with the skin there or below, all of the scan is body.
  if (error.findings.empty() && preparation.skin_hu <= preparation.clamp_low_hu)
    error.findings.push_back({"bad_preparation", "--skin-hu is to be more than --clamp-low"});
  if (!error.findings.empty()) return error;
  return {};
}

std::string text_of(const Preparation& preparation) {
  const Preparation usual;
  std::string text;
  for (const PreparationRow& row : kPreparationRows)
    if (preparation.*row.value != usual.*row.value)
      text += (text.empty() ? "" : ", ") + std::string(row.name) + " " + number_of(row, preparation.*row.value);
  return text;
}

std::optional<StoredPreparation> find_preparation(Sqlite& database, const std::string& case_id) {
  Statement from = database.prepare("SELECT * FROM case_preparation WHERE case_id = :case_id");
  if (!from.bind("case_id", case_id).step()) return std::nullopt;
  StoredPreparation stored;
  stored.original_sha256 = from.text("original_sha256");
  for (const PreparationRow& row : kPreparationRows) stored.settings.*row.value = from.real(row.name);
  return stored;
}

void add_preparation(Sqlite& database, const std::string& case_id, const StoredPreparation& stored) {
  static const std::string kInsert = "INSERT INTO case_preparation (case_id, original_sha256" + columns("") +
                                     ") VALUES (:case_id, :original_sha256" + columns(":") + ")";
  Statement insert = database.prepare(kInsert);
  insert.bind("case_id", case_id).bind("original_sha256", stored.original_sha256);
  for (const PreparationRow& row : kPreparationRows) insert.bind(row.name, stored.settings.*row.value);
  insert.run();
}

}  // namespace seldinger::casedb

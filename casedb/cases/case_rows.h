// A case's rows of any database, and what they must be: one set of rules for what a command stores and for what
// comes in a bundle.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "casedb/cases/authoring.h"
#include "casedb/cases/cases.h"
#include "casedb/database/sqlite.h"

namespace seldinger::casedb {

// The bytes of the file of that SHA-256; as Library::load_asset.
using LoadAsset = std::function<base::Result<std::vector<std::byte>>(const std::string& sha256)>;
LoadAsset asset_loader(const Library& library);  // which outlives it

std::vector<CaseRow> read_cases(Sqlite& database, const std::optional<std::string>& case_id);  // oldest first
std::vector<LesionRow> read_lesions(Sqlite& database, const std::optional<std::string>& case_id);
// Nothing when one of them is not such as the store writes.
std::optional<std::vector<StructureRow>> read_structures(Sqlite& database, const std::string& case_id);

base::Result<std::vector<volume::TissueClass>> load_classes(Sqlite& database, const LoadAsset& load,
                                                            const CaseRow& row);
std::vector<std::string> label_map_names(Sqlite& database, const CaseRow& row);  // the case's own first

// What of a case is its volume: the grid, the extremes, the files made of it.
struct CaseData {
  const volume::Volume& volume;
  std::string volume_sha256, skin_sha256, classes_sha256;
};
std::vector<std::string> data_columns();
void bind_data(Statement& statement, const CaseData& data);

// 1 to 100 bytes on one line, no space at its ends.
bool is_sound_name(const std::string& name);
// As check_case_title takes it: controls and spaces at the ends away, cut to what a title holds. Cases of before
// titles were checked at import have others.
std::string fitted_title(std::string_view title);
// Finite, within the volume, no larger than it, HU that a voxel can hold.
bool is_sound_lesion(const CaseRow& row, const cases::LesionForm& form);
double radius_of(const cases::LesionForm& form);  // of the ball of its volume; an irregular one's: its mean
// One value a voxel, every value with a name.
bool is_sound_label_map(const CaseRow& row, const volume::LabelMap& labels);

// Which classes and labels are in a case's files. Each file is read once, when it is first asked for.
class CaseContents {
 public:
  CaseContents(Sqlite& database, LoadAsset load, const CaseRow& row)
      : database_(database), load_(std::move(load)), row_(row) {}
  base::Result<bool> has(volume::TissueClass tissue);
  base::Result<bool> has(const std::string& labels_sha256, int label);

 private:
  using Present = std::array<bool, 256>;
  Sqlite& database_;
  LoadAsset load_;
  const CaseRow& row_;
  std::optional<Present> classes_;
  std::map<std::string, Present> labels_;
};

// `bad_structure`, `bad_geometry`, and what reading the files refuses.
base::Result<void> check_place(CaseContents& contents, const CaseRow& row, const StructureRow& structure);

// Everything of a case that can be told without its files: every number is finite and within what the commands
// take, every text short and on one line, every id and name of a file of its form.
bool rows_are_sound(Sqlite& database, const std::string& case_id);

}  // namespace seldinger::casedb

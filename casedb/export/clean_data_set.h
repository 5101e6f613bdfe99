// The Basic Profile of DICOM PS3.15 on one data set, through all its sequences.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "casedb/database/credentials.h"
#include "casedb/export/dicom_tree.h"

namespace seldinger::casedb {

// Beyond the table, denied by default: private elements, overlays and curves as whole groups, group lengths,
// elements that the standard's dictionary does not know, persons' names, dates and times that the table does not
// name, UIDs that are not the standard's own, values that do not fit their VR, and text that repeats a name or
// number of the patient.
class DataSetCleaner {
 public:
  explicit DataSetCleaner(const HashKey& key) : key_(key) {}

  void clean(DicomDataSet& data_set);
  std::string new_uid(const std::string& uid) const;  // "2.25.…" (PS3.5 §B.2); the same for the same, "" for ""

  // How often each thing was done: "removed", "emptied", "dummy", "new_uid", "private", "overlay", "unknown",
  // "unfit", "repeats".
  const std::map<std::string, std::int64_t>& counts() const noexcept { return counts_; }

 private:
  enum class Under { table, dummies };  // what else is done to all within a sequence

  void collect_words(const DicomDataSet& data_set);
  void clean(DicomDataSet& data_set, Under under);
  bool keeps(DicomElement& element, Under under);  // false: to be removed
  void keep_unnamed(DicomElement& element);
  void replace_uids(DicomElement& element);
  void make_dummy(DicomElement& element, const std::string& table_vr);
  bool repeats_patient(const std::string& text) const;
  void count(const char* what) { ++counts_[what]; }

  HashKey key_;
  std::vector<std::string> words_;  // of names and numbers of people in this data set, lower case
  std::map<std::string, std::int64_t> counts_;
};

// A value of the VR that says nothing, of a length above zero; every VR of PS3.5 has one.
std::string dummy_value(const std::string& vr);

}  // namespace seldinger::casedb

#include "casedb/export/clean_data_set.h"

#include <algorithm>
#include <span>

#include "casedb/export/uid.h"
#include "casedb/import/privacy/basic_profile.h"
#include "sim/base/ascii.h"

namespace seldinger::casedb {
namespace {

constexpr std::size_t kShortestWord = 4;  // "Lee" would empty every text with "sleeve" in it
constexpr std::size_t kMostWords = 1000;

bool is_private(DicomTag tag) noexcept {
  return (tag >> 16 & 1U) != 0;
}

bool is_overlay_or_curve(DicomTag tag) noexcept {
  const DicomTag block = tag >> 24;
  return block == 0x60 || block == 0x50;
}

bool is_text(const DicomElement& element) {
  static constexpr const char* kTexts[] = {"AE", "CS", "LO", "LT", "SH", "ST", "UC", "UT"};
  return std::any_of(std::begin(kTexts), std::end(kTexts), [&](const char* vr) { return element.is(vr); });
}

bool is_time(const DicomElement& element) {
  return element.is("DA") || element.is("DT") || element.is("TM");
}

// Each value of a text with several keeps to the characters and the length of its VR (PS3.5 §6.2).
bool fits(const DicomElement& element) {
  std::string_view characters;
  std::size_t longest = 0;
  if (element.is("CS")) {
    characters = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789 _";
    longest = 16;
  } else if (element.is("DS")) {
    characters = "0123456789+-eE. ";
    longest = 32;  // many writers put more digits than the 16 of PS3.5
  } else if (element.is("IS")) {
    characters = "0123456789+-. ";
    longest = 12;
  } else {
    return true;
  }
  std::size_t length = 0;
  for (const char c : element.text()) {
    length = c == '\\' ? 0 : length + 1;
    if (length > longest || (c != '\\' && characters.find(c) == std::string_view::npos)) return false;
  }
  return true;
}

bool is_registered_uid(std::string_view uid) {
  return uid.starts_with("1.2.840.10008.");
}

}  // namespace

std::string dummy_value(const std::string& vr) {
  static const std::map<std::string, std::string> kDummies = {
      {"AE", "ANONYMIZED"},
      {"AS", "000Y"},
      {"AT", std::string(4, '\0')},
      {"CS", "ANONYMIZED"},
      {"DA", "19000101"},
      {"DS", "0"},
      {"DT", "19000101000000"},
      {"FD", std::string(8, '\0')},
      {"FL", std::string(4, '\0')},
      {"IS", "0"},
      {"LO", "Anonymized"},
      {"LT", "Anonymized"},
      {"OD", std::string(8, '\0')},
      {"OF", std::string(4, '\0')},
      {"OL", std::string(4, '\0')},
      {"OV", std::string(8, '\0')},
      {"OB", std::string(2, '\0')},
      {"OW", std::string(2, '\0')},
      {"PN", "Anonymized"},
      {"SH", "Anonymized"},
      {"SL", std::string(4, '\0')},
      {"SS", std::string(2, '\0')},
      {"ST", "Anonymized"},
      {"SV", std::string(8, '\0')},
      {"TM", "000000"},
      {"UC", "Anonymized"},
      {"UL", std::string(4, '\0')},
      {"UR", "urn:anonymized"},
      {"US", std::string(2, '\0')},
      {"UT", "Anonymized"},
      {"UV", std::string(8, '\0')},
  };
  const auto found = kDummies.find(vr);
  return found == kDummies.end() ? std::string(2, '\0') : found->second;
}

std::string DataSetCleaner::new_uid(const std::string& uid) const {
  return uid.empty() ? std::string() : uid_of(keyed_hash(key_, uid));
}

void DataSetCleaner::clean(DicomDataSet& data_set) {
  words_.clear();
  collect_words(data_set);
  clean(data_set, Under::table);
}

// Names, and the numbers and institutions that the table replaces: what a technician would type elsewhere once
// more.
void DataSetCleaner::collect_words(const DicomDataSet& data_set) {
  for (const DicomElement& element : data_set) {
    for (const DicomDataSet& item : element.items) collect_words(item);
    const ProfileRow* row = profile_row(element.tag);
    const bool number = element.tag == 0x00100020 || element.tag == 0x00080050 || element.tag == 0x00101000;
    if (!(element.is("PN") || (number && row != nullptr))) continue;
    std::string word;
    for (const char c : element.text() + "^") {
      if (c != '^' && c != '=' && c != '\\' && c != ' ' && c != ',') {
        word += base::lower(c);
        continue;
      }
      if (word.size() >= kShortestWord && words_.size() < kMostWords) words_.push_back(word);
      word.clear();
    }
  }
}

bool DataSetCleaner::repeats_patient(const std::string& text) const {
  const std::string low = base::lower(text);
  return std::any_of(words_.begin(), words_.end(),
                     [&](const std::string& word) { return low.find(word) != std::string::npos; });
}

void DataSetCleaner::clean(DicomDataSet& data_set, Under under) {
  const auto gone = std::remove_if(data_set.begin(), data_set.end(),
                                   [&](DicomElement& element) { return !keeps(element, under); });
  data_set.erase(gone, data_set.end());
}

bool DataSetCleaner::keeps(DicomElement& element, Under under) {
  const auto remove = [&](const char* why) {
    count(why);
    return false;
  };
  if (is_private(element.tag)) return remove("private");
  if ((element.tag & 0xFFFF) == 0) return false;  // group length: no longer true, and retired
  if (is_overlay_or_curve(element.tag)) return remove("overlay");
  const ProfileRow* row = profile_row(element.tag);
  if (row == nullptr) {
    const std::string known = dictionary_vr(element.tag);
    // What should be a sequence and is none could hold one, unread.
    const bool hidden = known == "SQ" && !element.is_sequence && !element.value.empty();
    if (known.empty() || hidden) return remove("unknown");
    if (under == Under::dummies && !element.is_sequence)
      make_dummy(element, {});
    else
      keep_unnamed(element);
    for (DicomDataSet& item : element.items) clean(item, under);
    return true;
  }
  switch (row->action) {
    case ProfileAction::remove:
      return remove("removed");
    case ProfileAction::empty:
      count("emptied");
      if (element.is_sequence)
        element.items.clear();
      else
        element.set(row->vr.empty() ? std::string(element.vr.data(), 2).c_str() : row->vr.c_str(), "");
      return true;
    case ProfileAction::dummy:
      if (element.is_sequence) {
        count("dummy");
        for (DicomDataSet& item : element.items) clean(item, Under::dummies);
      } else if (row->vr == "SQ") {
        return remove("removed");  // not readable as the sequence it should be
      } else {
        make_dummy(element, row->vr);
      }
      return true;
    case ProfileAction::new_uids:
      if (element.is_sequence) {
        count("new_uid");
        for (DicomDataSet& item : element.items) clean(item, under);
      } else if (row->vr == "SQ") {
        return remove("removed");
      } else {
        replace_uids(element);
      }
      return true;
  }
  return false;
}

// Elements that the table does not name.
void DataSetCleaner::keep_unnamed(DicomElement& element) {
  if (element.is_sequence || element.value.empty()) return;
  const std::string vr(element.vr.data(), 2);
  const auto empty = [&](const char* why) {
    count(why);
    element.set(vr.c_str(), "");
  };
  if (element.is("UI")) {
    if (!is_registered_uid(element.text())) replace_uids(element);
  } else if (element.is("PN") || is_time(element) || element.is("UR")) {
    empty("emptied");
  } else if (!fits(element)) {
    empty("unfit");
  } else if (is_text(element) && repeats_patient(element.text())) {
    empty("repeats");
  }
}

void DataSetCleaner::replace_uids(DicomElement& element) {
  count("new_uid");
  const std::string uids = element.text();
  std::string replaced;
  for (std::size_t at = 0; at <= uids.size();) {
    const std::size_t end = std::min(uids.find('\\', at), uids.size());
    std::string one = uids.substr(at, end - at);
    while (!one.empty() && (one.back() == ' ' || one.back() == '\0')) one.pop_back();
    if (at > 0) replaced.push_back('\\');
    replaced.append(new_uid(one));
    at = end + 1;
  }
  element.set("UI", replaced);
}

void DataSetCleaner::make_dummy(DicomElement& element, const std::string& table_vr) {
  count("dummy");
  const std::string vr = table_vr.empty() ? std::string(element.vr.data(), 2) : table_vr;
  if (vr == "UI") return is_registered_uid(element.text()) && table_vr.empty() ? void() : replace_uids(element);
  const bool known = vr[0] != '\0';
  element.set(known ? vr.c_str() : "UN", dummy_value(vr));
}

}  // namespace seldinger::casedb

// The table of settings against what loops over it: every row comes back from the database, is in JSON, has bounds
// that hold, and is frozen with its case. A new row is covered without a line here.
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "casedb/cases/authoring.h"
#include "casedb/cases/setting_table.h"
#include "casedb/database/tables.h"
#include "casedb/json/case_json.h"
#include "tests/casedb/library_samples.h"

namespace seldinger::casedb {
namespace {

// Whether it is the same in both, bit for bit.
bool same(const SettingRow& row, const CaseSetting& a, const CaseSetting& b) {
  return std::visit(OfKind{[&](const ComposedField& one) {
                             switch (one.what) {
                               case Composed::further_modalities:
                                 return a.further_modalities == b.further_modalities;
                               case Composed::gauge:
                                 return a.instrument.radius_mm == b.instrument.radius_mm;
                               case Composed::planned_entry:
                                 return a.planned_entry_lps_mm == b.planned_entry_lps_mm;
                               case Composed::pass_rule:
                                 return a.rule.criteria.size() == b.rule.criteria.size();
                             }
                             return false;
                           },
                           [&](const auto& one) { return one.get(a) == one.get(b); }},
                    row.field);
}

// To another value that is sound beside the rest of a new setting.
void change(const SettingRow& row, CaseSetting& setting) {
  std::visit(
      OfKind{[&](const NumberField& one) {
               const double now = one.get(setting), off = 0.01 * (one.most - one.least);
               one.set(setting, now + off <= one.most ? now + off : now - off);
             },
             [&](const MaybeNumberField& one) { one.set(setting, one.least + 0.3 * (one.most - one.least)); },
             [&](const MaybeWholeField& one) { one.set(setting, one.least + 1); },
             [&](const TextField& one) { one.set(setting, "a word for " + std::string(row.column)); },
             [&](const ChoiceField& one) {
               const std::string_view last = one.names.back();
               ASSERT_TRUE(one.set(setting, last == one.get(setting) ? one.names.front() : last));
             },
             [&](const SwitchField& one) { one.set(setting, !one.get(setting)); },
             [&](const ComposedField& one) {
               if (one.what == Composed::further_modalities)
                 setting.further_modalities = {cases::Modality::ultrasound, cases::Modality::xray};
               if (one.what == Composed::gauge) setting.instrument.radius_mm = 0.635;
               if (one.what == Composed::planned_entry)
                 setting.planned_entry_lps_mm = glm::dvec3(1.0, -2.0, 1.0 / 3.0);
               if (one.what == Composed::pass_rule)
                 setting.rule.criteria = {assessment::criterion_from("hit >= 1").value()};
             }},
      row.field);
}

std::string label(const SettingRow& row) {
  return row.column != nullptr ? row.column : row.json;
}

std::vector<std::string> columns(const SettingRow& row) {
  std::vector<std::string> all;
  if (row.column != nullptr) all.emplace_back(row.column);
  if (const auto* composed = std::get_if<ComposedField>(&row.field))
    all.insert(all.end(), composed->columns.begin(), composed->columns.end());
  return all;
}

class SettingTableTest : public testing::Test {
 protected:
  Library library_ = open_library(fresh_folder() / "library");
  std::string case_id_ = add_case(library_, sample_case());
};

TEST_F(SettingTableTest, EachSettingComesBackAndMovesNoOther) {
  for (const SettingRow& changed : kSettingRows) {
    CaseSetting setting;
    change(changed, setting);
    ASSERT_FALSE(same(changed, setting, CaseSetting{})) << label(changed);
    const auto set = set_setting(library_, case_id_, setting);
    ASSERT_TRUE(set.has_value()) << label(changed) << ": " << set.error().findings.front().text;
    NewCase brought = sample_case();
    static_cast<CaseSetting&>(brought) = setting;
    for (const std::string& id : {case_id_, add_case(library_, brought)}) {
      const CaseRow row = find_case(library_, id).value();
      for (const SettingRow& one : kSettingRows) EXPECT_TRUE(same(one, row, setting)) << label(one);
    }
  }
}

void choose(std::string_view column, std::string_view name, CaseSetting& setting) {
  for (const SettingRow& row : kSettingRows)
    if (row.column != nullptr && row.column == column) {
      ASSERT_TRUE(std::get<ChoiceField>(row.field).set(setting, name));
    }
}

// In the table's order, as the command and the store go through it.
TEST_F(SettingTableTest, AnotherKindOfNeedleComesWithItsTip) {
  CaseSetting setting;
  choose("instrument_kind", "core", setting);
  EXPECT_EQ(setting.touch.tip, cases::NeedleTip::core);
  choose("instrument_tip", "trocar", setting);
  choose("instrument_kind", "core", setting);
  EXPECT_EQ(setting.touch.tip, cases::NeedleTip::trocar) << "the kind is the one that it was";
  ASSERT_TRUE(set_setting(library_, case_id_, setting));
  EXPECT_EQ(find_case(library_, case_id_).value().touch.tip, cases::NeedleTip::trocar) << "its own is kept";
  choose("instrument_kind", "access", setting);
  EXPECT_EQ(setting.touch.tip, cases::NeedleTip::bevel);
}

TEST_F(SettingTableTest, WhatIsOutOfBoundsIsRefusedInTheWordsOfItsRow) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  int tried = 0;
  for (const SettingRow& row : kSettingRows) {
    std::vector<CaseSetting> bad;
    const auto spoil = [&](const auto& one, auto value) {
      bad.emplace_back();
      one.set(bad.back(), value);
    };
    std::visit(
        OfKind{[&](const NumberField& one) {
                 for (const double value : {std::nextafter(one.least, -1e9), std::nextafter(one.most, 1e9), nan})
                   spoil(one, value);
               },
               [&](const MaybeNumberField& one) {
                 for (const double value : {std::nextafter(one.least, -1e9), std::nextafter(one.most, 1e9), nan})
                   spoil(one, value);
               },
               [&](const MaybeWholeField& one) {
                 for (const int value : {one.least - 1, one.most + 1}) spoil(one, value);
               },
               [&](const TextField& one) {
                 for (const char* text : {"two\nlines", "\x7f"}) spoil(one, std::string(text));
                 spoil(one, std::string(kMostSettingText + 1, 'x'));
               },
               [&](const ChoiceField& one) {
                 CaseSetting setting;
                 EXPECT_FALSE(one.set(setting, "another"));
                 EXPECT_TRUE(same(row, setting, CaseSetting{})) << "nothing is changed";
               },
               [](const SwitchField&) {}, [](const ComposedField&) {}},
        row.field);
    for (const CaseSetting& one : bad) {
      const auto set = set_setting(library_, case_id_, one);
      ASSERT_FALSE(set.has_value()) << label(row);
      EXPECT_EQ(set.error().code, "bad_setting");
      ASSERT_NE(row.unsound, nullptr) << label(row);
      EXPECT_EQ(set.error().findings.front().text, row.unsound);
      ++tried;
    }
  }
  EXPECT_GT(tried, 40);
}

TEST_F(SettingTableTest, EachIsInJson) {
  CaseSetting setting;
  setting.instrument.kind = cases::InstrumentKind::core;
  setting.difficulty = Difficulty::hard;
  setting.motion.yields = true;
  setting.clinic.inr = 1.25;
  ASSERT_TRUE(set_setting(library_, case_id_, setting));
  auto json = nlohmann::ordered_json::object();
  add_authoring(load_parts(library_, case_id_).value(), json);
  for (const SettingRow& row : kSettingRows) {
    if (row.json == nullptr) continue;
    EXPECT_TRUE(json.contains(nlohmann::ordered_json::json_pointer("/" + std::string(row.json)))) << row.json;
  }
  EXPECT_EQ(json.at("difficulty"), "hard");
  EXPECT_EQ(json.at("motion").at("tissue"), "yields");
  EXPECT_EQ(json.at("clinic").at("decision"), "proceed");
  EXPECT_EQ(json.at("clinic").at("inr"), 1.25);
  EXPECT_TRUE(json.at("time_limit_s").is_null());
  EXPECT_EQ(
      json.at("instrument").dump(),
      R"({"kind":"core","tip":"bevel","length_mm":200.0,"outer_diameter_mm":0.72,"throw_mm":22.0,"notch_mm":18.0,)"
      R"("dead_tip_mm":4.0})");
  ASSERT_TRUE(set_setting(library_, case_id_, CaseSetting{}));
  json = nlohmann::ordered_json::object();
  add_authoring(load_parts(library_, case_id_).value(), json);
  EXPECT_FALSE(json.at("instrument").contains("throw_mm")) << "an access needle is not fired";
}

// What is no setting; a column that is neither here nor in the table would never be written.
TEST_F(SettingTableTest, EachColumnOfACaseIsDataOrASetting) {
  std::multiset<std::string> expected = {"case_id",
                                         "title",
                                         "state",
                                         "origin",
                                         "created_us",
                                         "hu_min",
                                         "hu_max",
                                         "family_id",
                                         "version",
                                         "slices_used",
                                         "volume_sha256",
                                         "skin_sha256",
                                         "labels_sha256",
                                         "classes_sha256",
                                         "audience",
                                         "face_state",
                                         "burned_in_checked_us",
                                         "burned_in_checked_by",
                                         "burned_in_by_operator"};
  for (const char* axis : {"x", "y", "z"}) {
    expected.insert(std::string("size_") + axis + "_voxels");
    expected.insert(std::string("spacing_") + axis + "_mm");
  }
  for (const char* row : {"0", "1", "2"})
    for (const char* column : {"0", "1", "2", "3"}) expected.insert(std::string("lps_from_voxel_") + row + column);
  for (const SettingRow& row : kSettingRows)
    for (const std::string& column : columns(row)) expected.insert(column);
  const auto all = columns_of(library_.database(), "training_case");
  EXPECT_EQ(std::multiset<std::string>(all.begin(), all.end()), expected);
}

TEST_F(SettingTableTest, AnAttemptFreezesEach) {
  const std::string lesion_id = add_lesion(library_, case_id_, sample_lesion()).value();
  static_cast<void>(add_attempt(library_, sample_attempt(case_id_, lesion_id)).value());
  for (const SettingRow& row : kSettingRows)
    for (const std::string& column : columns(row))
      EXPECT_TRUE(refused_by_constraint([&] {
        library_.database().run("UPDATE training_case SET " + column + " = " + column);
      })) << column
          << ": its migration needs a trigger, as that of 0011_subject.sql";
}

}  // namespace
}  // namespace seldinger::casedb

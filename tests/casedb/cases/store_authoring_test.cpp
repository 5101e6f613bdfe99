// What a mentor makes of a case comes back as it went in, and only a draft is changed.
#include <functional>
#include <limits>

#include "casedb/cases/authoring.h"
#include "casedb/cases/structure_json.h"
#include "casedb/cases/versions.h"
#include "casedb/database/migrate.h"
#include "tests/casedb/cases/authoring_case.h"

namespace seldinger::casedb {
namespace {

TEST_F(AuthoringTest, LesionsOfEveryShapeComeBack) {
  cases::LesionForm form;
  form.outline = cases::LesionOutline::ellipsoid;
  form.center_lps_mm = middle();
  form.radii_mm = {0.5, 0.75, 1.25};
  form.hu = -12.5;
  form.kind = cases::LesionKind::haemangioma;
  form.adds = true;
  form.edge_mm = 0.3;
  static_cast<void>(add_lesion(library_, case_id_, form).value());
  form.outline = cases::LesionOutline::irregular;
  form.radii_mm = glm::dvec3(0.9);
  form.kind = cases::LesionKind::by_hu;
  form.roughness = 0.11;
  form.seed = 0xfedcba9876543210ULL;
  static_cast<void>(add_lesion(library_, case_id_, form).value());
  const auto rows = list_lesions(library_, case_id_);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].form.outline, cases::LesionOutline::ellipsoid);
  EXPECT_TRUE(same_bits(rows[0].form.radii_mm, {0.5, 0.75, 1.25}));
  EXPECT_NEAR(rows[0].lesion.radius_mm, std::cbrt(0.5 * 0.75 * 1.25), 1e-15);
  EXPECT_TRUE(rows[0].form.adds);
  EXPECT_EQ(rows[0].form.kind, cases::LesionKind::haemangioma);
  EXPECT_EQ(rows[0].lesion.kind, cases::LesionKind::haemangioma);
  EXPECT_EQ(rows[1].form.kind, cases::LesionKind::by_hu);
  EXPECT_EQ(rows[0].form.edge_mm, 0.3);
  EXPECT_EQ(rows[1].form.outline, cases::LesionOutline::irregular);
  EXPECT_EQ(rows[1].form.roughness, 0.11);
  EXPECT_EQ(rows[1].form.seed, 0xfedcba9876543210ULL);
  for (const auto& [roughness, edge_mm] : {std::pair{0.4, 0.0}, {-0.1, 0.0}, {0.0, 9.0}, {0.0, -1.0}}) {
    form.roughness = roughness;
    form.edge_mm = edge_mm;
    EXPECT_EQ(code(add_lesion(library_, case_id_, form)), "bad_lesion") << roughness << " " << edge_mm;
  }
  ASSERT_TRUE(remove_lesion(library_, case_id_, rows[0].lesion_id));
  EXPECT_EQ(list_lesions(library_, case_id_).size(), 1U);
  EXPECT_EQ(code(remove_lesion(library_, case_id_, rows[0].lesion_id)), "no_lesion");
}

TEST_F(AuthoringTest, StructuresComeBackInTheirOrder) {
  const cases::Shape shapes[] = {cases::Sphere{middle(), 1.5}, cases::Ellipsoid{middle(), {0.1, 2, 3}},
                                 cases::Tube{{middle(), middle() + glm::dvec3(1.0 / 3.0, 0, 0)}, 0.7}};
  for (std::size_t i = 0; i < std::size(shapes); ++i)
    static_cast<void>(add_structure(library_, drawn("s" + std::to_string(i), shapes[i])).value());
  StructureRow as_ct = drawn("as ct", shapes[0]);
  as_ct.hu.reset();
  static_cast<void>(add_structure(library_, as_ct).value());
  const auto rows = list_structures(library_, case_id_);
  ASSERT_EQ(rows.size(), 4U);
  for (std::size_t i = 0; i < std::size(shapes); ++i) {
    EXPECT_EQ(rows[i].name, "s" + std::to_string(i));
    EXPECT_EQ(json_of_shape(rows[i].drawn), json_of_shape(shapes[i]));
    EXPECT_EQ(rows[i].rule, cases::StructureRule::critical);
    EXPECT_EQ(rows[i].tissue, volume::TissueClass::vessel);
    EXPECT_EQ(rows[i].hu, 43.0);
  }
  EXPECT_TRUE(
      same_bits(std::get<cases::Tube>(rows[2].drawn).points_lps_mm[1], middle() + glm::dvec3(1.0 / 3.0, 0, 0)));
  EXPECT_FALSE(rows[3].hu.has_value());
  EXPECT_EQ(code(add_structure(library_, drawn("s1", shapes[0]))), "name_taken");
  ASSERT_TRUE(remove_structure(library_, case_id_, "s1"));
  EXPECT_EQ(code(remove_structure(library_, case_id_, "s1")), "no_structure");
  EXPECT_EQ(list_structures(library_, case_id_).size(), 3U);
}

TEST_F(AuthoringTest, WhatIsPutInPlaceKeepsItsIdAndItsOrder) {
  std::vector<std::string> ids;
  cases::LesionForm form;
  form.center_lps_mm = middle();
  form.radii_mm = glm::dvec3(0.5);
  for (int i = 0; i < 2; ++i) ids.push_back(add_lesion(library_, case_id_, form).value());
  LesionRow first = list_lesions(library_, case_id_).front();
  const std::string first_id = first.lesion_id;
  first.form.radii_mm = glm::dvec3(0.7);
  ASSERT_TRUE(put_lesion(library_, first));
  EXPECT_EQ(list_lesions(library_, case_id_).front().lesion_id, first_id);
  EXPECT_EQ(list_lesions(library_, case_id_).front().form.radii_mm.x, 0.7);
  ASSERT_TRUE(remove_lesion(library_, case_id_, first_id));
  ASSERT_TRUE(put_lesion(library_, first)) << "it comes back";
  ASSERT_EQ(list_lesions(library_, case_id_).size(), 2U);
  EXPECT_EQ(list_lesions(library_, case_id_).front().lesion_id, first_id);
  first.form.radii_mm = glm::dvec3(0.0);
  EXPECT_EQ(code(put_lesion(library_, first)), "bad_lesion");
  EXPECT_EQ(list_lesions(library_, case_id_).front().form.radii_mm.x, 0.7);

  for (const char* name : {"one", "two", "three"})
    static_cast<void>(add_structure(library_, drawn(name, cases::Sphere{middle(), 1.0})).value());
  StructureRow second = list_structures(library_, case_id_)[1];
  second.name = "another";
  second.drawn = cases::Sphere{middle(), 2.0};
  ASSERT_TRUE(put_structure(library_, second));
  EXPECT_EQ(list_structures(library_, case_id_)[1].name, "another");
  second.name = "three";
  EXPECT_EQ(code(put_structure(library_, second)), "name_taken");
  EXPECT_EQ(list_structures(library_, case_id_)[1].name, "another") << "a refusal changes nothing";
  second.name = "another";
  ASSERT_TRUE(remove_structure(library_, case_id_, "another"));
  ASSERT_TRUE(put_structure(library_, second));
  EXPECT_EQ(list_structures(library_, case_id_)[1].structure_id, second.structure_id);
}

TEST_F(AuthoringTest, StructuresThatAreNotSoundAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(code(add_structure(library_, drawn("", cases::Sphere{middle(), 1.0}))), "bad_structure");
  EXPECT_EQ(code(add_structure(library_, drawn("a\nb", cases::Sphere{middle(), 1.0}))), "bad_structure");
  EXPECT_EQ(code(add_structure(library_, drawn("far", cases::Sphere{{5000, 0, 0}, 1.0}))), "bad_structure");
  for (const double bad : {nan, 0.0, -1.0, 501.0, std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(code(add_structure(library_, drawn("r", cases::Sphere{middle(), bad}))), "bad_geometry") << bad;
    EXPECT_EQ(code(add_structure(library_, drawn("e", cases::Ellipsoid{middle(), {1, bad, 1}}))), "bad_geometry");
  }
  EXPECT_EQ(code(add_structure(library_, drawn("n", cases::Sphere{{nan, 0, 0}, 1.0}))), "bad_geometry");
  EXPECT_EQ(code(add_structure(library_, drawn("t", cases::Tube{{}, 1.0}))), "bad_geometry");
  EXPECT_EQ(code(add_structure(library_, drawn("v", cases::VoxelSet{}))), "bad_geometry");
  StructureRow bright = drawn("b", cases::Sphere{middle(), 1.0});
  bright.hu = 40000.0;
  EXPECT_EQ(code(add_structure(library_, bright)), "bad_structure");
  StructureRow of_class = drawn("c", {});
  of_class.kind = StructureKind::tissue_class;
  of_class.tissue = volume::TissueClass::spleen;  // from labels only
  EXPECT_EQ(code(add_structure(library_, of_class)), "bad_structure");
  StructureRow label = of_class;
  label.kind = StructureKind::label;
  label.label = 1;
  label.labels_sha256 = std::string(64, '0');
  EXPECT_EQ(code(add_structure(library_, label)), "bad_structure");
  EXPECT_TRUE(list_structures(library_, case_id_).empty());
}

TEST_F(AuthoringTest, GeometryThatIsNoneIsRefused) {
  for (const char* text :
       {"", "{", "[]", "null", R"({"kind":"cube"})", R"({"kind":"sphere","center_mm":[0,0],"radius_mm":1})",
        R"({"kind":"sphere","center_mm":[0,0,"x"],"radius_mm":1})", R"({"kind":"sphere","center_mm":[0,0,0]})",
        R"({"kind":"tube","points_mm":7,"radius_mm":1})",
        R"({"kind":"tube","points_mm":[[0,0,1e999]],"radius_mm":1})",
        R"({"kind":"ellipsoid","center_mm":[0,0,0],"radii_mm":[1,2]})"})
    EXPECT_EQ(shape_from_json(text).has_value(), false) << text;
}

TEST_F(AuthoringTest, ALabelMapIsAFileOfTheCase) {
  volume::LabelMap labels;
  labels.names = {"none", "gallbladder", "vein"};
  labels.label.assign(sample_volume().hu.size(), 0);
  labels.label[7] = labels.label[8] = 2;
  const std::string sha256 = add_label_map(library_, case_id_, labels).value();
  EXPECT_EQ(add_label_map(library_, case_id_, labels).value(), sha256) << "twice is once";
  const auto maps = load_label_maps(library_, find_case(library_, case_id_).value()).value();
  ASSERT_EQ(maps.size(), 1U);
  EXPECT_EQ(maps[0].labels.label, labels.label);
  EXPECT_EQ(maps[0].labels.names, labels.names);
  StructureRow row = drawn("vein", {});
  row.kind = StructureKind::label;
  row.labels_sha256 = sha256;
  row.label = 1;
  EXPECT_EQ(code(add_structure(library_, row)), "bad_structure") << "no voxel has it";
  row.label = 2;
  EXPECT_EQ(code(add_structure(library_, row)), "none");
  labels.label.pop_back();
  EXPECT_EQ(code(add_label_map(library_, case_id_, labels)), "bad_labels");
  labels.label.push_back(3);
  EXPECT_EQ(code(add_label_map(library_, case_id_, labels)), "bad_labels");
}

TEST_F(AuthoringTest, ALabelWithATissuesNameIsTheClassOfItsVoxels) {
  const auto classes = [&] { return load_classes(library_, find_case(library_, case_id_).value()).value(); };
  const std::vector<volume::TissueClass> before = classes();
  volume::LabelMap labels;
  labels.names = {"none", "liver", "something else"};
  labels.label.assign(sample_volume().hu.size(), 0);
  labels.label[7] = labels.label[8] = 1;
  labels.label[9] = 2;
  ASSERT_TRUE(add_label_map(library_, case_id_, labels));
  std::vector<volume::TissueClass> wanted = before;
  wanted[7] = wanted[8] = volume::TissueClass::liver;
  EXPECT_EQ(classes(), wanted);
  labels.names = {"none", "vein"};
  labels.label.assign(labels.label.size(), 0);
  labels.label[8] = 1;
  ASSERT_TRUE(add_label_map(library_, case_id_, labels));
  wanted[8] = volume::TissueClass::vessel;
  EXPECT_EQ(classes(), wanted) << "the last one wins";
  // As a map of before schema 48.
  library_.database().run("UPDATE case_label_map SET wins = 0");
  EXPECT_EQ(classes(), before);
}

TEST_F(AuthoringTest, TheSettingComesBack) {
  const CaseSetting setting = full_setting();
  ASSERT_TRUE(set_setting(library_, case_id_, setting));
  const CaseRow row = find_case(library_, case_id_).value();
  EXPECT_EQ(row.modality, setting.modality);
  EXPECT_EQ(row.further_modalities, setting.further_modalities);
  EXPECT_EQ(row.position, setting.position);
  EXPECT_EQ(row.approach, setting.approach);
  EXPECT_TRUE(row.probe_is_chosen);
  EXPECT_EQ(row.touch.tip, setting.touch.tip);
  EXPECT_EQ(row.touch.law, setting.touch.law);
  EXPECT_EQ(row.instrument.kind, setting.instrument.kind);
  for (const auto member :
       {&cases::Instrument::length_mm, &cases::Instrument::radius_mm, &cases::Instrument::inner_radius_mm,
        &cases::Instrument::hu, &cases::Instrument::throw_mm, &cases::Instrument::notch_mm,
        &cases::Instrument::dead_tip_mm})
    EXPECT_EQ(row.instrument.*member, setting.instrument.*member);
  EXPECT_EQ(row.clinic.inr, setting.clinic.inr);
  EXPECT_EQ(row.clinic.platelets_per_nl, setting.clinic.platelets_per_nl);
  EXPECT_EQ(row.clinic.allergy, setting.clinic.allergy);
  EXPECT_EQ(row.clinic.indication, setting.clinic.indication);
  EXPECT_TRUE(row.clinic.defer);
  EXPECT_TRUE(same_bits(*row.planned_entry_lps_mm, *setting.planned_entry_lps_mm));
  EXPECT_EQ(row.difficulty, setting.difficulty);
  EXPECT_EQ(row.time_limit_s, setting.time_limit_s);
  EXPECT_EQ(row.attempt_limit, setting.attempt_limit);
  ASSERT_EQ(row.rule.criteria.size(), 2U);
  EXPECT_EQ(assessment::text_of(row.rule.criteria[0]), "core_in_target >= 10.25");
  EXPECT_EQ(assessment::text_of(row.rule.criteria[1]), "skin_punctures@2 <= 1");
  EXPECT_TRUE(row.rule.criteria[1].critical);
  // A new case may bring its setting along.
  NewCase whole = sample_case();
  static_cast<CaseSetting&>(whole) = setting;
  EXPECT_EQ(find_case(library_, add_case(library_, whole)).value().attempt_limit, 5);
}

TEST_F(AuthoringTest, APhantomHasNothingOfAPatient) {
  CaseSetting setting = full_setting();
  setting.subject = cases::Subject::phantom;
  EXPECT_EQ(code(set_setting(library_, case_id_, setting)), "bad_setting");
  setting.clinic = {{}, {}, "", "find the ball", false};
  ASSERT_TRUE(set_setting(library_, case_id_, setting));
  EXPECT_EQ(find_case(library_, case_id_).value().subject, cases::Subject::phantom);
  for (const auto& spoil : std::vector<void (*)(CaseSetting&)>{
           [](CaseSetting& s) { s.clinic.inr = 1.0; }, [](CaseSetting& s) { s.clinic.platelets_per_nl = 200.0; },
           [](CaseSetting& s) { s.clinic.allergy = "latex"; }, [](CaseSetting& s) { s.clinic.defer = true; },
           [](CaseSetting& s) { s.motion.breath_depth = 1.0; }}) {
    CaseSetting bad = setting;
    spoil(bad);
    EXPECT_EQ(code(set_setting(library_, case_id_, bad)), "bad_setting");
  }
  const std::string lesion_id = add_lesion(library_, case_id_, sample_lesion()).value();
  static_cast<void>(add_attempt(library_, sample_attempt(case_id_, lesion_id)).value());
  refuse("UPDATE training_case SET subject = 'patient'");
  refuse("UPDATE training_case SET probe_is_chosen = 0");
}

// Schema 39 takes a library whose cases breathe by the law of before: those that are published or attempted move as
// they did, bit for bit; a draft and a new version move as far down by the newest law.
TEST_F(AuthoringTest, WhoBreathedBeforeTheNewestLawMovesAsBefore) {
  add_users();
  const std::string draft = add_case(library_, sample_case()), attempted = add_case(library_, sample_case()),
                    published = add_case(library_, sample_case());
  const std::string lesion_id = add_lesion(library_, attempted, sample_lesion()).value();
  static_cast<void>(add_attempt(library_, sample_attempt(attempted, lesion_id)).value());
  for (const char* earlier :
       {"DROP TRIGGER training_case_keeps_its_motion", "ALTER TABLE training_case DROP COLUMN breath_law",
        "ALTER TABLE training_case DROP COLUMN ct_breath", "ALTER TABLE training_case DROP COLUMN breath_depth",
        "ALTER TABLE training_case ADD COLUMN breath_depth REAL NOT NULL DEFAULT 0.3 CHECK (breath_depth BETWEEN 0 "
        "AND 2)",
        "CREATE TRIGGER training_case_keeps_its_motion BEFORE UPDATE OF breath_depth ON training_case WHEN "
        "OLD.state "
        "<> 'draft' BEGIN SELECT RAISE(ABORT, 'kept'); END"})
    library_.database().run(earlier);
  library_.database().run("UPDATE training_case SET state = 'published' WHERE case_id = '" + published + "'");
  for (const std::size_t step : {38U, 45U})
    library_.database().run(std::string(library_schema().steps[step].content));

  const auto breathing_of = [&](const std::string& case_id) {
    return find_case(library_, case_id).value().motion.breathing().value();
  };
  for (const std::string& case_id : {published, attempted}) {
    cases::Breathing before;  // what the program of then made of it
    before.amplitude_mm = 0.3 * glm::dvec3(2.0, 15.0, 16.0);
    EXPECT_EQ(breathing_of(case_id), before);
  }
  const std::string next = new_version(library_, published, "ann").value();
  for (const std::string& case_id : {draft, next}) {
    const cases::Breathing now = breathing_of(case_id);
    EXPECT_NEAR(now.amplitude_mm.z, 0.3 * 16.0, 1e-12);
    EXPECT_NEAR(now.amplitude_mm.y, 0.3 * 16.0 * 5.0 / 12.0, 1e-12);
    EXPECT_NEAR(now.hold_spread * now.amplitude_mm.z, cases::breath::kHoldSpreadMm, 1e-12);
    EXPECT_EQ(now.hold_level, 0.0);
    EXPECT_TRUE(now.slides);
  }
  // What follows by the newest law keeps its depth, and a CT that was taken in inspiration is where breath is held.
  CaseSetting setting = find_case(library_, next).value();
  setting.motion.breath_depth = cases::breath::kDeepest;
  setting.motion.ct_breath = cases::CtBreath::inspiration;
  ASSERT_TRUE(set_setting(library_, next, setting));
  const cases::Breathing deep = breathing_of(new_version(library_, next, "ann").value());
  EXPECT_EQ(deep.amplitude_mm, cases::breath::kDeepest * cases::breath::kQuietMm);
  EXPECT_EQ(deep.ct_level, 1.0);
  EXPECT_EQ(deep.hold_level, 1.0);
  setting.motion.breath_depth = 3.1;
  EXPECT_EQ(code(set_setting(library_, next, setting)), "bad_setting");
}

// Schema 42 and that of organs that move: what is published or attempted feels as it did, a draft and a new version
// by the newest law.
TEST_F(AuthoringTest, WhatWasFeltBeforeTheNewestLawIsFeltAsBefore) {
  add_users();
  const std::string draft = add_case(library_, sample_case()), attempted = add_case(library_, sample_case()),
                    published = add_case(library_, sample_case());
  EXPECT_EQ(find_case(library_, draft).value().touch.law, cases::kNewestTouchLaw) << "of a new case";
  const std::string lesion_id = add_lesion(library_, attempted, sample_lesion()).value();
  static_cast<void>(add_attempt(library_, sample_attempt(attempted, lesion_id)).value());
  for (const char* earlier :
       {"DROP TRIGGER training_case_keeps_its_touch", "ALTER TABLE training_case DROP COLUMN instrument_tip",
        "ALTER TABLE training_case DROP COLUMN touch_law"})
    library_.database().run(earlier);
  library_.database().run("UPDATE training_case SET state = 'published' WHERE case_id = '" + published + "'");
  for (const std::size_t step : {41U, 43U})
    library_.database().run(std::string(library_schema().steps[step].content));

  const auto touch_of = [&](const std::string& case_id) { return find_case(library_, case_id).value().touch; };
  for (const std::string& case_id : {published, attempted}) {
    EXPECT_EQ(touch_of(case_id).law, cases::TouchLaw::steady);
    EXPECT_EQ(touch_of(case_id).tip, cases::NeedleTip::bevel);
    refuse("UPDATE training_case SET touch_law = 'by_speed' WHERE case_id = '" + case_id + "'");
    refuse("UPDATE training_case SET instrument_tip = 'core' WHERE case_id = '" + case_id + "'");
  }
  EXPECT_EQ(touch_of(draft).law, cases::kNewestTouchLaw);
  const std::string next = new_version(library_, published, "ann").value();
  EXPECT_EQ(touch_of(next).law, cases::kNewestTouchLaw);
  CaseSetting setting = find_case(library_, next).value();
  setting.touch.tip = cases::NeedleTip::trocar;
  ASSERT_TRUE(set_setting(library_, next, setting));
  EXPECT_EQ(touch_of(new_version(library_, next, "ann").value()).tip, cases::NeedleTip::trocar);
}

TEST_F(AuthoringTest, SettingsThatAreNotSoundAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<CaseSetting> bad(13, full_setting());
  bad[0].instrument.length_mm = 5.0;
  bad[1].instrument.radius_mm = nan;
  bad[2].instrument.inner_radius_mm = 1.0;
  bad[3].instrument.notch_mm = 19.0;  // with the dead tip beyond the throw
  bad[4].further_modalities = {cases::Modality::ultrasound};
  bad[5].clinic.inr = nan;
  bad[6].clinic.platelets_per_nl = -1.0;
  bad[7].clinic.allergy = "two\nlines";
  bad[8].clinic.indication = std::string(201, 'x');
  bad[9].planned_entry_lps_mm = glm::dvec3(nan);
  bad[10].time_limit_s = 0.0;
  bad[11].attempt_limit = 0;
  bad[12].instrument.throw_mm = nan;
  for (std::size_t i = 0; i < bad.size(); ++i)
    EXPECT_EQ(code(set_setting(library_, case_id_, bad[i])), "bad_setting") << i;
  EXPECT_EQ(find_case(library_, case_id_).value().modality, cases::Modality::mpr);
}

TEST_F(AuthoringTest, AnAttemptFreezesWhatItWasMadeOn) {
  static_cast<void>(add_structure(library_, drawn("vein", cases::Sphere{middle(), 1.0})).value());
  const std::string lesion_id = add_lesion(library_, case_id_, sample_lesion()).value();
  static_cast<void>(add_attempt(library_, sample_attempt(case_id_, lesion_id)).value());
  EXPECT_EQ(code(set_setting(library_, case_id_, full_setting())), "has_attempts");
  EXPECT_EQ(code(add_structure(library_, drawn("b", cases::Sphere{middle(), 1.0}))), "has_attempts");
  EXPECT_EQ(code(remove_structure(library_, case_id_, "vein")), "has_attempts");
  EXPECT_EQ(code(remove_lesion(library_, case_id_, lesion_id)), "has_attempts");
  EXPECT_EQ(code(put_lesion(library_, list_lesions(library_, case_id_).front())), "has_attempts");
  EXPECT_EQ(code(put_structure(library_, list_structures(library_, case_id_).front())), "has_attempts");
  refuse("UPDATE training_case SET pass_rule = '{}'");
  refuse("UPDATE structure SET hu = 1");
  refuse("DELETE FROM structure");
  EXPECT_EQ(code(add_lesion(library_, case_id_, sample_lesion())), "none") << "another target changes none";
}

}  // namespace
}  // namespace seldinger::casedb

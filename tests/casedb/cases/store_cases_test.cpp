// Cases and lesions: what goes in comes back, oldest first, and what is not sound is refused.
#include <cmath>
#include <limits>

#include "casedb/database/audit.h"
#include "casedb/people/people.h"
#include "sim/volume/tissue/find_tissue.h"
#include "tests/casedb/library_samples.h"

namespace seldinger::casedb {
namespace {

class StoreCasesTest : public testing::Test {
 protected:
  std::filesystem::path folder_ = fresh_folder() / "library";
  Library library_ = open_library(folder_);
};

TEST_F(StoreCasesTest, KeepsWhatItIsPractisedWithAndHowThePatientLies) {
  EXPECT_EQ(find_case(library_, add_case(library_, sample_case())).value().modality, cases::Modality::mpr);
  NewCase prone = sample_case();
  prone.modality = cases::Modality::xray;
  prone.position = cases::PatientPosition::prone;
  const std::string case_id = add_case(library_, prone);
  const CaseRow row = find_case(library_, case_id).value();
  EXPECT_EQ(row.modality, cases::Modality::xray);
  EXPECT_EQ(row.position, cases::PatientPosition::prone);
  // A draft's guidance may change until the first attempt.
  static_cast<void>(
      add_attempt(library_, sample_attempt(case_id, add_lesion(library_, case_id, sample_lesion()).value()))
          .value());
  for (const char* change : {"modality = 'mpr'", "patient_position = 'supine'"})
    EXPECT_TRUE(refused_by_constraint([&] {
      library_.database().run(std::string("UPDATE training_case SET ") + change);
    })) << change;
}

TEST_F(StoreCasesTest, KeepsWhatIsKnownOfThePrivacyOfItsSource) {
  const CaseRow plain = find_case(library_, add_case(library_, sample_case())).value();
  EXPECT_EQ(plain.face_state, FaceState::unchecked);
  EXPECT_FALSE(plain.burned_in_checked.has_value());
  EXPECT_TRUE(plain.dropped.empty());
  NewCase checked = sample_case();
  checked.face_state = FaceState::cropped;
  checked.no_burned_in_text = true;
  checked.dropped = {{"0009,xxxx", "", "private", 12}, {"0010,0010", "PatientName", "not_on_the_list", 3}};
  const CaseRow row = find_case(library_, add_case(library_, checked)).value();
  EXPECT_EQ(row.face_state, FaceState::cropped);
  ASSERT_TRUE(row.burned_in_checked.has_value());
  EXPECT_EQ(row.burned_in_checked->checked_us, row.created_us);
  EXPECT_FALSE(row.burned_in_checked->person_id.has_value());
  ASSERT_EQ(row.dropped.size(), 2U);
  EXPECT_EQ(row.dropped[1].tag, "0010,0010");
  EXPECT_EQ(row.dropped[1].keyword, "PatientName");
  EXPECT_EQ(row.dropped[1].reason, "not_on_the_list");
  EXPECT_EQ(row.dropped[0].count, 12);
  for (const FaceState state : {FaceState::unchecked, FaceState::none, FaceState::cropped, FaceState::defaced})
    EXPECT_EQ(face_state_from(name_of(state)), state);
  EXPECT_FALSE(face_state_from("face").has_value());
}

TEST_F(StoreCasesTest, WhyAFaceWasOverruledIsKeptWithTheCaseAndThatInTheLog) {
  NewCase overruled = sample_case();
  overruled.face_state = FaceState::none;
  overruled.warnings = {{"single_slice", "the case is one slice"}};
  overruled.face_overruled = "both knees";
  const std::string case_id = add_case(library_, overruled);
  const CaseRow row = find_case(library_, case_id).value();
  EXPECT_EQ(row.face_state, FaceState::none);
  ASSERT_EQ(row.warnings.size(), overruled.warnings.size() + 1);
  EXPECT_EQ(row.warnings.back().code, "face_overruled");
  EXPECT_EQ(row.warnings.back().text, "both knees");
  const AuditRow last = list_audit(library_).back();
  EXPECT_EQ(last.act, "overrule_face");
  EXPECT_EQ(last.object_id, case_id);
  add_case(library_, sample_case());
  EXPECT_EQ(list_audit(library_).back().act, "add_case");
}

TEST_F(StoreCasesTest, NoBurnedInTextIsConfirmedOnceByAPersonOrNobodyKnown) {
  const std::string person = add_user(library_, "ada", Role::mentor, "a long password").value();
  const std::string case_id = add_case(library_, sample_case());
  EXPECT_EQ(confirm_no_burned_in_text(library_, "nothing", person).error().code, "no_case");
  EXPECT_EQ(confirm_no_burned_in_text(library_, case_id, std::string("nobody")).error().code, "no_person");
  EXPECT_FALSE(find_case(library_, case_id).value().burned_in_checked.has_value());
  ASSERT_TRUE(confirm_no_burned_in_text(library_, case_id, person));
  const BurnedInCheck first = find_case(library_, case_id).value().burned_in_checked.value();
  EXPECT_EQ(first.person_id, person);
  EXPECT_GT(first.checked_us, 1'600'000'000'000'000);
  ASSERT_TRUE(confirm_no_burned_in_text(library_, case_id, std::nullopt));
  const BurnedInCheck still = find_case(library_, case_id).value().burned_in_checked.value();
  EXPECT_EQ(still.checked_us, first.checked_us);
  EXPECT_EQ(still.person_id, person);
  for (const char* change :
       {"UPDATE training_case SET burned_in_checked_us = 1", "UPDATE training_case SET face_state = 'none'",
        "INSERT INTO case_dropped SELECT case_id, 0, '0010,0010', '', 'a reason', 1 FROM training_case",
        "INSERT INTO case_dropped SELECT case_id, 0, '0010,0010', '', 'private', 0 FROM training_case"})
    EXPECT_TRUE(refused_by_constraint([&] { library_.database().run(change); })) << change;
}

TEST_F(StoreCasesTest, NamesOfModalitiesAndPositionsComeBack) {
  for (const auto modality : {cases::Modality::mpr, cases::Modality::xray, cases::Modality::ultrasound}) {
    EXPECT_EQ(modality_from(name_of(modality)), modality);
    EXPECT_NE(modality_names().find(name_of(modality)), std::string::npos);
    NewCase one = sample_case();
    one.modality = modality;
    EXPECT_EQ(find_case(library_, add_case(library_, one)).value().modality, modality);
  }
  EXPECT_EQ(modality_names(), "mpr, xray or ultrasound");
  for (const auto position : {cases::PatientPosition::supine, cases::PatientPosition::prone,
                              cases::PatientPosition::lateral_left, cases::PatientPosition::lateral_right})
    EXPECT_EQ(position_from(name_of(position)), position);
  EXPECT_FALSE(modality_from("XRAY").has_value());
  EXPECT_FALSE(position_from("").has_value());
}

TEST_F(StoreCasesTest, ACaseComesBackAsItWentIn) {
  const NewCase sample = sample_case();
  const std::string case_id = add_case(library_, sample);
  const CaseRow row = find_case(library_, case_id).value();
  EXPECT_EQ(row.case_id, case_id);
  EXPECT_EQ(row.title, sample.title);
  EXPECT_EQ(row.state, CaseState::draft);
  EXPECT_EQ(row.origin, "import");
  EXPECT_GT(row.created_us, 1'600'000'000'000'000);
  EXPECT_EQ(row.size_voxels, sample.volume.size_voxels);
  EXPECT_EQ(row.spacing_mm, sample.volume.spacing_mm);
  EXPECT_EQ(row.lps_from_voxel, sample.volume.lps_from_voxel);  // left-handed
  EXPECT_EQ(row.hu_min, *std::min_element(sample.volume.hu.begin(), sample.volume.hu.end()));
  EXPECT_EQ(row.hu_max, *std::max_element(sample.volume.hu.begin(), sample.volume.hu.end()));
  EXPECT_EQ(row.slices_used, 5);
  EXPECT_EQ(row.attributes, sample.attributes);
  ASSERT_EQ(row.warnings.size(), 2U);
  EXPECT_EQ(row.warnings[1].code, "spacing");
  EXPECT_EQ(row.warnings[1].text, sample.warnings[1].text);
  EXPECT_TRUE(row.labels_sha256.empty());
}

TEST_F(StoreCasesTest, VolumeSkinAndLabelsComeBackBitForBit) {
  NewCase sample = sample_case();
  sample.origin = "phantom:1";
  sample.labels.emplace();
  sample.labels->names = {"none", "kidney", "Rippe é"};
  for (std::size_t i = 0; i < sample.volume.hu.size(); ++i)
    sample.labels->label.push_back(static_cast<std::uint8_t>(i % 3));
  const std::string case_id = add_case(library_, sample);
  Library again = open_library(folder_);  // as another process sees it
  const CaseRow row = find_case(again, case_id).value();

  const volume::Volume volume = load_volume(again, row).value();
  EXPECT_EQ(volume.size_voxels, sample.volume.size_voxels);
  EXPECT_EQ(volume.spacing_mm, sample.volume.spacing_mm);
  EXPECT_EQ(volume.hu, sample.volume.hu);
  for (int column = 0; column < 4; ++column)
    for (int axis = 0; axis < 4; ++axis)
      EXPECT_TRUE(same_bits(volume.lps_from_voxel[column][axis], sample.volume.lps_from_voxel[column][axis]));

  const cases::Mesh skin = load_skin(again, row).value();
  EXPECT_EQ(skin.vertices_lps_mm, sample.skin.vertices_lps_mm);
  EXPECT_EQ(skin.triangles, sample.skin.triangles);
  EXPECT_EQ(skin.cut, sample.skin.cut);

  const volume::LabelMap labels = load_labels(again, row).value();
  EXPECT_EQ(labels.label, sample.labels->label);
  EXPECT_EQ(labels.names, sample.labels->names);
}

TEST_F(StoreCasesTest, TissueClassesAreComputedOnceAndStored) {
  NewCase sample = sample_case();
  sample.volume.hu.assign(sample.volume.hu.size(), 50);
  const std::string plain = add_case(library_, sample);
  sample.labels.emplace();
  sample.labels->names = {"none", "kidney", "Rippe"};
  for (std::size_t i = 0; i < sample.volume.hu.size(); ++i)
    sample.labels->label.push_back(static_cast<std::uint8_t>(i % 3));
  const std::string labelled = add_case(library_, sample);

  Library again = open_library(folder_);
  EXPECT_EQ(load_classes(again, find_case(again, plain).value()).value(),
            std::vector<volume::TissueClass>(sample.volume.hu.size(), volume::TissueClass::soft_tissue));
  const auto classes = load_classes(again, find_case(again, labelled).value()).value();
  ASSERT_EQ(classes.size(), sample.volume.hu.size());
  for (std::size_t i = 0; i < classes.size(); ++i)
    EXPECT_EQ(classes[i], i % 3 == 1 ? volume::TissueClass::kidney : volume::TissueClass::soft_tissue) << i;
  EXPECT_TRUE(refused_by_constraint(
      [&] { library_.database().run("UPDATE training_case SET classes_sha256 = skin_sha256"); }));
}

TEST_F(StoreCasesTest, ACaseFromBeforeTheClassesGetsThoseOfRule1) {
  const std::filesystem::path folder = folder_.parent_path() / "old";
  NewCase sample = sample_case();
  sample.labels.emplace();
  sample.labels->names = {"none", "liver"};
  sample.labels->label.assign(sample.volume.hu.size(), 0);
  sample.labels->label[100] = 1;
  std::vector<volume::TissueClass> stored;
  std::string case_id;
  {
    Library library = open_library(folder);
    case_id = add_case(library, sample);
    stored = load_classes(library, find_case(library, case_id).value()).value();
    library.database().run(
        "DROP TRIGGER training_case_keeps_its_classes; UPDATE training_case SET classes_sha256 = NULL");
  }
  EXPECT_EQ(stored[100], volume::TissueClass::liver);
  Library library = open_library(folder);
  const CaseRow row = find_case(library, case_id).value();
  EXPECT_TRUE(row.classes_sha256.empty());
  const auto loaded = load_classes(library, row).value();
  EXPECT_EQ(loaded, volume::tissue_classes_by_rule_1(sample.volume, &*sample.labels));
  EXPECT_EQ(loaded[100], volume::TissueClass::liver);
  CaseRow plain = row;
  plain.labels_sha256.clear();
  EXPECT_NE(load_classes(library, plain).value(), loaded) << "labels were asked";
}

TEST_F(StoreCasesTest, DamagedClassesAreRefused) {
  const CaseRow row = find_case(library_, add_case(library_, sample_case())).value();
  CaseRow other = row;
  other.classes_sha256 = row.skin_sha256;
  EXPECT_EQ(load_classes(library_, other).error().code, "damaged");
  other = row;
  other.size_voxels.z += 1;
  EXPECT_EQ(load_classes(library_, other).error().code, "damaged");
  library_.remove_asset(row.classes_sha256);
  EXPECT_EQ(load_classes(library_, row).error().code, "asset_missing");
}

TEST_F(StoreCasesTest, CasesAreListedOldestFirstWithTheirOwnAttributes) {
  std::vector<std::string> ids;
  for (int i = 0; i < 30; ++i) {
    NewCase sample = sample_case("Case " + std::to_string(i));
    sample.attributes = {{"kvp", std::to_string(i)}};
    sample.warnings.clear();
    ids.push_back(add_case(library_, sample));
  }
  const auto rows = list_cases(library_);
  ASSERT_EQ(rows.size(), ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    EXPECT_EQ(rows[i].case_id, ids[i]);
    ASSERT_EQ(rows[i].attributes.size(), 1U);
    EXPECT_EQ(rows[i].attributes[0].second, std::to_string(i));
    EXPECT_TRUE(rows[i].warnings.empty());
  }
}

TEST_F(StoreCasesTest, HeadsAreTheSameCasesWithoutTheirParts) {
  for (const char* title : {"A", "B"}) {
    NewCase sample = sample_case(title);
    sample.attributes = {{"kvp", "120"}};
    add_case(library_, sample);
  }
  const auto heads = list_case_heads(library_), whole = list_cases(library_);
  ASSERT_EQ(heads.size(), 2U);
  for (std::size_t at = 0; at < 2; ++at) {
    EXPECT_EQ(heads[at].case_id, whole[at].case_id);
    EXPECT_EQ(heads[at].title, whole[at].title);
    EXPECT_EQ(heads[at].volume_sha256, whole[at].volume_sha256);
    EXPECT_TRUE(heads[at].attributes.empty() && heads[at].warnings.empty());
    EXPECT_FALSE(whole[at].attributes.empty());
  }
}

TEST_F(StoreCasesTest, CasesOfTheSameVolumeShareItsFile) {
  add_case(library_, sample_case("A"));
  add_case(library_, sample_case("B"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_ / "assets"), {}),
            3);  // volume, skin, classes
}

TEST_F(StoreCasesTest, AnUnknownCaseIsRefused) {
  for (const std::string id : {"", "x", "' OR 1=1 --", "00000000-0000-7000-8000-000000000000"}) {
    EXPECT_EQ(find_case(library_, id).error().code, "no_case");
    EXPECT_EQ(add_lesion(library_, id, sample_lesion()).error().code, "no_case");
  }
  EXPECT_TRUE(list_cases(library_).empty());
}

TEST_F(StoreCasesTest, WithoutLabelsThereAreNone) {
  const std::string case_id = add_case(library_, sample_case());
  EXPECT_EQ(load_labels(library_, find_case(library_, case_id).value()).error().code, "no_labels");
}

TEST_F(StoreCasesTest, MissingAndDamagedFilesAreRefused) {
  const CaseRow row = find_case(library_, add_case(library_, sample_case())).value();
  std::filesystem::resize_file(folder_ / "assets" / row.volume_sha256, 100);
  EXPECT_EQ(load_volume(library_, row).error().code, "asset_damaged");
  library_.remove_asset(row.skin_sha256);
  EXPECT_EQ(load_skin(library_, row).error().code, "asset_missing");
}

TEST_F(StoreCasesTest, AFailedCaseLeavesNoFileButThoseOfOthers) {
  const std::string case_id = add_case(library_, sample_case());
  NewCase twice = sample_case();
  twice.skin.cut = {0, 0, 0, 0};                    // another file
  twice.attributes = {{"kvp", "1"}, {"kvp", "2"}};  // refused by the database
  EXPECT_TRUE(refused_by_constraint([&] { add_case(library_, twice); }));
  EXPECT_EQ(list_cases(library_).size(), 1U);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_ / "assets"), {}), 3);
  const CaseRow row = find_case(library_, case_id).value();
  EXPECT_TRUE(load_volume(library_, row).has_value());
  EXPECT_TRUE(load_skin(library_, row).has_value());
}

TEST_F(StoreCasesTest, LesionsComeBackBitForBitOldestFirst) {
  const std::string case_id = add_case(library_, sample_case());
  const std::string other = add_case(library_, sample_case());
  std::vector<std::string> ids;
  for (int i = 0; i < 20; ++i) {
    cases::Lesion lesion = sample_lesion();
    lesion.radius_mm += 0.1 * i;
    ids.push_back(add_lesion(library_, case_id, lesion).value());
  }
  static_cast<void>(add_lesion(library_, other, sample_lesion()).value());
  const auto rows = list_lesions(library_, case_id);
  ASSERT_EQ(rows.size(), ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    EXPECT_EQ(rows[i].lesion_id, ids[i]);
    EXPECT_EQ(rows[i].case_id, case_id);
    EXPECT_TRUE(same_bits(rows[i].lesion.center_lps_mm, sample_lesion().center_lps_mm));
    EXPECT_TRUE(same_bits(rows[i].lesion.radius_mm, sample_lesion().radius_mm + 0.1 * static_cast<double>(i)));
    EXPECT_TRUE(same_bits(rows[i].lesion.hu, 20.5));
  }
  EXPECT_TRUE(list_lesions(library_, "nobody").empty());
}

TEST_F(StoreCasesTest, LesionsThatAreNotSoundAreRefused) {
  const std::string case_id = add_case(library_, sample_case());
  const cases::Lesion good = sample_lesion();
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  std::vector<cases::Lesion> bad;
  for (const double radius_mm : {0.0, -1.0, nan, infinite, 1e6}) {
    bad.push_back(good);
    bad.back().radius_mm = radius_mm;
  }
  for (const double hu : {nan, infinite, -infinite, -1025.0, 40000.0}) {
    bad.push_back(good);
    bad.back().hu = hu;
  }
  for (int axis = 0; axis < 3; ++axis)
    for (const double coordinate_mm : {nan, infinite, 1000.0, 1e300}) {
      bad.push_back(good);
      bad.back().center_lps_mm[axis] = coordinate_mm;
    }
  for (std::size_t i = 0; i < bad.size(); ++i) {
    const auto refused = add_lesion(library_, case_id, bad[i]);
    ASSERT_FALSE(refused.has_value()) << "lesion " << i;
    EXPECT_EQ(refused.error().code, "bad_lesion");
  }
  EXPECT_TRUE(list_lesions(library_, case_id).empty());
}

TEST_F(StoreCasesTest, ALesionMayLieUpToTheOuterFacesOfTheVolume) {
  const std::string case_id = add_case(library_, sample_case());
  const glm::dmat4 lps_from_voxel = sample_volume().lps_from_voxel;  // 9 × 7 × 5 voxels
  const auto code_at = [&](double i, double j, double k) {
    cases::Lesion lesion = sample_lesion();
    lesion.center_lps_mm = glm::dvec3(lps_from_voxel * glm::dvec4(i, j, k, 1.0));
    const auto added = add_lesion(library_, case_id, lesion);
    return added ? std::string("none") : added.error().code;
  };
  EXPECT_EQ(code_at(-0.49, 3, 2), "none");
  EXPECT_EQ(code_at(8.49, 6.49, 4.49), "none");
  EXPECT_EQ(code_at(-0.51, 3, 2), "bad_lesion");
  EXPECT_EQ(code_at(4, 6.51, 2), "bad_lesion");
  EXPECT_EQ(code_at(4, 3, 4.51), "bad_lesion");
}

// The names of states against the words that the schema's own constraints list.
TEST_F(StoreCasesTest, StatesHaveTheNamesThatTheSchemaTakes) {
  const auto constraint_of = [&](const char* table) {
    const std::string sql =
        library_.database().text(std::string("SELECT sql FROM sqlite_schema WHERE name = '") + table + "'");
    const std::size_t at = sql.find("CHECK (state IN (");
    return at == sql.npos ? "none" : sql.substr(at, sql.find("))", at) - at);
  };
  std::string cases = "CHECK (state IN (", curricula = cases;
  for (const CaseState state : {CaseState::draft, CaseState::review, CaseState::published, CaseState::retired}) {
    cases += (state == CaseState::draft ? "'" : ", '") + name_of(state) + "'";
    EXPECT_EQ(case_state_from(name_of(state)), state);
  }
  for (const CurriculumState state :
       {CurriculumState::draft, CurriculumState::published, CurriculumState::retired}) {
    curricula += (state == CurriculumState::draft ? "'" : ", '") + name_of(state) + "'";
    EXPECT_EQ(curriculum_state_from(name_of(state)), state);
  }
  EXPECT_EQ(constraint_of("training_case"), cases);
  EXPECT_EQ(constraint_of("curriculum"), curricula);
  EXPECT_EQ(case_state_from("Draft"), std::nullopt);
  EXPECT_EQ(case_state_from(""), std::nullopt);
  EXPECT_EQ(curriculum_state_from("review"), std::nullopt) << "curricula are not reviewed";
}

}  // namespace
}  // namespace seldinger::casedb

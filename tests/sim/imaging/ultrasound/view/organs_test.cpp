// Organs and layers on the screen: told from class and place in the built-in torso, and their levels in pictures.
#include "sim/imaging/ultrasound/view/organs.h"

#include <filesystem>
#include <map>

#include "casedb/import/import.h"
#include "sim/imaging/ultrasound/line.h"
#include "sim/imaging/ultrasound/view/echogenicity.h"
#include "sim/imaging/ultrasound/view/fan.h"
#include "sim/volume/organs/organ_classes.h"
#include "sim/volume/phantom.h"
#include "sim/volume/tissue/find_tissue.h"
#include "tests/fixtures/places.h"
#include "tests/fixtures/shared_data.h"
#include "tests/sim/imaging/ultrasound/ultrasound_scene.h"

namespace seldinger::imaging {
namespace {

struct Torso {
  volume::Volume volume;
  std::vector<TissueClass> classes;
  std::vector<std::uint8_t> levels;
  std::vector<Organ> organs;
  TissueVolume tissue() const { return {&volume, classes, levels}; }
};
const Torso& torso() {
  static const Torso kTorso = [] {
    volume::Phantom phantom = volume::make_phantom();
    Torso made;
    made.classes = volume::tissue_classes(phantom.volume, &phantom.labels);
    made.volume = std::move(phantom.volume);
    made.levels = echogenicity(made.volume, made.classes);
    show_organs(made.volume, made.classes, made.levels);
    made.organs = organs_of(made.volume, made.classes);
    return made;
  }();
  return kTorso;
}

// The organ all about a place, none where another is as near as `mm`.
Organ organ_about(const Torso& patient, const glm::dmat4& voxel_from_lps, const glm::dvec3& p, double mm,
                  bool& alike) {
  const auto at = [&](const glm::dvec3& q) -> std::ptrdiff_t {
    const glm::ivec3 i(glm::floor(glm::dvec3(voxel_from_lps * glm::dvec4(q, 1.0)) + 0.5));
    if (glm::any(glm::lessThan(i, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(i, patient.volume.size_voxels)))
      return -1;
    return static_cast<std::ptrdiff_t>(patient.volume.index(i.x, i.y, i.z));
  };
  const std::ptrdiff_t middle = at(p);
  alike = middle >= 0;
  if (!alike) return Organ::none;
  const auto of = static_cast<std::size_t>(middle);
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-mm, mm}) {
      glm::dvec3 q = p;
      q[axis] += side;
      const std::ptrdiff_t other = at(q);
      alike = alike && other >= 0 && patient.organs[static_cast<std::size_t>(other)] == patient.organs[of] &&
              patient.classes[static_cast<std::size_t>(other)] == patient.classes[of];
    }
  return patient.organs[of];
}

struct Power {
  double sum = 0.0;
  int count = 0;
  double db() const { return 10.0 * std::log10(sum / count); }
};

// Echo without loss of all that one picture shows, by organ; `liver` beside it.
void add_picture(const Torso& patient, const UltrasoundView& view, std::map<Organ, Power>& organs, Power& liver) {
  PolarPicture picture;
  ultrasound_polar(patient.tissue(), view, {}, {}, picture);
  const TissueAt tissue_at(patient.tissue(), {});
  const Inserted nothing;
  const LineWalker walker(view, tissue_at, patient.volume, nothing);
  const glm::dmat4 voxel_from_lps = volume::voxel_from_lps(patient.volume);
  Line line;
  for (int b = 0; b < view.beams; ++b) {
    walker.walk(b, true, line);
    for (int k = 20; k < view.samples; ++k) {
      const double loss_db = static_cast<double>(line.loss_db[static_cast<std::size_t>(k)]);
      if (loss_db > 12.0) break;
      const glm::dvec3 p = point_of(view, b, (k + 0.5) * view.depth_mm / view.samples);
      bool alike = false;
      Organ organ = organ_about(patient, voxel_from_lps, p, 3.1, alike);
      // Pyramids are 10 mm across: near their edges they blend with the cortex.
      if (!alike && organ == Organ::kidney_pyramid) organ = organ_about(patient, voxel_from_lps, p, 1.5, alike);
      const bool is_liver = tissue_at(p) == TissueClass::liver;
      if (!alike || (organ == Organ::none && !is_liver)) continue;
      const double level = static_cast<double>(at(picture, b, k));
      Power& power = organ == Organ::none ? liver : organs[organ];
      power.sum += level * level * std::pow(10.0, 0.1 * loss_db);
      ++power.count;
    }
  }
}

TEST(Organs, HaveTheirRowsLevelInPictures) {
  std::map<Organ, Power> organs;
  Power liver;
  UltrasoundView view = straight_view(60.0);
  view.beams = 64;
  view.samples = 400;
  view.attenuation_db_cm_mhz = 0.0;
  // From above each: liver, both kidneys, spleen, belly, flanks, back. The probe may stand anywhere.
  for (const glm::dvec3& from : std::vector<glm::dvec3>{{-70, -60, 20},
                                                        {-90, -50, -10},
                                                        {-62, 10, -24},
                                                        {62, 10, -8},
                                                        {-62, 12, -40},
                                                        {62, 12, 8},
                                                        {85, -10, 55},
                                                        {0, -114, -60},
                                                        {-60, -108, -90},
                                                        {60, -108, -60},
                                                        {10, -70, -90},
                                                        {60, 60, -120}}) {
    view.origin_lps_mm = from;
    for (int seed = 1; seed <= 2; ++seed) {
      view.seed = static_cast<std::uint64_t>(seed);
      add_picture(torso(), view, organs, liver);
    }
  }
  ASSERT_GT(liver.count, 3000);
  for (const OrganRow& row : organ_rows()) {
    const auto found = organs.find(row.organ);
    if (found == organs.end()) continue;
    printf("%-20s %6.1f dB over liver, row %5.1f (%d samples)\n", row.name, found->second.db() - liver.db(),
           row.level_db, found->second.count);
    // Sheets thinner than the slice blend with what lies beside them; their rows are the layer test's.
    if (row.organ == Organ::skin || row.organ == Organ::fascia || row.organ == Organ::diaphragm) continue;
    if (found->second.count < 500) continue;
    EXPECT_NEAR(found->second.db() - liver.db(), row.level_db, 1.5) << row.name;
  }
  for (const Organ organ : {Organ::spleen, Organ::kidney_cortex, Organ::kidney_sinus, Organ::muscle,
                            Organ::fat_under_skin, Organ::fat_inside, Organ::kidney_pyramid})
    EXPECT_GE(organs[organ].count, 500) << organ_rows()[static_cast<std::size_t>(organ)].name;
}

// Of a patient whom nobody labelled: what class and place tell of the body's wall and about its organs, and organs
// that are found. There is no liver to compare with, but its level is what all are told in.
Torso real_patient(const std::filesystem::path& path) {
  Torso patient;
  auto source = casedb::read_source(path);
  EXPECT_TRUE(source.has_value()) << path;
  if (!source) return patient;
  patient.volume = std::move(source->volume);
  patient.classes = volume::classes_with_organs(patient.volume, nullptr);
  patient.levels = echogenicity(patient.volume, patient.classes);
  show_organs(patient.volume, patient.classes, patient.levels);
  patient.organs = organs_of(patient.volume, patient.classes);
  return patient;
}
UltrasoundView without_loss() {
  UltrasoundView view = straight_view(60.0);
  view.beams = 64;
  view.samples = 400;
  view.attenuation_db_cm_mhz = 0.0;
  return view;
}
// How many organs the pictures tell of.
int expect_levels_of_rows(const std::map<Organ, Power>& organs) {
  int told = 0;
  for (const OrganRow& row : organ_rows()) {
    const auto found = organs.find(row.organ);
    if (found == organs.end() || row.organ == Organ::none) continue;
    printf("real CT: %-20s %6.1f dB over liver, row %5.1f (%d samples)\n", row.name, found->second.db(),
           row.level_db, found->second.count);
    if (row.organ == Organ::skin || row.organ == Organ::fascia || row.organ == Organ::diaphragm) continue;
    if (found->second.count < 500) continue;
    EXPECT_NEAR(found->second.db(), row.level_db, 1.5) << row.name;
    ++told;
  }
  return told;
}

TEST(Organs, HaveTheirRowsLevelInPicturesOfRealCt) {
  SELDINGER_NEEDS_SHARED_DATA();
  const Torso patient = real_patient(fixtures::shared_data_dir() / "ct-abdomen-pelvis/abdomen_pelvis_2x.mha");
  const glm::ivec3 size = patient.volume.size_voxels;
  std::map<Organ, Power> organs;
  Power liver;  // none here
  UltrasoundView view = without_loss();
  // From the belly and from the back, inwards from the skin.
  for (const double across : {0.35, 0.5, 0.65})
    for (const double along : {0.3, 0.5, 0.7})
      for (const bool belly : {true, false}) {
        glm::ivec3 at(glm::dvec3(size) * glm::dvec3(across, 0.5, along));
        const int step = belly ? -1 : 1;
        int skin = at.y;
        for (; at.y > 0 && at.y < size.y - 1; at.y += step)
          if (patient.organs[patient.volume.index(at.x, at.y, at.z)] == Organ::skin) skin = at.y;
        at.y = skin;
        view.origin_lps_mm = glm::dvec3(patient.volume.lps_from_voxel * glm::dvec4(at, 1.0));
        view.axial = {0.0, belly ? 1.0 : -1.0, 0.0};
        view.lateral = {1.0, 0.0, 0.0};
        add_picture(patient, view, organs, liver);
      }
  EXPECT_GE(expect_levels_of_rows(organs), 3) << "fat under the skin, muscle, fat about organs";
}

// Of four real CTs one shows an organ that is found without labels (docs/decisions/0091).
TEST(Organs, ASpleenThatIsFoundHasItsRowsLevel) {
  SELDINGER_NEEDS_SHARED_DATA();
  const Torso patient = real_patient(fixtures::shared_data_dir() / "ct-abdomen-contrast-dicom");
  std::map<Organ, Power> organs;
  Power liver;  // none here
  UltrasoundView view = without_loss();
  view.axial = {-1.0, 0.0, 0.0};  // from the left flank
  view.lateral = {0.0, 1.0, 0.0};
  for (const double along_mm : {-108.0, -98.0, -88.0})
    for (int seed = 1; seed <= 3; ++seed) {
      view.seed = static_cast<std::uint64_t>(seed);
      view.origin_lps_mm = {115.0, 55.0, along_mm};
      add_picture(patient, view, organs, liver);
    }
  EXPECT_GE(expect_levels_of_rows(organs), 1);
  EXPECT_GE(organs[Organ::spleen].count, 2000);
}

// Levels that follow each other down a profile, each `least_db` from the one before: bright, dark, bright …
std::vector<double> layers_of(const std::vector<double>& level_db, double least_db) {
  std::vector<double> layers = {level_db.front()};
  bool rising = false, begun = false;
  for (const double db : level_db) {
    double& last = layers.back();
    if (begun && (rising ? db > last : db < last)) {
      last = db;
    } else if (std::abs(db - last) >= least_db) {
      rising = db > last;
      begun = true;
      layers.push_back(db);
    }
  }
  return layers;
}

// Skin, fat, fascia, muscle, fascia: what a beam through the belly's wall meets, one after the other.
TEST(Organs, TheWallShowsItsLayersAtFiveMegahertz) {
  UltrasoundView view = curved_view(40.0);
  view.frequency_mhz = 5.0;
  view.samples = 400;
  view.origin_lps_mm = {60.0, -106.0, -60.0};
  const auto samples = static_cast<std::size_t>(view.samples);
  std::vector<double> power(samples, 0.0);
  constexpr int kPictures = 12, kFrom = 54, kTo = 74;
  for (int i = 0; i < kPictures; ++i) {
    view.seed = static_cast<std::uint64_t>(i) + 1;
    view.origin_lps_mm.z = -90.0 + 5.0 * i;
    PolarPicture picture;
    ultrasound_polar(torso().tissue(), view, {}, {}, picture);
    for (int b = kFrom; b < kTo; ++b)
      for (std::size_t k = 0; k < samples; ++k) {
        const double level = static_cast<double>(at(picture, b, static_cast<int>(k)));
        power[k] += level * level / (kPictures * (kTo - kFrom));
      }
  }
  // As the scanner shows it: with what it adds for depth, a mm at a time.
  std::vector<double> level_db;
  for (std::size_t k = 0; k + 10 <= samples; k += 10) {
    double sum = 0.0;
    for (std::size_t j = k; j < k + 10; ++j) sum += power[j] / 10.0;
    const double depth_mm = 0.1 * (static_cast<double>(k) + 5.0);
    level_db.push_back(10.0 * std::log10(sum) + 2.0 * kAssumedAttenuationDbCmMhz * 0.1 * 5.0 * depth_mm);
  }
  const std::vector<double> layers = layers_of(level_db, 3.0);
  printf("layers of the wall:");
  for (const double db : layers) printf(" %.1f", db);
  printf(" dB\n");
  EXPECT_GE(layers.size(), 5U);
}

TEST(Organs, SameBytesForAnyNumberOfThreads) {
  std::vector<std::uint8_t> one = echogenicity(torso().volume, torso().classes, 1), three = one;
  show_organs(torso().volume, torso().classes, one, 1);
  show_organs(torso().volume, torso().classes, three, 3);
  EXPECT_EQ(one, three);
}

TEST(Organs, EveryRowSaysWhereItComesFrom) {
  for (std::size_t i = 0; i < kOrgans; ++i) {
    const OrganRow& row = organ_rows()[i];
    EXPECT_EQ(static_cast<std::size_t>(row.organ), i);
    if (row.organ == Organ::none) continue;
    EXPECT_GT(std::string(row.source).size(), 10U) << row.name;
    EXPECT_LT(std::abs(row.level_db), 15.0) << row.name;
  }
}

}  // namespace
}  // namespace seldinger::imaging

// Whether a face is seen: heads of a phantom in every position and cut, and the real volumes, in which there is
// none.
#include "casedb/import/privacy/face.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <iostream>

#include "casedb/import/import.h"
#include "sim/volume/phantom.h"
#include "tests/casedb/import/head_phantom.h"
#include "tests/casedb/import/import_case.h"
#include "tests/fixtures/shared_data.h"

namespace seldinger::casedb {
namespace {

glm::dmat3 turned(double degrees, const glm::dvec3& about) {
  return glm::dmat3(glm::rotate(glm::dmat4(1.0), glm::radians(degrees), about));
}
constexpr glm::dvec3 kLeft{1, 0, 0}, kUp{0, 0, 1};

HeadView part(double from_z_mm, double to_z_mm) {
  HeadView view;
  view.from_z_mm = from_z_mm;
  view.to_z_mm = to_z_mm;
  return view;
}

std::int16_t hu_at(const volume::Volume& volume, const glm::dvec3& p_lps_mm) {
  const auto hu =
      volume::sample_nearest(volume, glm::dvec3(volume::voxel_from_lps(volume) * glm::dvec4(p_lps_mm, 1.0)));
  return hu ? *hu : volume::kAirHu;
}

TEST(Face, IsFoundInAHeadHoweverItIsStoredOrLies) {
  std::vector<std::pair<std::string, HeadView>> views;
  views.emplace_back("axial", HeadView{});
  // Axes of voxels in every order, some of them reversed, right- and left-handed.
  const glm::dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  for (const auto& [name, axes] : std::vector<std::pair<std::string, glm::dmat3>>{{"coronal", {x, -z, y}},
                                                                                  {"sagittal", {y, -z, x}},
                                                                                  {"upside down", {-x, y, -z}},
                                                                                  {"mirrored", {-x, y, z}},
                                                                                  {"back to front", {x, -y, -z}},
                                                                                  {"slices first", {z, x, y}}}) {
    HeadView view;
    view.direction = axes;
    views.emplace_back(name, view);
  }
  for (const double degrees : {-25.0, 25.0}) {
    HeadView view;
    view.direction = turned(degrees, kLeft);
    views.emplace_back("oblique slices " + std::to_string(degrees), view);
    view = {};
    view.lps_from_head = turned(degrees, kLeft);
    views.emplace_back("nodding " + std::to_string(degrees), view);
    view = {};
    view.lps_from_head = turned(2.4 * degrees, kUp);
    views.emplace_back("turned " + std::to_string(2.4 * degrees), view);
  }
  for (const glm::dvec3& spacing : {glm::dvec3(2, 2, 1.5), glm::dvec3(1, 1, 5), glm::dvec3(3, 3, 8)}) {
    HeadView view;
    view.spacing_mm = spacing;
    view.noise_sd_hu = 30.0;
    views.emplace_back("slices of " + std::to_string(spacing.z), view);
  }
  int found = 0;
  for (const auto& [name, view] : views) {
    const FaceFinding face = find_face(head_volume(view));
    EXPECT_TRUE(face.found) << name;
    found += face.found ? 1 : 0;
    // Where the chin and the nose are: bone to -113, skin to -120; the nose's tip.
    const double chin = (view.lps_from_head * glm::dvec3(0, -60, -120)).z;
    EXPECT_LT(face.chin_lps_mm, chin + 8.0) << name;
    EXPECT_GT(face.chin_lps_mm, chin - 60.0) << name;
    const glm::dvec3 front = view.lps_from_head * glm::dvec3(0, -1, 0);
    EXPECT_GT(glm::dot(face.front, front), std::cos(glm::radians(27.0))) << name;
  }
  std::cout << "[ face ] found in " << found << " of " << views.size() << " views of the phantom's head\n";
}

TEST(Face, IsFoundInAPartOfItAndNotWhereThereIsNone) {
  struct Part {
    const char* name;
    double from_z_mm, to_z_mm;
    bool face;
  };
  const Part parts[] = {
      {"from the eyes up", -30, 140, true},         {"from the mouth up", -75, 140, true},
      {"from the neck to the brow", -200, 5, true}, {"from the neck to the nose", -200, -45, true},
      {"the jaws alone", -125, -55, true},          {"eyes and nose alone", -60, 5, true},
      {"above the brow", 25, 140, false},           {"to the chin", -200, -95, false},
      {"neck and shoulders", -220, -122, false}};
  for (const Part& one : parts)
    EXPECT_EQ(find_face(head_volume(part(one.from_z_mm, one.to_z_mm))).found, one.face) << one.name;
}

TEST(Face, TheRealVolumesAndTheTorsoHaveNone) {
  SELDINGER_NEEDS_SHARED_DATA();
  for (const char* name :
       {"ct-neck/neck.nrrd", "ct-thorax-inlet/thorax_inlet_1mm.mha", "ct-abdomen-pelvis/abdomen_pelvis.nii.gz",
        "ct-abdomen-contrast-dicom", "dicom-samples/chest_rle.dcm", "dicom-samples/CT_small.dcm"}) {
    const auto source = read_source(shared_data(name));
    ASSERT_TRUE(source) << name;
    EXPECT_FALSE(find_face(source->volume).found) << name;
    const bool neck = std::string(name).starts_with("ct-neck");  // its slices show the chin: with that hint a face
    EXPECT_EQ(find_face(source->volume, true).found, neck) << name;
  }
  EXPECT_FALSE(find_face(volume::make_phantom().volume, true).found);
  EXPECT_FALSE(find_face(volume::make_volume({5, 5, 5}, glm::dvec3(1.0), glm::dmat3(1.0), glm::dvec3(0.0))).found);
}

// Voxels `from` to `to` along the first axis.
volume::Volume columns(const volume::Volume& whole, int from, int to) {
  volume::Volume part = whole;
  part.size_voxels.x = to - from;
  part.lps_from_voxel[3] = whole.lps_from_voxel * glm::dvec4(from, 0.0, 0.0, 1.0);
  part.hu.clear();
  for (int k = 0; k < whole.size_voxels.z; ++k)
    for (int j = 0; j < whole.size_voxels.y; ++j)
      for (int i = from; i < to; ++i) part.hu.push_back(whole.at(i, j, k));
  return part;
}

// Ribs or a pelvis in front and nothing behind: half a trunk may be as wide as a head is at most.
TEST(Face, HalfATrunkHasNone) {
  SELDINGER_NEEDS_SHARED_DATA();
  std::vector<std::pair<std::string, volume::Volume>> trunks;
  for (const char* name : {"ct-abdomen-pelvis/abdomen_pelvis_2x.mha", "ct-abdomen-contrast-dicom"}) {
    auto source = read_source(shared_data(name));
    ASSERT_TRUE(source) << name;
    trunks.emplace_back(name, std::move(source->volume));
  }
  trunks.emplace_back("torso", volume::make_phantom().volume);
  for (const auto& [name, whole] : trunks) {
    const int size = whole.size_voxels.x;
    for (const double wide_mm : {174.0, 186.0, 195.0})
      for (const double body_mm : {0.0, 30.0}) {  // air that the field shows beside the body
        const int wide = static_cast<int>(wide_mm / whole.spacing_mm.x),
                  off = static_cast<int>(body_mm / whole.spacing_mm.x);
        for (const int from : {off, size - off - wide})
          EXPECT_FALSE(find_face(columns(whole, from, from + wide)).found)
              << name << ", " << wide_mm << " mm from " << from;
      }
  }
}

TEST(Face, IsFoundInAHeadThatTheFieldCutsAtASide) {
  const volume::Volume head = head_volume(part(-125, -55));
  const int size = head.size_voxels.x;
  int left = size, right = 0;  // of the head itself
  for (int k = 0; k < head.size_voxels.z; ++k)
    for (int j = 0; j < head.size_voxels.y; ++j)
      for (int i = 0; i < size; ++i)
        if (head.at(i, j, k) > -300) {
          left = std::min(left, i);
          right = std::max(right, i);
        }
  for (const double off_mm : {2.0, 6.0, 10.0}) {
    const int off = static_cast<int>(off_mm / head.spacing_mm.x);
    EXPECT_TRUE(find_face(columns(head, left + off, size)).found) << off_mm;
    EXPECT_TRUE(find_face(columns(head, left + off, right - off)).found) << off_mm << " on both sides";
  }
}

TEST(Face, IsRefusedUnlessTheUserChooses) {
  volume::Volume head = head_volume({});
  const volume::Volume before = head;
  const auto refused = settle_face(head, FaceChoice::refuse);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "face");
  EXPECT_EQ(head.hu, before.hu);
  volume::Volume torso = volume::make_phantom().volume;
  for (const FaceChoice choice : {FaceChoice::refuse, FaceChoice::crop, FaceChoice::deface}) {
    const auto hu = torso.hu;
    EXPECT_EQ(settle_face(torso, choice).value(), FaceState::none);
    EXPECT_EQ(torso.hu, hu) << "left alone";
  }
}

TEST(Face, CroppingKeepsWhatIsBelowTheChin) {
  for (const glm::dmat3& direction : {glm::dmat3(1.0), glm::dmat3({1, 0, 0}, {0, 0, -1}, {0, 1, 0}),
                                      glm::dmat3({-1, 0, 0}, {0, 1, 0}, {0, 0, -1}), turned(15.0, kLeft)}) {
    HeadView view;
    view.from_z_mm = -260.0;
    view.direction = direction;
    const volume::Volume whole = head_volume(view);
    volume::Volume cropped = whole;
    const auto state = settle_face(cropped, FaceChoice::crop);
    ASSERT_TRUE(state) << state.error().code;
    EXPECT_EQ(*state, FaceState::cropped);
    EXPECT_FALSE(find_face(cropped).found);
    EXPECT_EQ(cropped.hu.size(), static_cast<std::size_t>(cropped.size_voxels.x) *
                                     static_cast<std::size_t>(cropped.size_voxels.y) *
                                     static_cast<std::size_t>(cropped.size_voxels.z));
    double highest = -1e9;
    for (int k = 0; k < cropped.size_voxels.z; ++k)
      for (int j = 0; j < cropped.size_voxels.y; ++j)
        for (int i = 0; i < cropped.size_voxels.x; ++i) {
          const glm::dvec3 p(cropped.lps_from_voxel * glm::dvec4(i, j, k, 1.0));
          highest = std::max(highest, p.z);
          EXPECT_EQ(cropped.at(i, j, k), hu_at(whole, p)) << "in its place";
        }
    EXPECT_LT(highest, -112.0);
    EXPECT_GT(highest, -150.0);
  }
  volume::Volume head = head_volume(part(-60.0, 140.0));
  const auto nothing = settle_face(head, FaceChoice::crop);
  ASSERT_FALSE(nothing);
  EXPECT_EQ(nothing.error().code, "face_only");
}

// The foremost thing on each line from the front; deeper than 200 mm counts as nothing.
std::vector<double> relief(const volume::Volume& volume, const glm::dmat3& lps_from_head) {
  std::vector<double> depths;
  for (double z = -115.0; z <= 0.0; z += 4.0)
    for (double x = -60.0; x <= 60.0; x += 4.0) {
      double y = -130.0;
      while (y < 70.0 && hu_at(volume, lps_from_head * glm::dvec3(x, y, z)) < -300) y += 1.0;
      depths.push_back(y);
    }
  return depths;
}

TEST(Face, DefacingTakesNoseEyesAndLipsAndLeavesNoRelief) {
  for (const double degrees : {0.0, 40.0}) {
    HeadView view;
    view.lps_from_head = turned(degrees, kUp);
    const volume::Volume whole = head_volume(view);
    volume::Volume defaced = whole;
    ASSERT_EQ(settle_face(defaced, FaceChoice::deface).value(), FaceState::defaced);
    EXPECT_EQ(defaced.size_voxels, whole.size_voxels);
    for (const glm::dvec3& p : {glm::dvec3(0, -118, -30), glm::dvec3(32, -85, -15), glm::dvec3(-32, -85, -15),
                                glm::dvec3(0, -98, -60), glm::dvec3(0, -90, -95), glm::dvec3(0, -90, -76)}) {
      EXPECT_GT(hu_at(whole, view.lps_from_head * p), -300);
      EXPECT_EQ(hu_at(defaced, view.lps_from_head * p), volume::kAirHu) << p.x << " " << p.y << " " << p.z;
    }
    for (const glm::dvec3& p : {glm::dvec3(0, 40, 20), glm::dvec3(0, 60, -40), glm::dvec3(0, -80, 60),
                                glm::dvec3(0, 35, -150), glm::dvec3(30, 10, -180)})
      EXPECT_EQ(hu_at(defaced, view.lps_from_head * p), hu_at(whole, view.lps_from_head * p));
    // Where the face was there is a plane, or lines that pass beside the head: the face's own relief is gone.
    const auto before = relief(whole, view.lps_from_head), after = relief(defaced, view.lps_from_head);
    int on_face = 0, flat = 0;
    double plane = 1e9;
    for (const double depth : after) plane = std::min(plane, depth);
    for (std::size_t i = 0; i < after.size(); ++i) {
      if (before[i] >= plane) continue;
      ++on_face;
      flat += after[i] < plane + 6.0 || degrees != 0.0 ? 1 : 0;
      EXPECT_GE(after[i], before[i]);
    }
    EXPECT_GT(on_face, 300);
    EXPECT_GT(flat, on_face * 7 / 10);
    if (degrees == 0.0) {
      EXPECT_NEAR(plane, -124.0 + 60.0, 5.0);
    }
  }
}

TEST(Face, AnImportOfAHeadIsRefusedOrSettled) {
  // A hint of the source lets a smaller part of a face count.
  const volume::Volume little = head_volume(part(-122.0, -95.0));
  EXPECT_FALSE(find_face(little).found);
  EXPECT_TRUE(find_face(little, true).found);
}

}  // namespace
}  // namespace seldinger::casedb

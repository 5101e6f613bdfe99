// Ultrasound of real CT, on the GPU against the CPU.
#include <filesystem>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <string>

#include "casedb/import/import.h"
#include "sim/base/rng.h"
#include "sim/imaging/ultrasound/view/echogenicity.h"
#include "sim/volume/classes.h"
#include "sim/volume/tissue/find_tissue.h"
#include "tests/fixtures/places.h"
#include "tests/fixtures/shared_data.h"
#include "tests/gpu_cpu/ultrasound_pair.h"

namespace seldinger::imaging {
namespace {

struct Patient {
  volume::Volume volume;
  std::vector<volume::TissueClass> classes;
  std::vector<std::uint8_t> echogenicity;
};

Patient patient(const char* name) {
  auto source = casedb::read_source(fixtures::shared_data_dir() / name);
  if (!source) {
    ADD_FAILURE() << name;
    return {};
  }
  Patient p{std::move(source->volume), {}, {}};
  p.classes = volume::tissue_classes(p.volume);
  p.echogenicity = echogenicity(p.volume, p.classes);
  return p;
}

// A needle through the picture and a cyst beside it, with sliders off their middle.
void expect_alike(const Patient& p, UltrasoundView view, double needle_mm) {
  ASSERT_FALSE(p.classes.empty());
  Inserted inserted;
  inserted.needle = NeedlePose{
      .tip_lps_mm = view.origin_lps_mm + needle_mm * view.axial,
      .direction = glm::normalize(view.axial + 0.8 * view.lateral + 0.01 * glm::cross(view.axial, view.lateral))};
  inserted.lesions.push_back({view.origin_lps_mm + (needle_mm - 5.0) * view.axial - 9.0 * view.lateral, 5.0, 0.0});
  UltrasoundKnobs knobs;
  knobs.tgc_db = {-6.0, 2.0, 0.0, 3.0, -3.0, 4.0, 0.0, 6.0};
  gpu::Context context;
  const TissueVolume tissue{&p.volume, p.classes, p.echogenicity};
  for (const LinesBy by : {LinesBy::cpu, LinesBy::gpu}) {
    UltrasoundGpu gpu(context, tissue, by);
    for (const UltrasoundMethod method : {UltrasoundMethod::scatterers, UltrasoundMethod::lattice})
      for (const bool range_error : {false, true}) {
        view.method = method;
        view.range_error = range_error;
        const ScreenPair pair = screen_pair(gpu, tissue, view, inserted, {}, knobs, {480, 420});
        EXPECT_TRUE(alike(pair)) << view.probe.name << ' ' << range_error;
        EXPECT_GT(pair.lit, 0.15);
      }
  }
}

TEST(UltrasoundOfRealCt, TheLiverBetweenTheRibs) {
  SELDINGER_NEEDS_SHARED_DATA();
  UltrasoundView view;
  view.origin_lps_mm = {-149.4, -55.5, -506.0};
  view.axial = glm::normalize(glm::dvec3(0.7021, 0.7121, 0.0));
  view.lateral = glm::normalize(glm::dvec3(0.7121, -0.7021, 0.0));
  const Patient abdomen = patient("ct-abdomen-pelvis/abdomen_pelvis_2x.mha");
  for (const Probe& probe : kProbes) {
    view.probe = probe;
    view.depth_mm = probe.radius_mm > 0.0 ? 150.0 : 60.0;
    expect_alike(abdomen, view, probe.radius_mm > 0.0 ? 50.0 : 30.0);
  }
}

// From the skin in any direction, as hands hold probes.
TEST(UltrasoundOfRealCt, FromAnyPlaceOfTheSkin) {
  SELDINGER_NEEDS_SHARED_DATA();
  const Patient abdomen = patient("ct-abdomen-pelvis/abdomen_pelvis_2x.mha");
  ASSERT_FALSE(abdomen.classes.empty());
  const glm::ivec3 size = abdomen.volume.size_voxels;
  const glm::dmat4 voxel_from_lps = volume::voxel_from_lps(abdomen.volume);
  const TissueVolume tissue{&abdomen.volume, abdomen.classes, abdomen.echogenicity};
  gpu::Context context;
  UltrasoundGpu gpu(context, tissue, LinesBy::gpu);
  base::Rng rng(7);
  int shown = 0;
  for (int i = 0; i < 24; ++i) {
    const auto between = [&](double low, double high) { return low + (high - low) * rng.uniform(); };
    const glm::dvec3 inside(
        abdomen.volume.lps_from_voxel *
        glm::dvec4(glm::dvec3(size) * glm::dvec3(between(0.3, 0.7), between(0.3, 0.7), between(0.2, 0.8)), 1.0));
    const double around_rad = between(0.0, 6.28), up_rad = between(-0.3, 0.3);
    const glm::dvec3 out(std::cos(around_rad) * std::cos(up_rad), std::sin(around_rad) * std::cos(up_rad),
                         std::sin(up_rad));
    UltrasoundView view;
    for (double far_mm = 0.0; far_mm < 400.0; far_mm += 0.5) {
      const glm::dvec3 p = inside + far_mm * out;
      const glm::ivec3 v(glm::floor(glm::dvec3(voxel_from_lps * glm::dvec4(p, 1.0)) + 0.5));
      if (glm::any(glm::lessThan(v, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(v, size))) break;
      if (abdomen.classes[abdomen.volume.index(v.x, v.y, v.z)] != volume::TissueClass::air) view.origin_lps_mm = p;
    }
    view.probe = kProbes[static_cast<std::size_t>(i % 4)];
    view.depth_mm = view.probe.radius_mm > 0.0 ? between(60.0, 160.0) : between(30.0, 70.0);
    view.axial = -out;
    view.lateral = glm::normalize(glm::cross(out, glm::dvec3(between(-0.5, 0.5), between(-0.5, 0.5), 1.0)));
    view.method = i % 8 < 4 ? UltrasoundMethod::scatterers : UltrasoundMethod::lattice;
    view.range_error = i % 3 != 0;
    const ScreenPair pair = screen_pair(gpu, tissue, view, {}, {}, {}, {320, 280});
    if (pair.lit < 0.05) continue;  // bone or gas at the face
    ++shown;
    EXPECT_TRUE(alike(pair)) << i;
  }
  EXPECT_GE(shown, 20);
}

TEST(UltrasoundOfRealCt, TheNeckWithALinearProbe) {
  SELDINGER_NEEDS_SHARED_DATA();
  const Patient neck = patient("ct-neck/neck.nrrd");
  ASSERT_FALSE(neck.classes.empty());
  // From the front, onto the first tissue below the middle of the volume's anterior face.
  UltrasoundView view;
  view.probe = kL115v;
  view.depth_mm = 50.0;
  const glm::ivec3 size = neck.volume.size_voxels;
  glm::ivec3 at(size.x * 2 / 5, 0, size.z / 2);
  const auto is_air = [&](const glm::ivec3& v) {
    return neck.classes[neck.volume.index(v.x, v.y, v.z)] == volume::TissueClass::air;
  };
  while (at.y < size.y - 1 && is_air(at)) ++at.y;
  view.origin_lps_mm = glm::dvec3(neck.volume.lps_from_voxel * glm::dvec4(at, 1.0));
  view.axial = {0.0, 1.0, 0.0};
  view.lateral = {1.0, 0.0, 0.0};
  expect_alike(neck, view, 20.0);
}

}  // namespace
}  // namespace seldinger::imaging

// Ultrasound of real CT, on the GPU against the CPU.
#include <filesystem>
#include <glm/geometric.hpp>
#include <string>

#include "casedb/import/import.h"
#include "sim/imaging/ultrasound/echogenicity.h"
#include "sim/volume/classes.h"
#include "tests/gpu_cpu/ultrasound_pair.h"

namespace seldinger::imaging {
namespace {

struct Patient {
  volume::Volume volume;
  std::vector<volume::TissueClass> classes;
  std::vector<std::uint8_t> echogenicity;
};

Patient patient(const char* name) {
  auto source = casedb::read_source(std::filesystem::path(SELDINGER_SHARED_DATA_DIR) / name);
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

TEST(UltrasoundOfRealCt, TheNeckWithALinearProbe) {
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

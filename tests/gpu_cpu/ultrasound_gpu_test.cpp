// Ultrasound on the GPU (float, compute shaders) against the CPU: the same scatterers in the same tissue, so the
// same speckle, grey by grey.
#include <limits>

#include "sim/volume/phantom.h"
#include "sim/volume/tissue/find_tissue.h"
#include "tests/gpu_cpu/ultrasound_pair.h"
#include "tests/sim/imaging/ultrasound/ultrasound_scene.h"

namespace seldinger::imaging {
namespace {

// A slanted probe, so that no beam runs along the faces of voxels.
UltrasoundView slanted(UltrasoundView view) {
  view.origin_lps_mm = {0.37, 0.11, 0.21};
  view.axial = glm::normalize(glm::dvec3(0.15, 1.0, 0.1));
  view.lateral = glm::normalize(glm::cross(view.axial, glm::dvec3(0.05, 0.0, 1.0)));
  view.beams = 64;
  view.samples = 600;
  return view;
}
std::vector<UltrasoundView> views() {
  std::vector<UltrasoundView> all;
  for (const UltrasoundView& view : {curved_view(110.0), straight_view(45.0)})
    for (const UltrasoundMethod method : {UltrasoundMethod::scatterers, UltrasoundMethod::lattice}) {
      all.push_back(slanted(view));
      all.back().method = method;
    }
  return all;
}

// Whoever walks along the beams.
class UltrasoundOnGpu : public testing::TestWithParam<LinesBy> {
 protected:
  UltrasoundGpu gpu_of(const Scene& s) { return UltrasoundGpu(context_, s.tissue(), GetParam()); }
  gpu::Context context_;
};
INSTANTIATE_TEST_SUITE_P(LinesBy, UltrasoundOnGpu, testing::Values(LinesBy::cpu, LinesBy::gpu),
                         [](const auto& by) { return by.param == LinesBy::cpu ? "Cpu" : "Gpu"; });

TEST_P(UltrasoundOnGpu, IsTheCpuInLiverAndInLayers) {
  const Scene liver = all_of(TissueClass::liver), many = layers();
  UltrasoundGpu gpu_liver = gpu_of(liver), gpu_many = gpu_of(many);
  for (const UltrasoundView& view : views()) {
    EXPECT_TRUE(alike(screen_pair(gpu_liver, liver.tissue(), view)));
    EXPECT_TRUE(alike(screen_pair(gpu_many, many.tissue(), view)));
    PolarPicture gpu;
    gpu_many.polar(view, {}, {}, gpu);
    EXPECT_TRUE(alike(polar_of(many, view), gpu, 0.005));
  }
}

TEST_P(UltrasoundOnGpu, IsTheCpuBehindLung) {
  const Scene s = scene(
      [](const glm::dvec3& p) {
        if (p.y > 40.0 + 0.2 * p.x) return TissueClass::lung;
        return glm::length(p - glm::dvec3(2.0, 22.0, 1.0)) < 6.0 ? TissueClass::fluid : TissueClass::liver;
      },
      {110, 130, 40}, 1.5);
  UltrasoundGpu gpu = gpu_of(s);
  int with_artefacts = 0;
  for (const UltrasoundView& view : views()) {
    EXPECT_TRUE(alike(screen_pair(gpu, s.tissue(), view)));
    PolarPicture picture;
    gpu.polar(view, {}, {}, picture);
    const PolarPicture cpu = polar_of(s, view);
    EXPECT_TRUE(alike(cpu, picture, 0.005));
    UltrasoundView before = view, without = view;
    before.sight_law = cases::SightLaw::scatter;  // tells round bodies by one of their sides
    gpu.polar(before, {}, {}, picture);
    EXPECT_TRUE(alike(polar_of(s, before), picture, 0.005));
    without.sight_law = cases::SightLaw::echo;
    with_artefacts += polar_of(s, without).envelope != cpu.envelope ? 1 : 0;
  }
  EXPECT_GT(with_artefacts, 0) << "nothing was mirrored, nothing in an edge's shadow";
}

TEST_P(UltrasoundOnGpu, IsTheCpuBehindGasAndNearLung) {
  for (const TissueClass air : {TissueClass::gas, TissueClass::lung}) {
    const Scene s =
        scene([&](const glm::dvec3& p) { return p.y > 22.0 + 0.1 * p.x && p.x < 4.0 ? air : TissueClass::liver; },
              {110, 130, 40}, 1.5);
    UltrasoundGpu gpu = gpu_of(s);
    for (UltrasoundView view : views()) {
      view.range_error = true;
      EXPECT_TRUE(alike(screen_pair(gpu, s.tissue(), view)));
      PolarPicture picture;
      gpu.polar(view, {}, {}, picture);
      EXPECT_TRUE(alike(polar_of(s, view), picture, 0.005));
    }
  }
}

// The last tissue on the way to the front from the middle.
glm::dvec3 front_of(const volume::Volume& volume, const std::vector<TissueClass>& classes) {
  glm::ivec3 at = volume.size_voxels / 2, skin = at;
  for (; at.y >= 0; --at.y)
    if (classes[volume.index(at.x, at.y, at.z)] != TissueClass::air) skin = at;
  return glm::dvec3(volume.lps_from_voxel * glm::dvec4(skin, 1.0));
}

TEST_P(UltrasoundOnGpu, IsTheCpuOnTheTorsoByEveryProbe) {
  const volume::Phantom torso = volume::make_phantom({.spacing_mm = glm::dvec3(3.0)});
  const std::vector<TissueClass> classes = volume::tissue_classes(torso.volume, &torso.labels);
  const TissueVolume tissue{&torso.volume, classes, {}};
  UltrasoundGpu gpu(context_, tissue, GetParam());
  for (const Probe& probe : kProbes)
    for (const UltrasoundMethod method : {UltrasoundMethod::scatterers, UltrasoundMethod::lattice})
      for (const bool range_error : {false, true}) {
        UltrasoundView view = slanted(straight_view(probe.radius_mm > 0.0 ? 120.0 : 50.0));
        view.probe = probe;
        view.method = method;
        view.range_error = range_error;
        view.origin_lps_mm = front_of(torso.volume, classes);
        Inserted inserted;
        inserted.needle = NeedlePose{.tip_lps_mm = view.origin_lps_mm + 30.0 * view.axial,
                                     .direction = glm::normalize(view.axial + view.lateral)};
        inserted.lesions.push_back({view.origin_lps_mm + 28.0 * view.axial - 8.0 * view.lateral, 5.0, 0.0});
        EXPECT_TRUE(alike(screen_pair(gpu, tissue, view, inserted))) << probe.name << ' ' << range_error;
      }
}

TEST_P(UltrasoundOnGpu, IsTheCpuAtTheSizeOfAConsole) {
  const Scene many = layers();
  UltrasoundGpu gpu = gpu_of(many);
  for (UltrasoundView view : {slanted(curved_view()), slanted(straight_view())}) {
    view.beams = 128, view.samples = 1024;
    EXPECT_TRUE(alike(screen_pair(gpu, many.tissue(), view, {}, {}, {}, {800, 700})));
  }
  EXPECT_LE(gpu.buffer_bytes(), std::size_t{64} << 20);
}

TEST_P(UltrasoundOnGpu, ShowsTheSameNeedleAndLesions) {
  const Scene many = layers();
  UltrasoundGpu gpu = gpu_of(many);
  for (UltrasoundView view : views()) {
    Inserted inserted;
    inserted.lesions.push_back({view.origin_lps_mm + 24.0 * view.axial - 8.0 * view.lateral, 5.0, 0.0});
    inserted.lesions.push_back({view.origin_lps_mm + 27.0 * view.axial - 5.0 * view.lateral, 6.0, -80.0});
    // One with a wall of another tissue and level than its inside.
    cases::Lesion abscess{view.origin_lps_mm + 26.0 * view.axial + 8.0 * view.lateral, 6.0, 25.0};
    abscess.echo = cases::LesionEcho{TissueClass::vessel, TissueClass::muscle, -12.0, 2.0, 2.0, {3.0, 3.0}};
    abscess.echo->margin_mm = 2.5, abscess.echo->about_db = 1.0;
    inserted.lesions.push_back(abscess);
    inserted.lesions.push_back({glm::dvec3(std::numeric_limits<double>::quiet_NaN()), 5.0, 0.0});
    for (const double tilt_rad : {0.0, 0.3, 1.2}) {
      const glm::dvec3 along = std::cos(tilt_rad) * view.lateral + std::sin(tilt_rad) * view.axial;
      inserted.needle = NeedlePose{.tip_lps_mm = view.origin_lps_mm + 22.0 * view.axial, .direction = along};
      EXPECT_TRUE(alike(screen_pair(gpu, many.tissue(), view, inserted))) << tilt_rad;
    }
    view.echogenic_needle = true;
    EXPECT_TRUE(alike(screen_pair(gpu, many.tissue(), view, inserted)));
    // One that is lost is none.
    PolarPicture lost, none;
    inserted.needle->tip_lps_mm.y = std::numeric_limits<double>::quiet_NaN();
    gpu.polar(view, inserted, {}, lost);
    inserted.needle.reset();
    gpu.polar(view, inserted, {}, none);
    EXPECT_EQ(lost.envelope, none.envelope);
  }
}

TEST_P(UltrasoundOnGpu, TakesEveryKnobOfViewAndConsole) {
  const Scene many = layers();
  UltrasoundGpu gpu = gpu_of(many);
  for (UltrasoundView view : views()) {
    view.range_error = true;
    EXPECT_TRUE(alike(screen_pair(gpu, many.tissue(), view)));
    view.focus_mm = 30.0;
    view.frequency_mhz = 5.0;
    view.scatterers_per_cell = 3.0;
    view.attenuation_db_cm_mhz = 0.3;
    view.seed = 99;
    UltrasoundKnobs knobs;
    knobs.gain_db = -4.0;
    knobs.dynamic_range_db = 80.0;
    knobs.tgc_db = {-10.0, 5.0, 0.0, 3.0, -3.0, 8.0, 0.0, 12.0};
    knobs.flip = true;
    const DisplaySize size{333, 251, 0.41};  // no row where rounding decides what is outside
    EXPECT_TRUE(alike(screen_pair(gpu, many.tissue(), view, {}, {}, knobs, size)));
  }
}

// Where speed of sound leaps most, two samples may show at one place and none at others.
TEST_P(UltrasoundOnGpu, ShiftsBehindMetalAsTheCpuDoes) {
  const Scene s = scene([](const glm::dvec3& p) {
    return p.y > 20.0 && p.y < 22.5   ? TissueClass::connective
           : p.y > 26.0 && p.y < 28.0 ? TissueClass::metal
                                      : TissueClass::liver;
  });
  UltrasoundGpu gpu = gpu_of(s);
  for (UltrasoundView view : views()) {
    view.range_error = true;
    PolarPicture picture;
    gpu.polar(view, {}, {}, picture);
    EXPECT_TRUE(alike(polar_of(s, view), picture, 0.005));
  }
}

// Sound is 9/145 slower in fat, so the 73rd sample shows four samples and a half deeper: rounding must choose
// alike, whoever walked.
TEST(UltrasoundOnGpuInFat, BothWalksShiftHalvesOfSamplesAlike) {
  const Scene fat = all_of(TissueClass::fat);
  gpu::Context context;
  UltrasoundGpu by_cpu(context, fat.tissue(), LinesBy::cpu), by_gpu(context, fat.tissue(), LinesBy::gpu);
  for (UltrasoundView view : views())
    for (const double deeper : {1.0, 1.037, 1.093}) {
      view.depth_mm *= deeper;
      view.range_error = true;
      PolarPicture one, other;
      by_cpu.polar(view, {}, {}, one);
      by_gpu.polar(view, {}, {}, other);
      EXPECT_TRUE(alike(one, other, 0.0001)) << view.depth_mm;
    }
}

TEST_P(UltrasoundOnGpu, TheSameInputGivesTheSameBitsWhateverCameBefore) {
  const Scene many = layers();
  UltrasoundGpu one = gpu_of(many), other = gpu_of(many);
  for (const UltrasoundView& view : views()) {
    PolarPicture a, b, again;
    one.polar(view, {}, {}, a);
    UltrasoundView larger = view;
    larger.samples = 1100, larger.beams = 130, larger.range_error = true;
    other.polar(larger, {}, {}, b);
    other.polar(view, {}, {}, b);
    one.polar(view, {}, {}, again);
    EXPECT_EQ(a.envelope, b.envelope);
    EXPECT_EQ(a.envelope, again.envelope);
  }
}

TEST_P(UltrasoundOnGpu, GasBoneAndAFaceOffTheSkin) {
  const Scene gas = scene([](const glm::dvec3& p) { return p.y < 60.0 ? TissueClass::gas : TissueClass::liver; });
  const Scene bone = all_of(TissueClass::bone), liver = all_of(TissueClass::liver);
  UltrasoundGpu gpu_gas = gpu_of(gas), gpu_bone = gpu_of(bone), gpu = gpu_of(liver);
  std::vector<float> half(128, 0.5F);
  std::fill(half.begin() + 64, half.end(), -1.5F);
  const std::vector<float> far(128, -30.0F);
  for (const UltrasoundView& view : views()) {
    EXPECT_TRUE(alike(screen_pair(gpu_gas, gas.tissue(), view)));
    EXPECT_TRUE(alike(screen_pair(gpu_bone, bone.tissue(), view)));
    EXPECT_TRUE(alike(screen_pair(gpu, liver.tissue(), view, {}, half)));
    EXPECT_TRUE(alike(screen_pair(gpu, liver.tissue(), view, {}, far)));
    // Nothing of what a buffer held before.
    PolarPicture picture;
    gpu.polar(view, {}, far, picture);
    for (int b = 0; b < view.beams; ++b)
      for (int k = sample_at(view, 35.0); k < view.samples; ++k) ASSERT_LT(at(picture, b, k), 1e-5F);
  }
}

TEST_P(UltrasoundOnGpu, OutsideTheCtIsAir) {
  const Scene s = scene([](const glm::dvec3&) { return TissueClass::liver; }, {20, 40, 20}, 2.0);
  UltrasoundGpu gpu = gpu_of(s);
  for (UltrasoundView view : views()) {
    EXPECT_TRUE(alike(screen_pair(gpu, s.tissue(), view)));
    view.origin_lps_mm = {500.0, 0.0, 0.0};
    PolarPicture outside;
    gpu.polar(view, {}, {}, outside);
    EXPECT_TRUE(alike(polar_of(s, view), outside, 0.0));
    for (int k = sample_at(view, 35.0); k < view.samples; ++k) ASSERT_LT(at(outside, 40, k), 1e-3F);
  }
}

TEST_P(UltrasoundOnGpu, FewBeamsAndSamplesAndGreatNumbers) {
  const Scene liver = all_of(TissueClass::liver);
  UltrasoundGpu gpu = gpu_of(liver);
  for (UltrasoundView view : views()) {
    // The lattice's samples must be finer than the pulse.
    for (const auto& [beams, samples] :
         view.method == UltrasoundMethod::lattice
             ? std::vector<std::pair<int, int>>{{1, 800}, {2, 900}, {300, 700}}
             : std::vector<std::pair<int, int>>{{1, 1}, {2, 2}, {3, 50}, {300, 256}}) {
      view.beams = beams, view.samples = samples;
      PolarPicture picture;
      gpu.polar(view, {}, {}, picture);
      EXPECT_TRUE(alike(polar_of(liver, view), picture, 0.02)) << beams << ' ' << samples;
    }
    UltrasoundView far = view;  // lattice numbers beyond 2²⁴ and negative ones
    far.samples = 600, far.beams = 64;
    Scene there = liver;
    far.origin_lps_mm = {-9e6, 9e6, -9e6};
    there.volume.lps_from_voxel[3] += glm::dvec4(far.origin_lps_mm, 0.0);
    UltrasoundGpu gpu_there = gpu_of(there);
    PolarPicture picture;
    gpu_there.polar(far, {}, {}, picture);
    EXPECT_TRUE(alike(polar_of(there, far), picture, 0.02));
    EXPECT_NEAR(level_db(picture, 10, 50, 20, 300), level_db(polar_of(there, far), 10, 50, 20, 300), 0.01);
  }
}

TEST_P(UltrasoundOnGpu, MayOutliveItsContext) {
  const Scene many = layers();
  const UltrasoundView view = slanted(straight_view());
  auto passing = std::make_unique<gpu::Context>();
  UltrasoundGpu gpu(*passing, many.tissue(), GetParam());
  passing.reset();
  EXPECT_TRUE(alike(screen_pair(gpu, many.tissue(), view)));
}

}  // namespace
}  // namespace seldinger::imaging

// What a scene file may name as its volume.
#include "app/pictures/scene.h"

#include <gtest/gtest.h>

#include "sim/volume/phantom.h"

namespace seldinger::app {
namespace {

TEST(Scene, NamesTheBuiltInTorso) {
  std::vector<std::string> unused;
  const auto scene = scene_from_json(R"({"volume": {"built_in": "torso"}})", ".", unused);
  ASSERT_TRUE(scene.has_value()) << scene.error().text;
  EXPECT_TRUE(unused.empty());
  const auto volume = volume_of(*scene, "");
  ASSERT_TRUE(volume.has_value());
  const volume::Phantom torso = volume::make_phantom();
  EXPECT_EQ(volume->size_voxels, torso.volume.size_voxels);
  EXPECT_EQ(volume->lps_from_voxel, torso.volume.lps_from_voxel);
  EXPECT_EQ(volume->hu, torso.volume.hu);
  // Classes come from its labels: HU alone cannot tell liver from spleen.
  const auto tissue = tissue_of(*scene, *volume, "");
  ASSERT_TRUE(tissue.has_value());
  const auto class_at = [&](const glm::dvec3& p_lps_mm) {
    const glm::dvec3 at = glm::dvec3(volume::voxel_from_lps(*volume) * glm::dvec4(p_lps_mm, 1.0)) + 0.5;
    return tissue->classes[volume->index(static_cast<int>(at.x), static_cast<int>(at.y), static_cast<int>(at.z))];
  };
  EXPECT_EQ(class_at({-100.0, 0.0, 10.0}), volume::TissueClass::liver);
  EXPECT_EQ(class_at({104.0, 34.0, 58.0}), volume::TissueClass::spleen);
  EXPECT_EQ(class_at({0.0, 39.0, 3.0}), volume::TissueClass::bone);
}

TEST(Scene, RefusesWhatIsNotBuiltIn) {
  std::vector<std::string> unused;
  for (const char* text : {R"({"volume": {"built_in": "head"}})", R"({"volume": {"built_in": 1}})"}) {
    const auto scene = scene_from_json(text, ".", unused);
    ASSERT_FALSE(scene.has_value()) << text;
    EXPECT_EQ(scene.error().code, "bad_scene");
    EXPECT_NE(scene.error().text.find("volume.built_in"), std::string::npos) << scene.error().text;
  }
  EXPECT_FALSE(scene_from_json(R"({"volume": {}})", ".", unused).has_value());
}

TEST(Scene, MayShowFlowInColour) {
  std::vector<std::string> unused;
  const auto with = [&](const std::string& colour) {
    return scene_from_json(R"({"volume": {"built_in": "neck"}, "view": {"kind": "ultrasound", "preset": "vessel",
        "origin_mm": [0, 0, 0], "axial": [0, 1, 0], "lateral": [1, 0, 0], "colour": )" +
                               colour + "}}",
                           ".", unused);
  };
  const auto scene = with(R"({"scale_cm_s": 25})");
  ASSERT_TRUE(scene.has_value()) << scene.error().text;
  EXPECT_TRUE(unused.empty());
  EXPECT_EQ(std::get<UltrasoundSceneView>(*scene->view).console.colour_mm_s, 250.0);
  const auto off = with("null");  // as a sheet's column turns it off
  ASSERT_TRUE(off.has_value());
  EXPECT_EQ(std::get<UltrasoundSceneView>(*off->view).console.colour_mm_s, 0.0);
  for (const char* colour : {"true", "{}", R"({"scale_cm_s": 0})"})
    EXPECT_FALSE(with(colour).has_value()) << colour;
  EXPECT_FALSE(with(R"({"scale_cm_s": 25}, "output": "polar_db")").has_value());
  EXPECT_FALSE(with(R"(null, "output": "polar_db", "compound_deg": 12)").has_value()) << "of one look";
  EXPECT_TRUE(with(R"(null, "output": "polar_db", "compound_deg": 0)").has_value());
  const auto aimed = with(R"({"scale_cm_s": 25, "lean_deg": -20, "box_across": 0.3, "box_down": 0.6},
      "compound_deg": 12, "sight_law": "scatter")");
  ASSERT_TRUE(aimed.has_value()) << aimed.error().text;
  const auto& view = std::get<UltrasoundSceneView>(*aimed->view);
  EXPECT_EQ(view.console.lean_deg, -20.0);
  EXPECT_EQ(view.console.box_across, 0.3);
  EXPECT_EQ(view.console.box_down, 0.6);
  EXPECT_EQ(view.view.compound_deg, 12.0);
  EXPECT_EQ(view.view.sight_law, cases::SightLaw::scatter);
  EXPECT_EQ(std::get<UltrasoundSceneView>(*scene->view).view.sight_law, cases::kNewestSightLaw);
  for (const char* wrong : {R"({"scale_cm_s": 25, "lean_deg": 21})", R"({"scale_cm_s": 25}, "compound_deg": 16)",
                            R"({"scale_cm_s": 25}, "sight_law": "none")"})
    EXPECT_FALSE(with(wrong).has_value()) << wrong;
}

}  // namespace
}  // namespace seldinger::app

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "app/pictures/scene.h"
#include "app/pictures/scene_fields_json.h"
#include "sim/case/gauge.h"

namespace seldinger::app {
namespace {

constexpr double kFarSource = 1e7;  // mm: a source far away stands for parallel rays
constexpr int kMaxShapes = 10'000;
constexpr std::size_t kMaxStructures = 100, kMaxPoints = 1000;
constexpr std::size_t kMaxClasses = 254;  // a label is one byte; 0 is none

// One of a table's names.
template <typename Value, std::size_t n>
Value read_named(SceneReader& reader, const char* field, const base::Names<Value, n>& table,
                 const char* otherwise) {
  std::vector<std::string> names;
  for (const base::Named<Value>& one : table) names.emplace_back(one.name);
  return *base::from_name(table, reader.choice(field, names, otherwise));
}

volume::Shape read_shape(const Json& json, const std::string& where, base::Error& error,
                         std::vector<std::string>& unused) {
  SceneReader reader(json, where, error);
  volume::Shape shape;
  const std::string kind = reader.choice("kind", {"box", "sphere", "cylinder", "ellipsoid"}, nullptr);
  if (kind == "box") {
    shape.geometry = volume::Box{reader.point("min_mm"), reader.point("max_mm")};
  } else if (kind == "sphere") {
    shape.geometry = volume::Sphere{reader.point("center_mm"), reader.number("radius_mm", 1e-6, kFar)};
  } else if (kind == "cylinder") {
    shape.geometry =
        volume::Cylinder{reader.point("from_mm"), reader.point("to_mm"), reader.number("radius_mm", 1e-6, kFar)};
  } else {
    shape.geometry = volume::Ellipsoid{reader.point("center_mm"), reader.point("radii_mm", 1e-6, kFar)};
  }
  shape.hu = reader.number("hu", -1024.0, 32767.0);
  shape.class_name = reader.text("class");
  if (shape.class_name.size() > 64) reader.bad("class", "is too long");
  reader.unused(unused);
  return shape;
}

volume::AnalyticVolume read_analytic(const Json& json, base::Error& error, std::vector<std::string>& unused) {
  SceneReader reader(json, "volume.analytic", error);
  volume::AnalyticVolume analytic;
  const auto size = reader.wholes<3>("size_voxels", 4096);
  analytic.size_voxels = {size[0], size[1], size[2]};
  if (static_cast<double>(size[0]) * size[1] * size[2] > static_cast<double>(volume::kMaxVoxels))
    reader.bad("size_voxels", "is too large");
  analytic.spacing_mm = reader.point("spacing_mm", volume::kMinSpacingMm, volume::kMaxSpacingMm);
  analytic.origin_mm = reader.point("origin_mm");
  analytic.background_hu = reader.number("background_hu", -1024.0, 32767.0, -1000.0);
  if (!reader.has("shapes")) return analytic;
  const Json& shapes = reader["shapes"];
  if (!shapes.is_array() || shapes.size() > kMaxShapes) {
    reader.bad("shapes", "is not a list of at most 10000");
    return analytic;
  }
  for (std::size_t i = 0; i < shapes.size(); ++i)
    analytic.shapes.push_back(
        read_shape(shapes[i], "volume.analytic.shapes[" + std::to_string(i) + "]", error, unused));
  std::set<std::string> classes;
  for (const volume::Shape& shape : analytic.shapes) classes.insert(shape.class_name);
  if (classes.size() > kMaxClasses) reader.bad("shapes", "name more than 254 classes");
  reader.unused(unused);
  return analytic;
}

void read_volume(SceneReader& root, const std::filesystem::path& folder, Scene& scene, base::Error& error,
                 std::vector<std::string>& unused) {
  if (!root.has("volume")) return root.bad("volume", "is missing");
  const Json& json = root["volume"];
  if (json.is_string()) {
    const std::filesystem::path path = json.get<std::string>();
    scene.volume = VolumeFile{path.is_absolute() ? path : folder / path};
    return;
  }
  SceneReader reader(json, "volume", error);
  if (reader.has("case"))
    scene.volume = VolumeOfCase{reader.text("case")};
  else if (reader.has("analytic"))
    scene.volume = read_analytic(reader["analytic"], error, unused);
  else if (reader.has("built_in")) {
    volume::PhantomOptions built_in;
    built_in.region = read_named(reader, "built_in", volume::kRegionNames, nullptr);
    built_in.body = read_named(reader, "body", volume::kBodyNames, "adult");
    built_in.posture = read_named(reader, "posture", volume::kPostureNames, "supine");
    scene.volume = built_in;
  } else
    reader.bad("", "is neither a path, a case, built_in nor analytic");
  reader.unused(unused);
}

void read_needle(const Json& json, Scene& scene, base::Error& error, std::vector<std::string>& unused) {
  SceneReader reader(json, "needle", error);
  imaging::NeedlePose needle;
  cases::Instrument& instrument = scene.instrument;
  needle.tip_lps_mm = reader.point("tip_mm");
  needle.direction = reader.unit("direction");
  needle.length_mm = instrument.length_mm = reader.number("length_mm", 1e-3, 1e3, 200.0);
  // By size or by gauge; a gauge with its stylet in is solid.
  if (reader.has("gauge") && reader.has("radius_mm")) reader.bad("gauge", "stands beside radius_mm");
  const double number = reader.number("gauge", cases::kGauges.front().number, cases::kGauges.back().number, 22.0);
  const auto gauge = cases::gauge(static_cast<int>(number));
  if (!gauge || number != std::floor(number)) reader.bad("gauge", "is not a gauge of the table");
  const bool by_gauge = gauge && reader.has("gauge");
  const bool stylet = reader.choice("stylet", {"in", "out"}, "in") == "in";
  needle.radius_mm = instrument.radius_mm =
      reader.number("radius_mm", 1e-3, 20.0, by_gauge ? 0.5 * gauge->outer_mm : 0.36);
  needle.inner_radius_mm = instrument.inner_radius_mm =
      reader.number("inner_radius_mm", 0.0, needle.radius_mm, by_gauge && !stylet ? 0.5 * gauge->inner_mm : 0.0);
  needle.hu = instrument.hu = reader.number("hu", -1024.0, 32767.0, 3000.0);
  needle.bevel_turn_rad = glm::radians(reader.number("bevel_deg", -360.0, 360.0, 0.0));
  reader.choice("surface", {"plain", "echogenic"}, "plain");
  if (reader.choice("instrument", {"access", "core"}, "access") == "core")
    instrument.kind = cases::InstrumentKind::core;
  instrument.throw_mm = reader.number("throw_mm", 0.0, 60.0, instrument.throw_mm);
  instrument.notch_mm = reader.number("notch_mm", 0.1, 60.0, instrument.notch_mm);
  instrument.dead_tip_mm = reader.number("dead_tip_mm", 0.0, 30.0, instrument.dead_tip_mm);
  scene.inserted.needle = needle;
  reader.unused(unused);
}

cases::Tube read_tube(SceneReader& reader, const std::string& where, base::Error& error) {
  cases::Tube tube{{}, reader.number("radius_mm", 0.1, 500.0)};
  if (!reader.has("points_mm") || !reader["points_mm"].is_array() || reader["points_mm"].empty() ||
      reader["points_mm"].size() > kMaxPoints) {
    reader.bad("points_mm", "is not a list of 1 to " + std::to_string(kMaxPoints) + " points");
    return tube;
  }
  for (const Json& point : reader["points_mm"]) {
    const Json one = {{"points_mm", point}};
    tube.points_lps_mm.push_back(SceneReader(one, where, error).point("points_mm"));
  }
  return tube;
}

void read_structure(const Json& json, const std::string& where, Scene& scene, base::Error& error,
                    std::vector<std::string>& unused) {
  SceneReader reader(json, where, error);
  cases::Structure structure;
  structure.name = reader.text("name");
  constexpr auto& kRuleNames = base::kNamesOf<cases::kStructureRuleNames>;
  const std::vector<std::string> rules(kRuleNames.begin(), kRuleNames.end());
  structure.rule = *cases::structure_rule_from(reader.choice("rule", rules, nullptr));
  const std::string kind = reader.choice("kind", {"sphere", "ellipsoid", "tube"}, nullptr);
  if (kind == "sphere")
    structure.shape = cases::Sphere{reader.point("center_mm"), reader.number("radius_mm", 0.1, 500.0)};
  else if (kind == "ellipsoid")
    structure.shape = cases::Ellipsoid{reader.point("center_mm"), reader.point("radii_mm", 0.1, 500.0)};
  else
    structure.shape = read_tube(reader, where, error);
  // With a tissue it is drawn, with an HU of its own or its class's (docs/decisions/0018).
  if (reader.has("tissue")) {
    const auto tissue = volume::tissue_of_name(reader.text("tissue"));
    if (!tissue) reader.bad("tissue", "is no tissue class");
    structure.tissue = tissue.value_or(volume::TissueClass{});
    scene.drawn.push_back({scene.structures.size(),  // where it goes below
                           reader.number("hu", -1024.0, 32767.0, volume::typical_hu(structure.tissue))});
  }
  reader.unused(unused);
  scene.structures.push_back(std::move(structure));
}

void read_structures(SceneReader& root, Scene& scene, base::Error& error, std::vector<std::string>& unused) {
  const Json& structures = root["structures"];
  if (!structures.is_array() || structures.size() > kMaxStructures)
    return root.bad("structures", "is not a list of at most " + std::to_string(kMaxStructures));
  for (std::size_t i = 0; i < structures.size(); ++i)
    read_structure(structures[i], "structures[" + std::to_string(i) + "]", scene, error, unused);
}

imaging::MprView read_mpr(const Json& json, base::Error& error, std::vector<std::string>& unused) {
  SceneReader reader(json, "view", error);
  imaging::MprView view;
  reader.has("kind");
  view.center_lps_mm = reader.point("center_mm");
  view.u = reader.unit("u");
  view.v = reader.unit_across("v", view.u);
  view.pixel_mm = reader.number("pixel_mm", 1e-4, 100.0);
  const auto size = reader.wholes<2>("size_px", kMaxPixels);
  view.width_px = size[0];
  view.height_px = size[1];
  view.interpolation = reader.choice("interpolation", {"nearest", "linear"}, "linear") == "nearest"
                           ? imaging::Interpolation::nearest
                           : imaging::Interpolation::linear;
  view.needle_slab_mm = reader.number("needle_slab_mm", 0.0, 50.0, 0.0);
  reader.unused(unused);
  return view;
}

// Degenerate geometry has one judge: imaging's own.
XrayView read_xray(const Json& json, base::Error& error, std::vector<std::string>& unused) {
  SceneReader reader(json, "view", error);
  XrayView view;
  reader.has("kind");
  if (reader.has("source_mm") == reader.has("direction"))
    reader.bad("", "has not exactly one of source_mm and direction");
  else if (reader.has("source_mm"))
    view.geometry.source_lps_mm = reader.point("source_mm", -kFarSource, kFarSource);
  else
    view.geometry.direction = reader.unit("direction");
  view.geometry.detector_center_lps_mm = reader.point("detector_center_mm");
  view.geometry.u = reader.unit("u");
  view.geometry.v = reader.unit_across("v", view.geometry.u);
  view.geometry.pixel_mm = reader.number("pixel_mm", 1e-4, 100.0);
  const auto size = reader.wholes<2>("size_px", kMaxPixels);
  view.geometry.width_px = size[0];
  view.geometry.height_px = size[1];
  view.energy_kev = reader.number("energy_kev", imaging::kMinEnergyKev, imaging::kMaxEnergyKev, view.energy_kev);
  const std::string method = reader.choice("method", {"exact", "slab", "trilinear"}, "exact");
  view.method = method == "exact"  ? imaging::ProjectionMethod::exact
                : method == "slab" ? imaging::ProjectionMethod::slab
                                   : imaging::ProjectionMethod::trilinear;
  const std::string output = reader.choice("output", {"line_integral", "intensity", "display"}, "line_integral");
  view.output = output == "line_integral" ? XrayOutput::line_integral
                : output == "intensity"   ? XrayOutput::intensity
                                          : XrayOutput::display;
  const std::string scatter = reader.choice("scatter", {"none", "open", "grid"}, "none");
  view.scatter = scatter == "open"   ? SceneScatter::open
                 : scatter == "grid" ? SceneScatter::grid
                                     : SceneScatter::none;
  if (view.scatter != SceneScatter::none &&
      (view.output == XrayOutput::line_integral || !view.geometry.source_lps_mm))
    reader.bad("scatter", "is of an intensity or display, with source_mm: a line integral is primary only");
  view.glare_share = 0.01 * reader.number("glare_percent", 0.0, 50.0, 0.0);
  if (view.glare_share > 0.0 && view.output == XrayOutput::line_integral)
    reader.bad("glare_percent", "is of an intensity or display: a line integral has none");
  const double rays = reader.number("supersampling", 1.0, 8.0, 1.0);
  view.supersampling = static_cast<int>(rays);
  if (view.supersampling != rays || view.supersampling * std::max(size[0], size[1]) > kMaxPixels)
    reader.bad("supersampling", "is not a whole number that keeps the picture within 8192 rays a side");
  reader.unused(unused);
  if (!error.findings.empty()) return view;
  const auto checked = imaging::check_geometry(view.geometry);
  if (!checked) reader.bad("", "is not a geometry: " + checked.error().text);
  return view;
}

SceneMotion read_motion(const Json& json, base::Error& error, std::vector<std::string>& unused) {
  SceneReader reader(json, "motion", error);
  SceneMotion motion;
  motion.breath_level = reader.number("breath_level", -1.0, 2.0, 0.0);
  if (reader.has("breath_mm")) motion.breath_mm = reader.point("breath_mm", -50.0, 50.0);
  motion.breath_slides = reader.flag("breath_slides", false);
  motion.press_mm = reader.number("press_mm", 0.0, 50.0, 0.0);
  motion.beat_s = reader.number("beat_s", 0.0, 1e4, 0.0);
  motion.drag_mm = reader.number("drag_mm", -10.0, 10.0, 0.0);
  reader.unused(unused);
  return motion;
}

}  // namespace

base::Result<Scene> scene_from_json(const std::string& text, const std::filesystem::path& folder,
                                    std::vector<std::string>& unused) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) return base::Error{"bad_scene", "the scene is not a JSON object"};
  base::Error error{"bad_scene", "", {}};
  SceneReader root(json, "scene", error);
  Scene scene;
  read_volume(root, folder, scene, error, unused);
  if (root.has("needle")) read_needle(root["needle"], scene, error, unused);
  if (root.has("lesions")) {
    const Json& lesions = root["lesions"];
    if (!lesions.is_array() || lesions.size() > imaging::kMaxLesions) {
      root.bad("lesions", "is not a list of at most " + std::to_string(imaging::kMaxLesions));
    } else {
      for (std::size_t i = 0; i < lesions.size(); ++i) {
        SceneReader reader(lesions[i], "lesions[" + std::to_string(i) + "]", error);
        cases::Lesion lesion;
        lesion.center_lps_mm = reader.point("center_mm");
        lesion.radius_mm = reader.number("radius_mm", 1e-6, 500.0);
        lesion.hu = reader.number("hu", -1024.0, 32767.0);
        constexpr auto& kKinds = base::kNamesOf<cases::kLesionKindNames>;
        lesion.kind = *base::from_name(cases::kLesionKindNames,
                                       reader.choice("kind", {kKinds.begin(), kKinds.end()}, "by_hu"));
        scene.inserted.lesions.push_back(std::move(lesion));
        reader.unused(unused);
      }
    }
  }
  if (root.has("planned_entry_mm")) scene.planned_entry_lps_mm = root.point("planned_entry_mm");
  if (root.has("structures")) read_structures(root, scene, error, unused);
  constexpr auto& kApproaches = base::kNamesOf<cases::kApproachNames>;
  scene.approach = *base::from_name(cases::kApproachNames,
                                    root.choice("approach", {kApproaches.begin(), kApproaches.end()}, "in_plane"));
  if (root.has("motion")) {
    scene.motion = read_motion(root["motion"], error, unused);
    if (scene.motion->drag_mm != 0.0 && !scene.inserted.needle)
      root.bad("motion", "drags a needle that is not there");
  }
  if (root.has("view")) {
    const Json& view = root["view"];
    const std::string kind =
        view.is_object() ? view.value("kind", Json()).is_string() ? view.at("kind").get<std::string>() : "" : "";
    if (kind == "mpr")
      scene.view = read_mpr(view, error, unused);
    else if (kind == "xray")
      scene.view = read_xray(view, error, unused);
    else if (kind == "room")
      scene.room = read_room(view, error, unused);
    else if (kind == "ultrasound") {
      const bool echogenic = root.has("needle") && root["needle"].is_object() &&
                             root["needle"].value("surface", Json()) == Json("echogenic");
      scene.view = read_ultrasound(view, echogenic, error, unused);
    } else
      root.bad("view", "has no known kind");
    if (scene.motion && kind == "xray") root.bad("motion", "is not shown by xray yet");
    if (scene.motion && scene.motion->press_mm > 0.0 && kind != "ultrasound")
      root.bad("motion", "presses a probe that is not there");
  }
  root.unused(unused);
  if (error.findings.empty()) return scene;
  error.text = error.findings.front().text;
  error.findings.erase(error.findings.begin());
  return error;
}

}  // namespace seldinger::app

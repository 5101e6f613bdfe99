#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "app/scene.h"

namespace seldinger::app {
namespace {

using Json = nlohmann::json;

constexpr double kFar = 1e5;        // mm: no scanner is 100 m long
constexpr double kFarSource = 1e7;  // mm: a source far away stands for parallel rays
constexpr int kMaxPixels = 8192;    // per side
constexpr int kMaxShapes = 10'000;
constexpr std::size_t kMaxClasses = 254;  // a label is one byte; 0 is none

// Reads fields of one object and remembers what is wrong and what nobody asked for.
class Reader {
 public:
  Reader(const Json& json, std::string where, base::Error& error)
      : json_(json), where_(std::move(where)), error_(error) {
    if (!json_.is_object()) bad("", "is not an object");
  }

  void bad(const std::string& field, const std::string& what) {
    const std::string name = field.empty() ? where_ : where_ + "." + field;
    error_.findings.push_back({"bad_scene", name + " " + what});
  }

  bool has(const char* field) {
    asked_.insert(field);
    return json_.is_object() && json_.contains(field);
  }

  const Json& operator[](const char* field) { return json_.at(field); }

  double number(const char* field, double min, double max, std::optional<double> fallback = {}) {
    if (!has(field)) {
      if (!fallback) bad(field, "is missing");
      return fallback.value_or(min);
    }
    const Json& value = json_.at(field);
    if (!value.is_number() || !(value.get<double>() >= min && value.get<double>() <= max)) {
      bad(field, "is not a number in its range");
      return fallback.value_or(min);
    }
    return value.get<double>();
  }

  glm::dvec3 point(const char* field, double min = -kFar, double max = kFar) {
    glm::dvec3 p(0.0);
    if (!has(field)) {
      bad(field, "is missing");
      return p;
    }
    const Json& value = json_.at(field);
    bool good = value.is_array() && value.size() == 3;
    for (int axis = 0; good && axis < 3; ++axis) {
      const Json& component = value.at(static_cast<std::size_t>(axis));
      good = component.is_number() && component.get<double>() >= min && component.get<double>() <= max;
      if (good) p[axis] = component.get<double>();
    }
    if (!good) bad(field, "is not three numbers in their range");
    return p;
  }

  glm::dvec3 unit(const char* field) {
    const glm::dvec3 v = point(field, -1.001, 1.001);
    const double length = glm::length(v);
    if (std::abs(length - 1.0) <= 1e-3) return v / length;
    if (has(field)) bad(field, "is not of unit length");
    return {1.0, 0.0, 0.0};
  }

  std::string choice(const char* field, const std::vector<std::string>& choices, const char* fallback) {
    if (!has(field)) {
      if (fallback == nullptr) bad(field, "is missing");
      return fallback == nullptr ? choices.front() : fallback;
    }
    const Json& value = json_.at(field);
    if (value.is_string())
      for (const std::string& one : choices)
        if (value.get<std::string>() == one) return one;
    bad(field, "is none of the known words");
    return choices.front();
  }

  std::string text(const char* field) {
    if (!has(field)) return {};
    const Json& value = json_.at(field);
    if (!value.is_string()) bad(field, "is not a text");
    return value.is_string() ? value.get<std::string>() : std::string();
  }

  template <int N>
  std::array<int, N> wholes(const char* field, int max) {
    std::array<int, N> numbers;
    numbers.fill(1);
    if (!has(field)) {
      bad(field, "is missing");
      return numbers;
    }
    const Json& value = json_.at(field);
    bool good = value.is_array() && value.size() == N;
    for (std::size_t i = 0; good && i < N; ++i) {
      good = value.at(i).is_number_integer() && value.at(i).get<long long>() >= 1 &&
             value.at(i).get<long long>() <= max;
      if (good) numbers[i] = value.at(i).get<int>();
    }
    if (!good) bad(field, "is not whole numbers in their range");
    return numbers;
  }

  void unused(std::vector<std::string>& names) const {
    if (!json_.is_object()) return;
    for (const auto& [key, value] : json_.items())
      if (!asked_.contains(key)) names.push_back(where_);
  }

 private:
  const Json& json_;
  std::string where_;
  base::Error& error_;
  std::set<std::string> asked_;
};

volume::Shape read_shape(const Json& json, const std::string& where, base::Error& error,
                         std::vector<std::string>& unused) {
  Reader reader(json, where, error);
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
  Reader reader(json, "volume.analytic", error);
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

void read_volume(Reader& root, const std::filesystem::path& folder, Scene& scene, base::Error& error,
                 std::vector<std::string>& unused) {
  if (!root.has("volume")) return root.bad("volume", "is missing");
  const Json& json = root["volume"];
  if (json.is_string()) {
    const std::filesystem::path path = json.get<std::string>();
    scene.volume = VolumeFile{path.is_absolute() ? path : folder / path};
    return;
  }
  Reader reader(json, "volume", error);
  if (reader.has("case"))
    scene.volume = VolumeOfCase{reader.text("case")};
  else if (reader.has("analytic"))
    scene.volume = read_analytic(reader["analytic"], error, unused);
  else
    reader.bad("", "is neither a path, a case nor analytic");
  reader.unused(unused);
}

void read_needle(const Json& json, Scene& scene, base::Error& error, std::vector<std::string>& unused) {
  Reader reader(json, "needle", error);
  imaging::NeedlePose needle;
  cases::Instrument& instrument = scene.instrument;
  needle.tip_lps_mm = reader.point("tip_mm");
  needle.direction = reader.unit("direction");
  needle.length_mm = instrument.length_mm = reader.number("length_mm", 1e-3, 1e3, 200.0);
  needle.radius_mm = instrument.radius_mm = reader.number("radius_mm", 1e-3, 20.0, 0.36);
  needle.inner_radius_mm = instrument.inner_radius_mm =
      reader.number("inner_radius_mm", 0.0, needle.radius_mm, 0.0);
  needle.hu = instrument.hu = reader.number("hu", -1024.0, 32767.0, 3000.0);
  reader.choice("surface", {"plain", "echogenic"}, "plain");
  if (reader.choice("instrument", {"access", "core"}, "access") == "core")
    instrument.kind = cases::InstrumentKind::core;
  instrument.throw_mm = reader.number("throw_mm", 0.0, 60.0, instrument.throw_mm);
  instrument.notch_mm = reader.number("notch_mm", 0.1, 60.0, instrument.notch_mm);
  instrument.dead_tip_mm = reader.number("dead_tip_mm", 0.0, 30.0, instrument.dead_tip_mm);
  scene.inserted.needle = needle;
  reader.unused(unused);
}

// Axes written with a few decimals are meant to be perpendicular.
glm::dvec3 perpendicular(Reader& reader, const glm::dvec3& u, const glm::dvec3& v) {
  if (std::abs(glm::dot(u, v)) <= 1e-3) return glm::normalize(v - u * glm::dot(u, v));
  reader.bad("v", "is not perpendicular to view.u");
  return v;
}

imaging::MprView read_mpr(const Json& json, base::Error& error, std::vector<std::string>& unused) {
  Reader reader(json, "view", error);
  imaging::MprView view;
  reader.has("kind");
  view.center_lps_mm = reader.point("center_mm");
  view.u = reader.unit("u");
  view.v = perpendicular(reader, view.u, reader.unit("v"));
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

// Methods and outputs that this version does not have are told as such, in `unsupported`.
UltrasoundSceneView read_ultrasound(const Json& json, bool echogenic, base::Error& error,
                                    std::vector<std::string>& unused, bool& unsupported) {
  Reader reader(json, "view", error);
  UltrasoundSceneView scene;
  imaging::UltrasoundView& view = scene.view;
  reader.has("kind");
  if (reader.has("probe") && reader["probe"].is_object())
    unsupported = true;
  else if (const auto* probe = imaging::probe_named(reader.choice("probe", {"C5-2v", "L11-5v"}, "C5-2v")))
    view.probe = *probe;
  view.origin_lps_mm = reader.point("origin_mm");
  view.axial = reader.unit("axial");
  view.lateral = perpendicular(reader, view.axial, reader.unit("lateral"));
  view.depth_mm = reader.number("depth_mm", 5.0, 400.0, 150.0);
  view.focus_mm = reader.number("focus_mm", 0.0, 400.0, 0.0);
  const auto whole = [&](const char* field, double min, double max, double fallback) {
    const double number = reader.number(field, min, max, fallback);
    if (number != std::floor(number)) reader.bad(field, "is not a whole number");
    return static_cast<int>(number);
  };
  view.beams = whole("beams", 1.0, 2048.0, 128.0);
  view.samples = whole("samples", 8.0, 8192.0, 1024.0);
  view.seed = static_cast<std::uint64_t>(reader.number("seed", 0.0, 9e15, 1.0));
  if (reader.has("attenuation_db_cm_mhz"))
    view.attenuation_db_cm_mhz = reader.number("attenuation_db_cm_mhz", 0.0, 20.0);
  view.echogenic_needle = echogenic;
  scene.knobs.gain_db = reader.number("gain_db", -120.0, 120.0, 0.0);
  scene.knobs.dynamic_range_db = reader.number("dynamic_range_db", 1.0, 200.0, 60.0);
  if (reader.has("tgc_db")) {
    const Json& bands = reader["tgc_db"];
    bool good = bands.is_array() && bands.size() == scene.knobs.tgc_db.size();
    for (std::size_t i = 0; good && i < scene.knobs.tgc_db.size(); ++i) {
      good = bands[i].is_number() && std::abs(bands[i].get<double>()) <= 120.0;
      if (good) scene.knobs.tgc_db[i] = bands[i].get<double>();
    }
    if (!good) reader.bad("tgc_db", "is not eight numbers in their range");
  }
  if (reader.has("size_px")) {
    const auto size = reader.wholes<2>("size_px", kMaxPixels);
    scene.size = {size[0], size[1]};
  }
  unsupported =
      unsupported || reader.choice("method", {"scatterers", "lattice", "thesis"}, "scatterers") != "scatterers";
  const std::string output = reader.choice("output", {"display", "envelope_db", "polar_db"}, "display");
  unsupported = unsupported || output == "envelope_db";
  scene.output = output == "polar_db" ? UltrasoundOutput::polar_db : UltrasoundOutput::display;
  reader.unused(unused);
  return scene;
}

// Degenerate geometry has one judge: imaging's own.
XrayView read_xray(const Json& json, base::Error& error, std::vector<std::string>& unused) {
  Reader reader(json, "view", error);
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
  view.geometry.v = perpendicular(reader, view.geometry.u, reader.unit("v"));
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

}  // namespace

base::Result<Scene> scene_from_json(const std::string& text, const std::filesystem::path& folder,
                                    std::vector<std::string>& unused) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) return base::Error{"bad_scene", "the scene is not a JSON object"};
  base::Error error{"bad_scene", "", {}};
  Reader root(json, "scene", error);
  Scene scene;
  read_volume(root, folder, scene, error, unused);
  if (root.has("needle")) read_needle(root["needle"], scene, error, unused);
  if (root.has("lesions")) {
    const Json& lesions = root["lesions"];
    if (!lesions.is_array() || lesions.size() > imaging::kMaxLesions) {
      root.bad("lesions", "is not a list of at most " + std::to_string(imaging::kMaxLesions));
    } else {
      for (std::size_t i = 0; i < lesions.size(); ++i) {
        Reader reader(lesions[i], "lesions[" + std::to_string(i) + "]", error);
        scene.inserted.lesions.push_back({reader.point("center_mm"), reader.number("radius_mm", 1e-6, 500.0),
                                          reader.number("hu", -1024.0, 32767.0)});
        reader.unused(unused);
      }
    }
  }
  if (root.choice("approach", {"in_plane", "out_of_plane"}, "in_plane") == "out_of_plane")
    scene.approach = cases::Approach::out_of_plane;
  if (root.has("view")) {
    const Json& view = root["view"];
    const std::string kind =
        view.is_object() ? view.value("kind", Json()).is_string() ? view.at("kind").get<std::string>() : "" : "";
    if (kind == "mpr")
      scene.view = read_mpr(view, error, unused);
    else if (kind == "xray")
      scene.view = read_xray(view, error, unused);
    else if (kind == "ultrasound") {
      bool unsupported = false;
      const bool echogenic = root.has("needle") && root["needle"].is_object() &&
                             root["needle"].value("surface", Json()) == Json("echogenic");
      scene.view = read_ultrasound(view, echogenic, error, unused, unsupported);
      if (unsupported)
        return base::Error{
            "unsupported_view",
            "this version has probes by name, the method scatterers, and the outputs display and polar_db"};
    } else
      root.bad("view", "has no known kind");
  }
  root.unused(unused);
  if (error.findings.empty()) return scene;
  error.text = error.findings.front().text;
  error.findings.erase(error.findings.begin());
  return error;
}

}  // namespace seldinger::app

#include <cmath>

#include "app/pictures/scene_fields_json.h"
#include "sim/imaging/ultrasound/colour.h"
#include "sim/imaging/ultrasound/compound.h"
#include "sim/imaging/ultrasound/console.h"

namespace seldinger::app {
namespace {

using imaging::GreyMap;
using imaging::Probe;
using imaging::UltrasoundMethod;

// A probe of the scene's own; what is not told is as of C5-2v.
Probe read_probe(const Json& json, base::Error& error, std::vector<std::string>& unused) {
  SceneReader reader(json, "view.probe", error);
  Probe probe = imaging::kC52v;
  probe.name = "of the scene";
  probe.frequency_mhz = reader.number("frequency_mhz", 0.5, 50.0, probe.frequency_mhz);
  probe.elements = reader.whole("elements", 2, 1024, probe.elements);
  probe.pitch_mm = reader.number("pitch_mm", 0.01, 5.0, probe.pitch_mm);
  probe.radius_mm = reader.number("radius_mm", 0.0, 500.0, 0.0);
  probe.height_mm = reader.number("height_mm", 0.5, 50.0, probe.height_mm);
  probe.elevation_focus_mm = reader.number("elevation_focus_mm", 1.0, 500.0, probe.elevation_focus_mm);
  probe.aperture_mm = reader.number("aperture_mm", 0.5, 200.0, 0.5 * probe.elements * probe.pitch_mm);
  probe.f_number = reader.number("f_number", 0.5, 10.0, probe.f_number);
  probe.bandwidth = reader.number("bandwidth", 0.1, 1.5, probe.bandwidth);
  // A face bent by more than a third of a turn is no probe for the skin.
  if (probe.radius_mm > 0.0 && probe.elements * probe.pitch_mm > 2.0944 * probe.radius_mm)
    reader.bad("radius_mm", "is too small for a face of that length");
  reader.unused(unused);
  return probe;
}

std::vector<std::string> probe_names() {
  std::vector<std::string> names;
  for (const Probe& probe : imaging::kProbes) names.emplace_back(probe.name);
  return names;
}

std::vector<std::string> preset_names() {
  std::vector<std::string> names;
  for (const auto& preset : imaging::console_presets()) names.emplace_back(preset.name);
  return names;
}

void read_knobs(SceneReader& reader, imaging::UltrasoundKnobs& knobs) {
  knobs.gain_db = reader.number("gain_db", -120.0, 120.0, 0.0);
  knobs.dynamic_range_db = reader.number("dynamic_range_db", 1.0, 200.0, knobs.dynamic_range_db);
  const std::string map = reader.choice("grey_map", {"linear", "lifted", "contrast"}, "linear");
  knobs.grey_map = map == "lifted" ? GreyMap::lifted : map == "contrast" ? GreyMap::contrast : GreyMap::linear;
  knobs.flip = reader.flag("flip");
  if (!reader.has("tgc_db")) return;
  const Json& bands = reader["tgc_db"];
  bool good = bands.is_array() && bands.size() == knobs.tgc_db.size();
  for (std::size_t i = 0; good && i < knobs.tgc_db.size(); ++i) {
    good = bands[i].is_number() && std::abs(bands[i].get<double>()) <= 120.0;
    if (good) knobs.tgc_db[i] = bands[i].get<double>();
  }
  if (!good) reader.bad("tgc_db", "is not eight numbers in their range");
}

}  // namespace

UltrasoundSceneView read_ultrasound(const Json& json, bool echogenic_needle, base::Error& error,
                                    std::vector<std::string>& unused) {
  SceneReader reader(json, "view", error);
  UltrasoundSceneView scene;
  imaging::UltrasoundView& view = scene.view;
  reader.has("kind");
  if (reader.has("preset")) {
    const imaging::Console console(
        *imaging::console_preset_named(reader.choice("preset", preset_names(), nullptr)));
    view = console.view();
    scene.knobs = console.knobs();
  }
  if (reader.has("probe") && reader["probe"].is_object())
    view.probe = read_probe(reader["probe"], error, unused);
  else if (reader.has("probe"))
    view.probe = *imaging::probe_named(reader.choice("probe", probe_names(), nullptr));
  view.origin_lps_mm = reader.point("origin_mm");
  view.axial = reader.unit("axial");
  view.lateral = reader.unit_across("lateral", view.axial);
  view.depth_mm = reader.number("depth_mm", 5.0, 400.0, view.depth_mm);
  view.focus_mm = reader.number("focus_mm", 0.0, 400.0, view.focus_mm);
  if (reader.has("frequency_mhz")) view.frequency_mhz = reader.number("frequency_mhz", 0.5, 50.0);
  view.beams = reader.whole("beams", 2, 2048, 128);
  view.samples = reader.whole("samples", 8, 8192, 1024);
  view.seed = static_cast<std::uint64_t>(reader.number("seed", 0.0, 9e15, 1.0));
  view.scatterers_per_cell = reader.number("scatterers_per_cell", 0.5, 100.0, view.scatterers_per_cell);
  view.range_error = reader.flag("range_error", view.range_error);
  if (reader.has("attenuation_db_cm_mhz"))
    view.attenuation_db_cm_mhz = reader.number("attenuation_db_cm_mhz", 0.0, 20.0);
  std::vector<std::string> laws;
  for (const auto& law : cases::kSightLawNames) laws.emplace_back(law.name);
  const std::string law = reader.choice("sight_law", laws, laws.back().c_str());
  view.sight_law = *base::from_name(cases::kSightLawNames, law);
  view.compound_deg = reader.number("compound_deg", 0.0, imaging::kMostCompoundDeg, 0.0);
  view.echogenic_needle = echogenic_needle;
  read_knobs(reader, scene.knobs);
  if (reader.has("size_px")) {
    const auto size = reader.wholes<2>("size_px", kMaxPixels);
    scene.size = {size[0], size[1]};
  }
  if (reader.has("pixel_mm")) scene.size.pixel_mm = reader.number("pixel_mm", 1e-3, 100.0);
  const std::string method = reader.choice("method", {"scatterers", "lattice", "thesis"}, "scatterers");
  view.method = method == "lattice"  ? UltrasoundMethod::lattice
                : method == "thesis" ? UltrasoundMethod::thesis
                                     : UltrasoundMethod::scatterers;
  const std::string output = reader.choice("output", {"display", "envelope_db", "polar_db"}, "display");
  scene.output = output == "polar_db"      ? UltrasoundOutput::polar_db
                 : output == "envelope_db" ? UltrasoundOutput::envelope_db
                                           : UltrasoundOutput::display;
  if (view.compound_deg > 0.0 && scene.output != UltrasoundOutput::display)
    reader.bad("compound_deg", "needs output display");
  if (reader.has("colour") && reader["colour"].is_object()) {
    SceneReader colour(reader["colour"], "view.colour", error);
    scene.console.colour_mm_s = 10.0 * colour.number("scale_cm_s", 2.0, 500.0);
    scene.console.lean_deg = colour.number("lean_deg", -imaging::kMostLeanDeg, imaging::kMostLeanDeg, 0.0);
    scene.console.box_across = colour.number("box_across", 0.0, 1.0, 0.0);
    scene.console.box_down = colour.number("box_down", 0.0, 1.0, 0.0);
    colour.unused(unused);
    if (scene.output != UltrasoundOutput::display) reader.bad("colour", "needs output display");
  } else if (reader.has("colour") && !reader["colour"].is_null()) {
    reader.bad("colour", "is not an object");
  }
  reader.unused(unused);
  return scene;
}

}  // namespace seldinger::app

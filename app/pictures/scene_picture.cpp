#include "app/pictures/scene_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

#include "app/pictures/xray_sight.h"
#include "app/replay/png.h"
#include "casedb/import/skin/surface.h"
#include "session/guidance/frame_truth.h"
#include "session/guidance/ultrasound_sight.h"
#include "sim/base/failure.h"
#include "sim/gpu/context.h"
#include "sim/imaging/ultrasound/colour_screen.h"
#include "sim/imaging/ultrasound/compound.h"
#include "sim/imaging/ultrasound/console.h"
#include "sim/imaging/ultrasound/ultrasound_gpu.h"
#include "sim/imaging/ultrasound/view/lesion_echo.h"
#include "sim/imaging/xray/beam/scatter.h"
#include "sim/imaging/xray/instruments.h"
#include "sim/imaging/xray/picture.h"
#include "sim/imaging/xray/projection/coarse.h"
#include "sim/tissue/blood_flow.h"

namespace seldinger::app {
namespace {

constexpr double kWindowCenterHu = 40.0, kWindowWidthHu = 400.0;  // the usual soft-tissue window

// Runs `on_gpu(context)` where `backend` or the machine says so, else `on_cpu()`; `backend` becomes what ran.
template <typename OnGpu, typename OnCpu>
auto on_best(std::string& backend, const OnGpu& on_gpu, const OnCpu& on_cpu) {
  const bool asked = backend == "gpu";
  try {
    gpu::Context context;
    // On software GL the CPU's own code is faster.
    if (asked || !context.software()) {
      auto made = on_gpu(context);
      backend = "gpu";
      return made;
    }
  } catch (const base::Failure& failure) {
    if (asked || failure.code() != "gl") throw;
    std::fputs("note: no GL 4.3 here; the CPU renders\n", stderr);
  }
  backend = "cpu";
  return on_cpu();
}

void render_mpr(const volume::Volume& volume, const imaging::MprView& view, const imaging::Inserted& inserted,
                const tissue::Displacement& displacement, ScenePicture& picture) {
  picture.plane = {view.center_lps_mm, view.u, view.v, view.pixel_mm, view.width_px, view.height_px};
  picture.unit = "HU";
  if (picture.backend == "reference")
    picture.values = imaging::mpr_reference(volume, view, inserted, displacement);
  else if (picture.backend == "cpu")
    picture.values = imaging::mpr_cpu(volume, view, inserted, displacement);
  else
    picture.values = on_best(
        picture.backend,
        [&](gpu::Context& context) {
          const auto way_back =
              tissue::count_sources(displacement) > 0 ? imaging::way_back_for(context) : imaging::WayBack::none;
          return imaging::MprGpu(context, volume, way_back).render(view, inserted, displacement);
        },
        [&] { return imaging::mpr_cpu(volume, view, inserted, displacement); });
  picture.grey = imaging::grey_from_hu(picture.values, kWindowCenterHu, kWindowWidthHu);
  auto target = session::target_of(inserted.lesions);
  if (target) target = tissue::displaced(displacement, *target);
  picture.visible = imaging::mpr_visible(view, inserted.needle, target);
}

imaging::PathLengths path_lengths(const volume::Volume& volume, const imaging::XrayGeometry& geometry,
                                  imaging::ProjectionMethod method, std::string& backend) {
  if (backend == "reference") return imaging::xray_reference(volume, geometry, method);
  const auto on_cpu = [&] { return imaging::XrayCpu(volume).project(geometry, method); };
  if (backend == "cpu" || method == imaging::ProjectionMethod::trilinear) {
    if (backend == "gpu") std::fputs("note: the trilinear method is the CPU's\n", stderr);
    backend = "cpu";
    return on_cpu();
  }
  return on_best(
      backend, [&](gpu::Context& context) { return imaging::XrayGpu(context, volume).project(geometry, method); },
      on_cpu);
}

// What scatter adds to every pixel: what it is behind water as thick as the patient is on the mean in the field.
double pedestal_of(const volume::Volume& volume, const XrayView& view, double water_per_mm,
                   const std::vector<float>& log_signal) {
  const imaging::XrayGeometry& g = view.geometry;
  double sum = 0.0, count = 0.0;
  for (const float one : log_signal)
    if (one < 0.0F) {
      sum -= static_cast<double>(one);
      count += 1.0;
    }
  if (count == 0.0) return 0.0;
  const glm::dvec3 middle(volume.lps_from_voxel * glm::dvec4(0.5 * glm::dvec3(volume.size_voxels - 1), 1.0));
  imaging::ScatterGeometry scatter;
  scatter.water_mm = sum / count / water_per_mm;
  scatter.field_mm = g.pixel_mm * std::sqrt(static_cast<double>(g.width_px) * g.height_px);
  scatter.gap_mm = std::abs(glm::dot(g.detector_center_lps_mm - middle, glm::cross(g.u, g.v)));
  scatter.grid = view.scatter == SceneScatter::grid;
  return std::exp(-sum / count) * imaging::scatter_to_primary(scatter);
}

void render_xray(const volume::Volume& volume, const XrayView& view, const imaging::Inserted& inserted,
                 ScenePicture& picture) {
  const imaging::XrayGeometry& g = view.geometry;
  picture.plane = {g.detector_center_lps_mm, g.u, g.v, g.pixel_mm, g.width_px, g.height_px};
  const imaging::XrayGeometry rays = imaging::finer(g, view.supersampling);
  imaging::PathLengths lengths = path_lengths(volume, rays, view.method, picture.backend);
  imaging::overlay_instruments(volume, rays, inserted, view.method, lengths);
  if (view.supersampling > 1) lengths = imaging::averaged(lengths, view.supersampling);
  picture.visible = XraySight(volume, view).see(inserted);
  const imaging::Attenuation mu = imaging::attenuation_at(view.energy_kev);
  std::vector<float> log_signal(lengths.water_mm.size());
  picture.values.resize(log_signal.size());
  for (std::size_t i = 0; i < log_signal.size(); ++i) {
    const double line_integral =
        mu.water_per_mm * static_cast<double>(lengths.water_mm[i]) +
        mu.mineral_per_mm * static_cast<double>(lengths.mineral_mm[i]) +
        (lengths.iron_mm.empty() ? 0.0 : mu.iron_per_mm * static_cast<double>(lengths.iron_mm[i]));
    log_signal[i] = static_cast<float>(-line_integral);
    picture.values[i] =
        static_cast<float>(view.output == XrayOutput::intensity ? std::exp(-line_integral) : line_integral);
  }
  if (view.scatter != SceneScatter::none) {
    const double pedestal = pedestal_of(volume, view, mu.water_per_mm, log_signal);
    for (std::size_t i = 0; i < log_signal.size(); ++i) {
      const double signal = std::exp(static_cast<double>(log_signal[i])) + pedestal;
      log_signal[i] = static_cast<float>(std::log(signal));
      picture.values[i] = static_cast<float>(signal);
    }
  }
  if (view.glare_share > 0.0) {
    double mean = 0.0;
    for (const float value : log_signal)
      mean += std::exp(static_cast<double>(value)) / static_cast<double>(log_signal.size());
    for (std::size_t i = 0; i < log_signal.size(); ++i) {
      const double signal =
          (1.0 - view.glare_share) * std::exp(static_cast<double>(log_signal[i])) + view.glare_share * mean;
      log_signal[i] = static_cast<float>(std::log(signal));
      picture.values[i] = static_cast<float>(signal);
    }
  }
  const imaging::LogWindow window =
      imaging::window_of(log_signal, g.width_px, imaging::open_field(g.width_px, g.height_px, {}));
  picture.grey.resize(log_signal.size());
  imaging::grey_from_log_signal(log_signal.data(), static_cast<int>(log_signal.size()), window,
                                picture.grey.data());
  picture.unit = "1";
  if (view.output == XrayOutput::display) {
    picture.unit = "grey";
    picture.values.assign(picture.grey.begin(), picture.grey.end());
  } else if (view.output == XrayOutput::line_integral) {
    for (unsigned char& grey : picture.grey) grey = static_cast<unsigned char>(255 - grey);  // much is bright
  }
}

// A scene's structures are told by their names.
tissue::BloodFlow flow_of(std::span<const cases::Structure> structures) {
  std::vector<cases::Structure> vessels(structures.begin(), structures.end());
  for (cases::Structure& one : vessels) one.tissue = volume::TissueClass::vessel;
  return tissue::BloodFlow(vessels);
}

// Of levels that nothing was added to: liver at the face is white, 128 dB below it black.
unsigned char grey_of_db(float db) {
  return static_cast<unsigned char>(std::clamp(255.0F + 2.0F * db, 0.0F, 255.0F));
}

}  // namespace

std::vector<std::byte> png_of(const ScenePicture& picture) {
  const int width = picture.plane.width_px, height = picture.plane.height_px;
  return picture.rgb.empty() ? png_from_grey(picture.grey, width, height)
                             : png_from_rgb(picture.rgb, width, height);
}

void ScenePainter::paint_ultrasound(const UltrasoundSceneView& scene, const imaging::Inserted& inserted,
                                    const tissue::Displacement& displacement, ScenePicture& picture) const {
  const imaging::UltrasoundView& view = scene.view;
  const std::vector<float> below_skin_mm = session::element_depths(skin_->index, view, 1, displacement);
  const imaging::TissueVolume tissue{&volume_, tissue_->classes, tissue_->echogenicity};
  const bool on_screen = scene.output == UltrasoundOutput::display;
  constexpr std::uint64_t kFrame = 1;
  imaging::PolarPicture polar;
  // Of what `envelope` makes of a look. Noise and clutter are the screen's.
  const auto receive = [&](const auto& envelope) {
    const auto one = [&](const imaging::UltrasoundView& look, std::uint64_t frame,
                         imaging::PolarPicture& received) {
      envelope(look, received);
      if (!on_screen) return;
      imaging::add_clutter(look, below_skin_mm, received);
      imaging::add_receiver_noise(look.seed, frame, received);
    };
    if (view.compound_deg > 0.0) {
      std::array<imaging::Look, imaging::kLooks> looks;
      for (std::size_t i = 0; i < looks.size(); ++i) {
        looks[i].depth_below_skin_mm = below_skin_mm;
        one(imaging::look_of(view, static_cast<int>(i)), kFrame + i, looks[i].picture);
      }
      imaging::Compounder(view).mean(view, looks, polar);
    } else {
      one(view, kFrame, polar);
    }
    if (on_screen) imaging::ScanConverter(view, scene.size).grey(view, scene.knobs, polar, picture.grey);
    return true;
  };
  const auto on_cpu = [&] {
    return receive([&](const imaging::UltrasoundView& look, imaging::PolarPicture& received) {
      imaging::ultrasound_polar(tissue, look, inserted, below_skin_mm, received, displacement);
    });
  };
  const auto on_gpu = [&](gpu::Context& context) {
    const auto moves =
        tissue::count_sources(displacement) > 0 ? imaging::TissueMoves::yes : imaging::TissueMoves::no;
    imaging::UltrasoundGpu gpu(context, tissue, imaging::LinesBy::machine, moves);
    return receive([&](const imaging::UltrasoundView& look, imaging::PolarPicture& received) {
      gpu.polar(look, inserted, below_skin_mm, received, displacement);
    });
  };
  const bool thesis = view.method == imaging::UltrasoundMethod::thesis;
  if (picture.backend == "reference" || (picture.backend == "gpu" && thesis))
    std::fputs("note: this ultrasound is the CPU's\n", stderr);
  if (picture.backend == "cpu" || picture.backend == "reference" || thesis) {
    picture.backend = "cpu";
    on_cpu();
  } else {
    on_best(picture.backend, on_gpu, on_cpu);
  }
  picture.visible = imaging::ultrasound_visible(tissue, view, inserted, below_skin_mm, displacement).visible;
  picture.frame_rate_hz = imaging::frame_rate_hz(view.depth_mm, view.beams);
  if (scene.output == UltrasoundOutput::polar_db) {
    // A row a depth, a column a beam: no place in space, one unit a pixel.
    picture.plane = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 1.0, view.beams, view.samples};
    picture.unit = "dB";
    picture.values = imaging::polar_db(polar);
    for (const float db : picture.values) picture.grey.push_back(grey_of_db(db));
    return;
  }
  const imaging::Screen screen = imaging::screen_of(view, scene.size);
  const double middle_mm = screen.top_mm + 0.5 * scene.size.height_px * screen.pixel_mm;
  picture.plane = {view.origin_lps_mm + view.axial * middle_mm,
                   view.lateral,
                   view.axial,
                   screen.pixel_mm,
                   scene.size.width_px,
                   scene.size.height_px};
  if (scene.output == UltrasoundOutput::envelope_db) {
    picture.unit = "dB";
    picture.values = imaging::ScanConverter(view, scene.size).envelope_db(polar);
    for (const float db : picture.values) picture.grey.push_back(grey_of_db(db));
    return;
  }
  picture.unit = "grey";
  picture.values.assign(picture.grey.begin(), picture.grey.end());
}

void ScenePainter::paint_colour(const UltrasoundSceneView& scene, const imaging::Inserted& inserted,
                                std::span<const cases::Structure> structures, double beat_s,
                                const tissue::Displacement& displacement, ScenePicture& picture) const {
  const tissue::BloodFlow flow = flow_of(structures);
  imaging::ColourPicture colour;
  imaging::colour_polar({&volume_, tissue_->classes, tissue_->echogenicity}, scene.view, inserted,
                        session::element_depths(skin_->index, scene.view, 1, displacement), flow, scene.console,
                        beat_s, colour, displacement);
  std::vector<unsigned char> numbers;
  imaging::colour_numbers(imaging::ScanConverter(scene.view, scene.size), scene.knobs, colour, numbers);
  picture.rgb = imaging::in_colour(picture.grey, numbers);
  picture.colour_mm_s = colour.scale_mm_s;
}

base::Result<ScenePainter> ScenePainter::of(const Scene& scene, const std::string& library) {
  auto volume = volume_of(scene, library);
  if (!volume) return volume.error();
  return ScenePainter(std::move(*volume), library);
}

base::Result<void> ScenePainter::find_tissue(const Scene& scene) {
  if (tissue_ && tissue_->law == law_of_tissue(scene)) return {};
  auto found = tissue_of(scene, volume_, library_);
  if (!found) return found.error();
  if (!skin_) {
    skin_.emplace();
    if (auto mesh = casedb::skin_surface(volume_)) {
      skin_->index = cases::MeshIndex(*mesh);
      skin_->mesh = std::move(*mesh);
    }
  }
  std::optional<tissue::BreathRegion> trunk;
  std::optional<tissue::CavityWall> wall;
  if (skin_->mesh) {
    cases::Case patient;
    patient.volume = volume_;
    patient.classes = found->classes;
    patient.skin = *skin_->mesh;
    trunk = tissue::breath_region(patient);
    wall = tissue::cavity_wall(patient);
  }
  tissue_ = Tissue{std::move(found->classes), std::move(found->echogenicity), trunk, law_of_tissue(scene), wall};
  return {};
}

tissue::Displacement ScenePainter::displacement_of(const Scene& scene) const {
  if (!scene.motion) return {};
  const SceneMotion& motion = *scene.motion;
  tissue::Causes causes;
  if (tissue_->trunk && motion.breath_level != 0.0)
    causes.breath = tissue::Breath{*tissue_->trunk,
                                   motion.breath_level * motion.breath_mm.value_or(cases::Breathing{}.amplitude_mm),
                                   motion.breath_slides && tissue_->wall ? &*tissue_->wall : nullptr};
  tissue::SkinPress press;
  if (const auto* view = std::get_if<UltrasoundSceneView>(&*scene.view); view != nullptr && motion.press_mm > 0.0) {
    press.at_lps_mm = view->view.origin_lps_mm - motion.press_mm * view->view.axial;
    press.inward = view->view.axial;
    press.depth_mm = motion.press_mm;
    causes.presses = {&press, 1};
  }
  if (const auto& needle = scene.inserted.needle; needle && motion.drag_mm != 0.0)
    if (const auto entry = skin_->index.first_hit(needle->tip_lps_mm, -needle->direction, needle->length_mm))
      causes.needle =
          tissue::NeedleDrag{.entry_lps_mm = needle->tip_lps_mm - entry->distance_mm * needle->direction,
                             .direction = needle->direction,
                             .radius_mm = needle->radius_mm,
                             .cut_mm = entry->distance_mm,
                             .shaft_mm = motion.drag_mm};
  const tissue::Displacement moved = tissue::displacement_of(causes);
  const auto* ultrasound = std::get_if<UltrasoundSceneView>(&*scene.view);
  if (ultrasound == nullptr) return moved;
  const imaging::UltrasoundView& view = ultrasound->view;
  return flow_of(scene.structures)
      .with_pulse(moved, view.origin_lps_mm + 0.5 * view.depth_mm * view.axial, motion.beat_s);
}

base::Result<ScenePicture> ScenePainter::paint(const Scene& scene, const std::string& backend) {
  ScenePicture picture;
  picture.backend = backend;
  const auto* mpr = std::get_if<imaging::MprView>(&*scene.view);
  if (scene.motion || std::holds_alternative<UltrasoundSceneView>(*scene.view))
    if (const auto found = find_tissue(scene); !found) return found.error();
  if (mpr != nullptr) {
    render_mpr(volume_, *mpr, scene.inserted, displacement_of(scene), picture);
  } else if (const auto* xray = std::get_if<XrayView>(&*scene.view)) {
    render_xray(volume_, *xray, scene.inserted, picture);
  } else {
    imaging::Inserted inserted = scene.inserted;
    const auto& view = std::get<UltrasoundSceneView>(*scene.view);
    imaging::settle_lesions(volume_, tissue_->classes, tissue_->echogenicity, inserted.lesions,
                            view.view.sight_law);
    const tissue::Displacement displacement = displacement_of(scene);
    paint_ultrasound(view, inserted, displacement, picture);
    if (view.console.colour_mm_s > 0.0)
      paint_colour(view, inserted, scene.structures, scene.motion ? scene.motion->beat_s : 0.0, displacement,
                   picture);
  }
  return picture;
}

}  // namespace seldinger::app

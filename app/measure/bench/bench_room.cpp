// bench: the room, by quality. Times until the picture is finished; errors against many samples a pixel and large
// maps.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>

#include "app/measure/bench/bench.h"
#include "casedb/import/import.h"
#include "casedb/import/skin/surface.h"
#include "sim/base/failure.h"
#include "sim/imaging/room/room_renderer.h"
#include "sim/volume/phantom.h"

namespace seldinger::measure {
namespace {

struct Choice {
  const char* name;
  imaging::RoomQuality quality;
};
constexpr Choice kChoices[] = {{"fast", imaging::kFastRoom},
                               {"1 sample, maps 2048 1024", {1, 2048, 1024, true}},
                               {"4 samples, maps 1024 512", {4, 1024, 512, false}},
                               {"fine", imaging::RoomQuality{}}};

double mean_difference(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i]));
  return sum / (0.75 * static_cast<double>(a.size()));  // alpha is the same everywhere
}

}  // namespace

base::Result<void> bench_room(const app::Arguments& arguments, bool quick, std::vector<BenchRow>& rows) {
  // The patient, with a skin, as ultrasound shows it and as it gives way to a probe.
  cases::Case scene;
  if (arguments.has("--ct")) {
    auto source = casedb::read_source(arguments.text("--ct"));
    if (!source) return source.error();
    scene.volume = std::move(source->volume);
  } else {
    scene.volume = volume::make_phantom().volume;
  }
  auto skin = casedb::skin_surface(scene.volume);
  if (!skin) return skin.error();
  scene.skin = std::move(*skin);
  scene.skin_index = cases::MeshIndex(scene.skin);
  scene.picture.modality = cases::Modality::ultrasound;
  scene.picture.probe = "C5-2v";
  scene.yields = true;
  const imaging::RoomModel room = imaging::make_room_model(scene);

  // Probe and needle on the skin in the patient's middle, from the front.
  const glm::dvec3 above = room.frame.middle_lps_mm() + 1000.0 * room.frame.up;
  const auto hit = scene.skin_index.first_hit(above, -room.frame.up, 2000.0);
  if (!hit) return base::Error{"no_body", "nothing is under the probe", {}};
  const glm::dvec3 site = above - room.frame.up * hit->distance_mm;
  cases::State state;
  state.probe.origin_lps_mm = site;
  state.probe.axial = -room.frame.up;
  state.probe.lateral = room.frame.across;
  state.needle.tip_lps_mm = site + 45.0 * room.frame.across;
  state.needle.direction = glm::normalize(-room.frame.up - room.frame.across);
  scene.planned_entry_lps_mm = state.needle.tip_lps_mm;
  // Each picture's is another, as while tissue moves.
  std::array<tissue::Displacement, 2> pressed;
  for (std::size_t i = 0; i < pressed.size(); ++i) {
    const tissue::SkinPress press{site, -room.frame.up, 20.0, 8.0 + 0.1 * static_cast<double>(i), 0.0};
    pressed[i] = tissue::displacement_of({{&press, 1}, {}, {}, {}});
  }

  // GL, or no rows at all.
  std::unique_ptr<gpu::Context> context;
  try {
    context = std::make_unique<gpu::Context>();
  } catch (const base::Failure& failure) {
    std::fprintf(stderr, "no GL here: %s\n", failure.what());
    return {};
  }
  imaging::RoomRenderer renderer(*context, room);
  // What is drawn, and of how many triangles.
  imaging::DrawList list;
  imaging::make_draw_list(room, scene, state, {}, list);
  std::size_t triangles = 0;
  for (const imaging::RoomItem& item : list.items) triangles += room.meshes[item.mesh].triangles.size();
  // Every size, with one view and with two, against the best that this GL can draw.
  for (const glm::ivec2& size : {glm::ivec2(800, 600), glm::ivec2(800, 700), glm::ivec2(1280, 800)}) {
    imaging::RoomPicture asked;
    asked.width_px = size.x;
    asked.height_px = size.y;
    asked.camera = imaging::room_camera(room, scene, state, imaging::RoomView::operator_side);
    for (int views = 1; views <= 2; ++views) {
      // The best picture, to compare with.
      asked.views = views;
      asked.quality = {8, 4096, 2048, true};
      renderer.draw(list, asked);
      const std::vector<std::uint8_t> best = renderer.read_rgba();
      // Each quality, of a patient who lies still and of one whose skin is pressed anew for every picture.
      for (const Choice& choice : kChoices)
        for (const bool moves : {false, true}) {
          asked.quality = choice.quality;
          std::size_t drawn = 0;
          const auto draw = [&] {
            renderer.draw(list, asked, moves ? pressed[++drawn % pressed.size()] : tissue::Displacement{});
            renderer.wait();
          };
          draw();  // warm: maps and, once, shaders are made
          // The time, and of a still patient how far the picture is from the best one.
          BenchRow row{"room",
                       moves ? "skin pressed" : "skin still",
                       std::string(choice.name) + (views == 2 ? ", stereo" : "") + ", " +
                           std::to_string(triangles) + " triangles",
                       "gpu",
                       context->renderer(),
                       std::to_string(size.x) + "x" + std::to_string(size.y),
                       0,
                       0,
                       0,
                       0,
                       "",
                       "",
                       ""};
          time_into(row, quick ? 5 : 21, draw);
          if (!moves) {
            row.error = bench_number(mean_difference(renderer.read_rgba(), best));
            row.error_unit = "grey mean abs";
            row.reference = "8 samples a pixel (or as many as this GL has), maps 4096 2048";
          }
          rows.push_back(row);
        }
    }
  }
  return {};
}

}  // namespace seldinger::measure

#include "sim/imaging/room/room_renderer.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <string_view>

#include "shaders/shared/room.glsl.h"
#include "sim/base/check.h"
#include "sim/base/embedded.h"
#include "sim/gpu/buffer.h"
#include "sim/gpu/raster.h"
#include "sim/gpu/triangles.h"

namespace seldinger::embedded {
std::span<const base::EmbeddedFile> room_shaders();
}

namespace seldinger::imaging {
namespace {

using shaders::RoomThing;
static_assert(offsetof(shaders::RoomView, eye_mm) == 192);
static_assert(sizeof(shaders::RoomView) == 272);
static_assert(sizeof(RoomThing) == 112);

constexpr int kViewBinding = 0, kThingBinding = 1, kSourcesBinding = 2;
constexpr int kStillUnit = 0, kToolsUnit = 1;
constexpr std::size_t kThingStride = gpu::kUniformAlignment, kViewStride = 2 * gpu::kUniformAlignment;
constexpr std::size_t kMostViews = 4;  // two lights' and two eyes'
static_assert(sizeof(RoomThing) <= kThingStride && sizeof(shaders::RoomView) <= kViewStride);

std::string_view shader(std::string_view name) {
  return base::content_of(embedded::room_shaders(), name);
}

glm::vec4 vec4_from(const glm::dvec3& xyz, double w = 0.0) {
  return glm::vec4(glm::dvec4(xyz, w));
}

// A ball around what casts.
struct Ball {
  glm::dvec3 middle{0.0};
  double radius_mm = 0.0;
};

// What a light far away sees of a ball.
struct LightFrame {
  glm::dmat4 clip_from_lps{1.0};
  glm::dmat4 map_from_lps{1.0};  // 0 to 1
};
LightFrame light_frame(const glm::dvec3& towards_light, const Ball& ball) {
  const glm::dvec3 aside = std::abs(towards_light.z) < 0.9 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(0.0, 1.0, 0.0);
  const double r = ball.radius_mm;
  const glm::dmat4 eye = glm::lookAt(ball.middle + r * towards_light, ball.middle, aside);
  LightFrame frame;
  frame.clip_from_lps = glm::ortho(-r, r, -r, r, 0.0, 2.0 * r) * eye;
  frame.map_from_lps = glm::translate(glm::dmat4(1.0), glm::dvec3(0.5)) *
                       glm::scale(glm::dmat4(1.0), glm::dvec3(0.5)) * frame.clip_from_lps;
  return frame;
}

}  // namespace

struct RoomRenderer::Parts {
  Parts(gpu::Context& made_with, const RoomModel& scene)
      : context(made_with),
        plain(made_with, shader("room.vert"), shader("room_plain.frag")),
        depth(made_with, shader("room.vert"), shader("room_depth.frag")),
        picture(made_with),
        views(made_with, gpu::BufferUse::uniform, kMostViews * kViewStride),
        things(made_with, gpu::BufferUse::uniform, 64 * kThingStride),
        frame(scene.frame) {
    for (const RoomMesh& mesh : scene.meshes) {
      meshes.push_back(std::make_unique<gpu::Triangles>(made_with, mesh.vertices, mesh.triangles));
      Ball ball;
      glm::dvec3 low(std::numeric_limits<double>::max()), high = -low;
      for (const gpu::Vertex& vertex : mesh.vertices) {
        low = glm::min(low, glm::dvec3(vertex.place_mm));
        high = glm::max(high, glm::dvec3(vertex.place_mm));
      }
      ball.middle = 0.5 * (low + high);
      for (const gpu::Vertex& vertex : mesh.vertices)
        ball.radius_mm = std::max(ball.radius_mm, glm::distance(ball.middle, glm::dvec3(vertex.place_mm)));
      balls.push_back(ball);
    }
    const glm::dvec3 patient = 0.5 * (frame.high_mm - frame.low_mm);
    key = scene.key_light;
    still_ball = {frame.middle_lps_mm(), glm::length(patient) + 120.0};
  }

  enum class Turn { opaque, transparent, over_all };
  void draw_items(const DrawList& list, gpu::Raster& raster, Turn turn);
  void draw_item(const RoomItem& item, std::size_t at, gpu::RasterProgram& still, gpu::RasterProgram* displaced);
  void draw_casters(const DrawList& list, gpu::Raster& raster, Casts casts);
  std::optional<Ball> tools_ball(const DrawList& list) const;
  bool still_casters_moved(const DrawList& list) const;
  void note_still_places(const DrawList& list);
  void upload(const DrawList& list, const RoomPicture& asked);

  gpu::Context& context;
  // Made when first asked for: few quality settings are used in a session, and most patients lie still.
  gpu::RasterProgram& shade_program(bool displaced) {
    std::optional<gpu::RasterProgram>& program = shades[soft ? 1 : 0][displaced ? 1 : 0];
    if (!program)
      program.emplace(context, shader(displaced ? "room_displaced.vert" : "room.vert"),
                      shader(soft ? "room_shade.frag" : "room_shade_fast.frag"));
    return *program;
  }

  gpu::RasterProgram plain, depth;
  std::optional<gpu::RasterProgram> shades[2][2], depth_displaced;
  bool soft = true;  // in this picture
  std::optional<gpu::Buffer> sources;
  std::optional<gpu::DepthMap> still_map, tools_map;
  gpu::Picture picture;
  gpu::Buffer views, things;
  std::vector<std::byte> bytes;
  std::vector<std::unique_ptr<gpu::Triangles>> meshes;
  std::vector<Ball> balls;
  RoomFrame frame;
  glm::dvec3 key{0.0};
  Ball still_ball;
  bool moving = false;  // in this picture
  bool still_map_is_right = false;
  tissue::Displacement still_displacement{};  // that it shows
  std::vector<glm::dmat4> still_places;       // of what is drawn into it
  int still_age = 0;                          // pictures of another displacement or place since
  int uploads = 0, still_draws = 0;
};

RoomQuality room_quality(const gpu::Context& context) noexcept {
  return context.software() ? kFastRoom : RoomQuality{};
}

RoomRenderer::RoomRenderer(gpu::Context& context, const RoomModel& scene)
    : parts_(std::make_unique<Parts>(context, scene)) {}

RoomRenderer::~RoomRenderer() = default;

int RoomRenderer::displacement_uploads() const noexcept {
  return parts_->uploads;
}
int RoomRenderer::still_shadow_draws() const noexcept {
  return parts_->still_draws;
}

const glm::dvec3& RoomRenderer::key_light() const noexcept {
  return parts_->key;
}

void RoomRenderer::wait() const {
  gpu::Raster(parts_->context).finish();
}

std::vector<std::uint8_t> RoomRenderer::read_rgba() const {
  std::vector<std::uint8_t> rgba(static_cast<std::size_t>(parts_->picture.width_px()) *
                                 static_cast<std::size_t>(parts_->picture.height_px()) * 4);
  parts_->picture.read(rgba);
  return rgba;
}

void RoomRenderer::Parts::draw_item(const RoomItem& item, std::size_t at, gpu::RasterProgram& still,
                                    gpu::RasterProgram* displaced) {
  things.bind_part(kThingBinding, at * kThingStride, sizeof(RoomThing));
  (displaced != nullptr && item.displaced ? *displaced : still).use();
  meshes[item.mesh]->draw();
}

void RoomRenderer::Parts::draw_items(const DrawList& list, gpu::Raster& raster, Turn turn) {
  raster.blend(turn != Turn::opaque);
  raster.depth_test(turn != Turn::over_all);
  for (std::size_t i = 0; i < list.items.size(); ++i) {
    const RoomItem& item = list.items[i];
    const Turn its = item.over_all ? Turn::over_all : item.colour.a < 1.0F ? Turn::transparent : Turn::opaque;
    if (its != turn) continue;
    raster.both_sides(item.both_sides);
    raster.clip(item.cut && list.cut);
    gpu::RasterProgram* displaced = moving && item.displaced ? &shade_program(true) : nullptr;
    draw_item(item, i, item.shadowed ? shade_program(false) : plain, displaced);
  }
  raster.blend(false);
  raster.depth_test(true);
}

void RoomRenderer::Parts::draw_casters(const DrawList& list, gpu::Raster& raster, Casts casts) {
  raster.both_sides(true);
  for (std::size_t i = 0; i < list.items.size(); ++i)
    if (list.items[i].casts == casts) draw_item(list.items[i], i, depth, moving ? &*depth_displaced : nullptr);
  raster.both_sides(false);
}

// Since the map was drawn: a C-arm does, now and then.
bool RoomRenderer::Parts::still_casters_moved(const DrawList& list) const {
  std::size_t at = 0;
  for (const RoomItem& item : list.items)
    if (item.casts == Casts::still && (at == still_places.size() || still_places[at++] != item.lps_from_mesh))
      return true;
  return at != still_places.size();
}

void RoomRenderer::Parts::note_still_places(const DrawList& list) {
  still_places.clear();
  for (const RoomItem& item : list.items)
    if (item.casts == Casts::still) still_places.push_back(item.lps_from_mesh);
}

std::optional<Ball> RoomRenderer::Parts::tools_ball(const DrawList& list) const {
  glm::dvec3 low(std::numeric_limits<double>::max()), high = -low;
  for (const RoomItem& item : list.items) {
    if (item.casts != Casts::tools) continue;
    const Ball& ball = balls[item.mesh];
    const glm::dvec3 middle(item.lps_from_mesh * glm::dvec4(ball.middle, 1.0));
    const double longest =
        std::max({glm::length(glm::dvec3(item.lps_from_mesh[0])), glm::length(glm::dvec3(item.lps_from_mesh[1])),
                  glm::length(glm::dvec3(item.lps_from_mesh[2]))});
    low = glm::min(low, middle - longest * ball.radius_mm);
    high = glm::max(high, middle + longest * ball.radius_mm);
  }
  if (low.x > high.x) return std::nullopt;
  return Ball{0.5 * (low + high), 0.5 * glm::distance(low, high)};
}

unsigned int RoomRenderer::draw(const DrawList& list, const RoomPicture& asked,
                                const tissue::Displacement& displacement) {
  CHECK(asked.views == 1 || asked.views == 2);
  CHECK(asked.width_px >= asked.views && asked.height_px >= 1);
  Parts& p = *parts_;
  gpu::Raster raster(p.context);
  p.picture.resize(asked.width_px, asked.height_px, asked.quality.samples);
  if (!p.still_map || p.still_map->side_px() != asked.quality.still_shadow_px) {
    p.still_map.emplace(p.context, asked.quality.still_shadow_px);
    p.still_map_is_right = false;
  }
  if (!p.tools_map || p.tools_map->side_px() != asked.quality.tools_shadow_px)
    p.tools_map.emplace(p.context, asked.quality.tools_shadow_px);
  p.soft = asked.quality.soft_shadows;
  const bool moved_before = p.moving;
  p.moving = list.needs_displacement && tissue::count_sources(displacement) > 0;
  if (p.moving) {
    if (!p.depth_displaced) {
      p.depth_displaced.emplace(p.context, shader("room_displaced.vert"), shader("room_depth.frag"));
      p.sources.emplace(p.context, gpu::BufferUse::uniform, sizeof(tissue::Displacement));
    }
    p.sources->write(std::as_bytes(std::span(&displacement, 1)));
    p.sources->bind(kSourcesBinding);
    ++p.uploads;
  }
  if (p.moving != moved_before) p.still_map_is_right = false;
  const bool displaced_since =
      p.moving && std::memcmp(&p.still_displacement, &displacement, sizeof displacement) != 0;
  if ((displaced_since || p.still_casters_moved(list)) && ++p.still_age > asked.quality.still_shadow_age)
    p.still_map_is_right = false;

  // Everything that is told to the shaders goes up at once: writing between two drawings would make GL wait.
  p.upload(list, asked);

  if (!p.still_map_is_right) {
    p.views.bind_part(kViewBinding, 0, sizeof(shaders::RoomView));
    p.still_map->begin();
    raster.depth_offset(2.0F, 4.0F);
    raster.clamp_depth(true);  // a detector is nearer to the light than what the map is about
    p.draw_casters(list, raster, Casts::still);
    raster.clamp_depth(false);
    p.still_map_is_right = true;
    p.still_displacement = p.moving ? displacement : tissue::Displacement{};
    p.still_age = 0;
    p.note_still_places(list);
    ++p.still_draws;
  }
  p.views.bind_part(kViewBinding, kViewStride, sizeof(shaders::RoomView));
  p.tools_map->begin();
  raster.depth_offset(1.0F, 1.0F);
  p.draw_casters(list, raster, Casts::tools);
  raster.depth_offset(0.0F, 0.0F);

  p.picture.begin({0.35F, 0.37F, 0.38F, 1.0F});
  p.still_map->bind(kStillUnit);
  p.tools_map->bind(kToolsUnit);
  const int width_px = asked.width_px / asked.views;
  for (int eye = 0; eye < asked.views; ++eye) {
    p.views.bind_part(kViewBinding, static_cast<std::size_t>(2 + eye) * kViewStride, sizeof(shaders::RoomView));
    raster.part(eye * width_px, 0, width_px, asked.height_px);
    for (const Parts::Turn turn : {Parts::Turn::opaque, Parts::Turn::transparent, Parts::Turn::over_all})
      p.draw_items(list, raster, turn);
  }
  p.picture.finish();
  raster.check("drawing the room");
  return p.picture.texture();
}

void RoomRenderer::Parts::upload(const DrawList& list, const RoomPicture& asked) {
  const LightFrame still = light_frame(key, still_ball);
  const Ball tools_in = tools_ball(list).value_or(still_ball);
  const LightFrame tools = light_frame(key, tools_in);
  bytes.assign(kMostViews * kViewStride, std::byte{0});
  const auto put_view = [&](std::size_t at, const glm::dmat4& clip_from_lps, const glm::dvec3& eye) {
    shaders::RoomView view{};
    view.clip_from_lps = glm::mat4(clip_from_lps);
    view.still_from_lps = glm::mat4(still.map_from_lps);
    view.tools_from_lps = glm::mat4(tools.map_from_lps);
    view.eye_mm = vec4_from(eye);
    view.key = vec4_from(key);
    view.up = vec4_from(frame.up);
    if (list.cut) view.cut = vec4_from(list.cut->normal, list.cut->distance_mm);
    const double still_texel_mm = 2.0 * still_ball.radius_mm / asked.quality.still_shadow_px;
    const double tools_texel_mm = 2.0 * tools_in.radius_mm / asked.quality.tools_shadow_px;
    view.shadow = glm::vec4(1.5 * still_texel_mm, 0.5 * tools_texel_mm, 1.0 / asked.quality.still_shadow_px,
                            1.0 / asked.quality.tools_shadow_px);
    std::memcpy(bytes.data() + at * kViewStride, &view, sizeof view);
  };
  put_view(0, still.clip_from_lps, still_ball.middle + key);
  put_view(1, tools.clip_from_lps, tools_in.middle + key);
  const double width_per_height =
      static_cast<double>(asked.width_px / asked.views) / static_cast<double>(asked.height_px);
  for (int eye = 0; eye < asked.views; ++eye) {
    const RoomProjection projection =
        projection_of(asked.camera, asked.views == 1 ? 0 : 2 * eye - 1, width_per_height);
    put_view(static_cast<std::size_t>(2 + eye), projection.clip_from_eye * projection.eye_from_lps,
             projection.eye_lps_mm);
  }
  views.write(bytes);

  const double mm_per_px_and_mm =
      2.0 * std::tan(asked.camera.height_deg * std::numbers::pi / 360.0) / asked.height_px;
  bytes.assign(list.items.size() * kThingStride, std::byte{0});
  for (std::size_t i = 0; i < list.items.size(); ++i) {
    const RoomItem& item = list.items[i];
    CHECK(item.mesh < meshes.size());
    glm::dmat4 lps_from_mesh = item.lps_from_mesh;
    if (item.least_half_px > 0.0) {
      const double away_mm = glm::distance(asked.camera.eye_lps_mm, glm::dvec3(lps_from_mesh[3]));
      const double radius_mm = glm::length(glm::dvec3(lps_from_mesh[0]));
      const double wider = std::max(1.0, item.least_half_px * mm_per_px_and_mm * away_mm / radius_mm);
      lps_from_mesh[0] *= wider;
      lps_from_mesh[1] *= wider;
    }
    RoomThing thing{};
    thing.lps_from_mesh = glm::mat4(lps_from_mesh);
    thing.colour = item.colour;
    thing.surface = {item.roughness, item.metal, item.shadowed ? 1.0F : 0.0F, item.cut ? 1.0F : 0.0F};
    thing.depth = glm::vec4(item.light_under_skin, 0.0F);
    std::memcpy(bytes.data() + i * kThingStride, &thing, sizeof thing);
  }
  if (things.size() < bytes.size()) things.resize(2 * bytes.size());
  if (!bytes.empty()) things.write(bytes);
}

}  // namespace seldinger::imaging

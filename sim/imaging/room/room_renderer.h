// Draws the room into a texture, with GL 4.3 and without a window.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "sim/gpu/context.h"
#include "sim/imaging/room/draw_list.h"
#include "sim/imaging/room/room_camera.h"
#include "sim/imaging/room/room_model.h"
#include "sim/tissue/displacement.h"

namespace seldinger::imaging {

// What a picture may cost.
struct RoomQuality {
  int samples = 4;             // of a pixel; 1: edges are steps
  int still_shadow_px = 2048;  // sides of the shadow maps
  int tools_shadow_px = 1024;
  bool soft_shadows = true;  // four looks into each map in place of one
  // While tissue moves: the shadows of what else lies still may be those of so many pictures before. The tools' are
  // always new.
  int still_shadow_age = 0;
};
constexpr RoomQuality kFastRoom = {1, 1024, 512, false, 3};
RoomQuality room_quality(const gpu::Context& context) noexcept;  // less on software GL

struct RoomPicture {
  int width_px = 800, height_px = 700;  // of the whole picture
  int views = 1;                        // 2: a pair side by side, the left eye's on the left
  RoomCamera camera;
  RoomQuality quality;
};

class RoomRenderer {
 public:
  // Uploads the scene's meshes; does not keep `scene`. Throws base::Failure("gl").
  RoomRenderer(gpu::Context& context, const RoomModel& scene);
  ~RoomRenderer();

  // The GL name of an RGBA8 texture in the context's share: the first row is the lowest, so ImGui shows it with uv
  // (0, 1) to (1, 0). It stays the renderer's and is drawn over by the next call. GL's state is as before. Without
  // sources in `displacement`, or without anything in the list that it moves, nothing of it is uploaded.
  unsigned int draw(const DrawList& list, const RoomPicture& picture,
                    const tissue::Displacement& displacement = {});

  // The last picture: width · height · 4 bytes, the first row the highest. Waits for it.
  std::vector<std::uint8_t> read_rgba() const;

  void wait() const;  // until it is drawn

  const glm::dvec3& key_light() const noexcept;  // unit, towards it (LPS)

  // For tests: how often so far a displacement was uploaded, and the still things' shadows were drawn.
  int displacement_uploads() const noexcept;
  int still_shadow_draws() const noexcept;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace seldinger::imaging

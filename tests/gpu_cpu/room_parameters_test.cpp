// The blocks that the room's shaders read have the offsets that C++ writes: the GLSL compiler's answer against
// offsetof.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <span>
#include <string>

#include "shaders/shared/room.glsl.h"
#include "sim/base/embedded.h"
#include "tests/gpu_cpu/shader_offsets.h"

namespace seldinger::embedded {
std::span<const base::EmbeddedFile> room_shaders();
}

namespace seldinger::imaging {
namespace {

TEST(RoomParameters, HaveTheOffsetsOfTheShadersBlocks) {
  using V = shaders::RoomView;
  using T = shaders::RoomThing;
  const std::map<std::string, std::size_t> view = {{"clip_from_lps", offsetof(V, clip_from_lps)},
                                                   {"still_from_lps", offsetof(V, still_from_lps)},
                                                   {"tools_from_lps", offsetof(V, tools_from_lps)},
                                                   {"eye_mm", offsetof(V, eye_mm)},
                                                   {"key", offsetof(V, key)},
                                                   {"up", offsetof(V, up)},
                                                   {"cut", offsetof(V, cut)},
                                                   {"shadow", offsetof(V, shadow)}};
  const std::map<std::string, std::size_t> thing = {{"lps_from_mesh", offsetof(T, lps_from_mesh)},
                                                    {"colour", offsetof(T, colour)},
                                                    {"surface", offsetof(T, surface)},
                                                    {"depth", offsetof(T, depth)}};
  std::size_t fields = 0;
  for (const base::EmbeddedFile& shader : embedded::room_shaders())
    for (const auto& [block, ours] : {std::pair{"view", view}, std::pair{"thing", thing}})
      for (const auto& [field, offset] : offsets_from_compiler(shader, block)) {
        ASSERT_TRUE(ours.contains(field)) << shader.name << " " << field;
        EXPECT_EQ(ours.at(field), offset) << shader.name << " " << field;
        ++fields;
      }
  EXPECT_GT(fields, 20U);
}

}  // namespace
}  // namespace seldinger::imaging

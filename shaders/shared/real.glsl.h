// The adapter that lets a formula be written once: as GLSL in float and as C++ in double (GLM).
//
// Rules for files that use it: the common subset of both languages; `real`, `real3`, `real4` and `int3` for values;
// no swizzles (real3(v.x, v.y, v.z)); every function is SHARED; structs only of float, int, uint, vec4 and mat4,
// which are float in both languages, because they travel in std140 blocks.
#ifndef SELDINGER_SHADERS_SHARED_REAL
#define SELDINGER_SHADERS_SHARED_REAL

#ifdef __cplusplus

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace seldinger::shaders {
using real = double;
using real3 = glm::dvec3;
using real4 = glm::dvec4;
using int3 = glm::ivec3;
using glm::abs;
using glm::clamp;
using glm::dot;
using glm::mat4;
using glm::max;
using glm::min;
using glm::vec4;
using std::floor;
using std::sqrt;
using uint = std::uint32_t;
}  // namespace seldinger::shaders

#define SHARED_BEGIN namespace seldinger::shaders {
#define SHARED_END }
#define SHARED inline
#define SHARED_CONSTANT inline constexpr

#else

#define real float
#define real3 vec3
#define real4 vec4
#define int3 ivec3
#define SHARED_BEGIN
#define SHARED_END
#define SHARED
#define SHARED_CONSTANT const

#endif

#endif

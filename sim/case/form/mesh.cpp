#include "sim/case/form/mesh.h"

#include <cmath>
#include <cstring>

#include "sim/base/codec.h"

namespace seldinger::cases {
namespace {

constexpr std::uint32_t kMagic = 0x4d4c4453;  // "SDLM"
constexpr std::uint32_t kFormat = 1;
constexpr std::uint32_t kMaxCount = 20'000'000;  // 20 million triangles are 500 MB: no skin needs more
constexpr float kFarthestVertexMm = 1e7F;        // ten times what import takes of an origin

struct Header {
  std::uint32_t magic, format, vertices, triangles;
};

}  // namespace

std::vector<std::byte> bytes_from_mesh(const Mesh& mesh) {
  CHECK(mesh.cut.size() == mesh.triangles.size());
  const Header header{kMagic, kFormat, static_cast<std::uint32_t>(mesh.vertices_lps_mm.size()),
                      static_cast<std::uint32_t>(mesh.triangles.size())};
  std::vector<std::byte> raw(sizeof header + mesh.vertices_lps_mm.size() * 12 + mesh.triangles.size() * 13);
  std::byte* at = raw.data();
  const auto put = [&at](const void* from, std::size_t size) {
    if (size > 0) std::memcpy(at, from, size);
    at += size;
  };
  put(&header, sizeof header);
  put(mesh.vertices_lps_mm.data(), mesh.vertices_lps_mm.size() * 12);
  put(mesh.triangles.data(), mesh.triangles.size() * 12);
  put(mesh.cut.data(), mesh.cut.size());
  return base::compress(raw);
}

base::Result<Mesh> mesh_from_bytes(std::span<const std::byte> bytes) {
  static_assert(sizeof(glm::vec3) == 12 && sizeof(glm::uvec3) == 12);
  const base::Error damaged{"damaged", "the stored skin is damaged"};
  const auto raw = base::decompress(bytes, sizeof(Header) + static_cast<std::size_t>(kMaxCount) * 25);
  Header header{};
  if (!raw || raw->size() < sizeof header) return damaged;
  std::memcpy(&header, raw->data(), sizeof header);
  if (header.magic != kMagic || header.format != kFormat || header.vertices > kMaxCount ||
      header.triangles > kMaxCount ||
      raw->size() != sizeof header + std::size_t{header.vertices} * 12 + std::size_t{header.triangles} * 13)
    return damaged;
  Mesh mesh;
  mesh.vertices_lps_mm.resize(header.vertices);
  mesh.triangles.resize(header.triangles);
  mesh.cut.resize(header.triangles);
  const std::byte* at = raw->data() + sizeof header;
  const auto get = [&at](void* to, std::size_t size) {
    if (size > 0) std::memcpy(to, at, size);
    at += size;
  };
  get(mesh.vertices_lps_mm.data(), mesh.vertices_lps_mm.size() * 12);
  get(mesh.triangles.data(), mesh.triangles.size() * 12);
  get(mesh.cut.data(), mesh.cut.size());
  for (const glm::vec3& vertex : mesh.vertices_lps_mm)
    for (int axis = 0; axis < 3; ++axis)
      if (!(std::abs(vertex[axis]) <= kFarthestVertexMm)) return damaged;
  for (const glm::uvec3& triangle : mesh.triangles)
    if (triangle.x >= header.vertices || triangle.y >= header.vertices || triangle.z >= header.vertices)
      return damaged;
  for (const std::uint8_t cut : mesh.cut)
    if (cut > 1) return damaged;
  return mesh;
}

}  // namespace seldinger::cases

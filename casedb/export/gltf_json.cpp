#include "casedb/export/gltf_json.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "sim/base/check.h"
#include "sim/base/training_only.h"

namespace seldinger::casedb {
namespace {

using Json = nlohmann::ordered_json;

// Numbers of the specification.
constexpr std::uint32_t kMagic = 0x46546c67, kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942, kVersion = 2;
constexpr int kFloat = 5126, kUnsignedInt = 5125, kVertexBuffer = 34962, kIndexBuffer = 34963;

static_assert(sizeof(glm::vec3) == 12);

void append(std::vector<std::byte>& out, std::uint32_t word) {
  const auto at = out.size();
  out.resize(at + sizeof word);
  std::memcpy(out.data() + at, &word, sizeof word);  // little-endian, as all we run on
}

template <typename T>
std::size_t append(std::vector<std::byte>& out, const std::vector<T>& items) {
  const auto at = out.size();
  const auto bytes = std::as_bytes(std::span(items));
  out.insert(out.end(), bytes.begin(), bytes.end());
  return at;
}

std::vector<glm::vec3> normals_of(const cases::Mesh& mesh) {
  std::vector<glm::vec3> normals(mesh.vertices_lps_mm.size(), glm::vec3(0.0F));
  for (const glm::uvec3& triangle : mesh.triangles) {
    const glm::vec3 a = mesh.vertices_lps_mm[triangle.x], b = mesh.vertices_lps_mm[triangle.y],
                    c = mesh.vertices_lps_mm[triangle.z];
    const glm::vec3 weighted = glm::cross(b - a, c - a);  // twice its area
    for (const std::uint32_t vertex : {triangle.x, triangle.y, triangle.z}) normals[vertex] += weighted;
  }
  for (glm::vec3& normal : normals) {
    const float length = glm::length(normal);
    normal = length > 0.0F ? normal / length : glm::vec3(0.0F, 0.0F, 1.0F);
  }
  return normals;
}

Json triple(const glm::vec3& p) {
  return Json::array({p.x, p.y, p.z});
}

}  // namespace

std::vector<std::byte> glb_of(const cases::Mesh& mesh) {
  CHECK(!mesh.triangles.empty());
  std::vector<std::byte> binary;
  Json views = Json::array(), accessors = Json::array(), parts = Json::array();
  const auto view = [&](std::size_t from, int target) {
    views.push_back(
        {{"buffer", 0}, {"byteOffset", from}, {"byteLength", binary.size() - from}, {"target", target}});
    return views.size() - 1;
  };
  glm::vec3 low = mesh.vertices_lps_mm.at(0), high = low;
  for (const glm::vec3& p : mesh.vertices_lps_mm) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  accessors.push_back({{"bufferView", view(append(binary, mesh.vertices_lps_mm), kVertexBuffer)},
                       {"componentType", kFloat},
                       {"count", mesh.vertices_lps_mm.size()},
                       {"type", "VEC3"},
                       {"min", triple(low)},
                       {"max", triple(high)}});
  accessors.push_back({{"bufferView", view(append(binary, normals_of(mesh)), kVertexBuffer)},
                       {"componentType", kFloat},
                       {"count", mesh.vertices_lps_mm.size()},
                       {"type", "VEC3"}});
  Json materials = Json::array();
  const std::array<const char*, 2> names = {"skin", "cut"};
  for (std::uint8_t cut = 0; cut < 2; ++cut) {
    std::vector<glm::uvec3> triangles;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
      if ((mesh.cut.empty() ? 0 : mesh.cut[i]) == cut) triangles.push_back(mesh.triangles[i]);
    if (triangles.empty()) continue;
    accessors.push_back({{"bufferView", view(append(binary, triangles), kIndexBuffer)},
                         {"componentType", kUnsignedInt},
                         {"count", 3 * triangles.size()},
                         {"type", "SCALAR"}});
    const Json colour = cut == 0 ? Json::array({0.86, 0.65, 0.54, 1.0}) : Json::array({0.5, 0.5, 0.5, 1.0});
    materials.push_back({{"name", names[cut]},
                         {"pbrMetallicRoughness",
                          {{"baseColorFactor", colour}, {"metallicFactor", 0.0}, {"roughnessFactor", 0.8}}}});
    parts.push_back({{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}},
                     {"indices", accessors.size() - 1},
                     {"material", materials.size() - 1}});
  }
  // Column by column: left is x, head is y, front (against P) is z; mm to m.
  const Json node = {{"mesh", 0},
                     {"name", "patient"},
                     {"matrix", Json::array({0.001, 0, 0, 0, 0, 0, -0.001, 0, 0, 0.001, 0, 0, 0, 0, 0, 1})}};
  const Json document = {
      {"asset", {{"version", "2.0"}, {"generator", std::string("Seldinger. ") + base::kTrainingOnly}}},
      {"scene", 0},
      {"scenes", Json::array({Json{{"nodes", Json::array({0})}}})},
      {"nodes", Json::array({node})},
      {"meshes", Json::array({Json{{"name", "surface"}, {"primitives", parts}}})},
      {"materials", materials},
      {"accessors", accessors},
      {"bufferViews", views},
      {"buffers", Json::array({Json{{"byteLength", binary.size()}}})}};
  std::string text = document.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::vector<std::byte> file;
  append(file, kMagic);
  append(file, kVersion);
  append(file, static_cast<std::uint32_t>(12 + 8 + text.size() + 8 + binary.size()));
  append(file, static_cast<std::uint32_t>(text.size()));
  append(file, kJsonChunk);
  const auto text_bytes = std::as_bytes(std::span(text));
  file.insert(file.end(), text_bytes.begin(), text_bytes.end());
  append(file, static_cast<std::uint32_t>(binary.size()));
  append(file, kBinaryChunk);
  file.insert(file.end(), binary.begin(), binary.end());
  return file;
}

}  // namespace seldinger::casedb

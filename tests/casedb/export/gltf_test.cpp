// Tests of casedb/export/gltf_json: the file's own lengths and offsets, and the vertices back as they were, in
// place.
#include "casedb/export/gltf_json.h"

#include <gtest/gtest.h>

#include <cstring>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <nlohmann/json.hpp>

#include "tests/fixtures/meshes.h"

namespace seldinger::casedb {
namespace {

struct Glb {
  nlohmann::json document;
  std::vector<std::byte> binary;
};

std::uint32_t word_at(const std::vector<std::byte>& bytes, std::size_t at) {
  std::uint32_t word = 0;
  EXPECT_LE(at + 4, bytes.size());
  std::memcpy(&word, bytes.data() + at, 4);
  return word;
}

Glb read(const std::vector<std::byte>& file) {
  Glb glb;
  EXPECT_EQ(std::memcmp(file.data(), "glTF", 4), 0);
  EXPECT_EQ(word_at(file, 4), 2U);
  EXPECT_EQ(word_at(file, 8), file.size());
  const std::uint32_t json_bytes = word_at(file, 12);
  EXPECT_EQ(json_bytes % 4, 0U);
  EXPECT_EQ(std::memcmp(file.data() + 16, "JSON", 4), 0);
  glb.document = nlohmann::json::parse(std::string(reinterpret_cast<const char*>(file.data()) + 20, json_bytes));
  const std::size_t binary_at = 20 + json_bytes;
  EXPECT_EQ(word_at(file, binary_at) % 4, 0U);
  EXPECT_EQ(std::memcmp(file.data() + binary_at + 4, "BIN\0", 4), 0);
  glb.binary.assign(file.begin() + static_cast<std::ptrdiff_t>(binary_at + 8), file.end());
  EXPECT_EQ(glb.binary.size(), word_at(file, binary_at));
  EXPECT_EQ(glb.binary.size(), glb.document["buffers"][0]["byteLength"]);
  return glb;
}

template <typename T>
std::vector<T> items(const Glb& glb, std::size_t accessor, std::size_t per_item) {
  const auto& one = glb.document["accessors"][accessor];
  const auto& view = glb.document["bufferViews"][one["bufferView"].get<std::size_t>()];
  std::vector<T> found(one["count"].get<std::size_t>() / per_item);
  EXPECT_EQ(view["byteLength"], found.size() * sizeof(T));
  const std::size_t from = view["byteOffset"];
  EXPECT_LE(from + found.size() * sizeof(T), glb.binary.size());
  std::memcpy(static_cast<void*>(found.data()), glb.binary.data() + from, found.size() * sizeof(T));
  return found;
}

TEST(Gltf, ASurfaceComesBackInTheBrowsersFrame) {
  cases::Mesh mesh = fixtures::sphere_mesh({30.0, -20.0, 500.0}, 80.0, 3, 0.0);
  mesh.cut.assign(mesh.triangles.size(), 0);
  for (std::size_t i = 0; i < 40; ++i) mesh.cut[i] = 1;
  const Glb glb = read(glb_of(mesh));
  EXPECT_EQ(items<glm::vec3>(glb, 0, 1), mesh.vertices_lps_mm);
  for (std::size_t i = 0; const glm::vec3& normal : items<glm::vec3>(glb, 1, 1)) {
    const glm::vec3 outward = (mesh.vertices_lps_mm[i++] - glm::vec3(30.0F, -20.0F, 500.0F)) / 80.0F;
    EXPECT_NEAR(glm::dot(normal, outward), 1.0F, 0.02F);
  }
  const auto& parts = glb.document["meshes"][0]["primitives"];
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(items<glm::uvec3>(glb, parts[0]["indices"], 3).size(), mesh.triangles.size() - 40);
  EXPECT_EQ(items<glm::uvec3>(glb, parts[1]["indices"], 3).size(), 40U);
  EXPECT_EQ(items<glm::uvec3>(glb, parts[1]["indices"], 3)[0], mesh.triangles[0]);
  EXPECT_EQ(glb.document["accessors"][0]["min"][0].get<float>(), -50.0F);
  const auto m = glb.document["nodes"][0]["matrix"].get<std::vector<double>>();
  const glm::dmat3 turn(m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]);
  EXPECT_EQ(turn * glm::dvec3(1000, 0, 0), glm::dvec3(1, 0, 0)) << "left";
  EXPECT_EQ(turn * glm::dvec3(0, 0, 1000), glm::dvec3(0, 1, 0)) << "head is up";
  EXPECT_EQ(turn * glm::dvec3(0, -1000, 0), glm::dvec3(0, 0, 1)) << "the front looks at you";
  EXPECT_GT(glm::determinant(turn), 0.0) << "no mirror";
}

TEST(Gltf, WithoutCapsThereIsOnePart) {
  const cases::Mesh mesh = fixtures::box_mesh({0, 0, 0}, {10, 20, 30});
  EXPECT_EQ(read(glb_of(mesh)).document["meshes"][0]["primitives"].size(), 1U);
}

}  // namespace
}  // namespace seldinger::casedb

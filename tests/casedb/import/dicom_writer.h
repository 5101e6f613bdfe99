// Writes small DICOM files from nothing but PS3.5 and PS3.10, so that the reader is tested against another hand.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace seldinger::casedb {

enum class TestSyntax { implicit_le, explicit_le, explicit_be, deflated };

class TestDicom {
 public:
  // A sound CT slice of columns × rows whose stored pixel i is `first_value` + i, with a patient's name and such in
  // it.
  static TestDicom ct_slice(glm::ivec2 size, int first_value = 0);

  TestDicom& text(std::uint32_t tag, const char* vr, const std::string& value);
  TestDicom& u16(std::uint32_t tag, const char* vr, int value);
  TestDicom& raw(std::uint32_t tag, const char* vr, const std::string& little_endian_bytes);
  TestDicom& remove(std::uint32_t tag);
  TestDicom& at(const glm::dvec3& position_lps_mm);
  TestDicom& lying(const glm::dvec3& row, const glm::dvec3& column);
  TestDicom& pixels(const std::vector<int>& stored);

  // `pixel_tail` is put behind the pixels; `before_pixels` is spliced in as it is (explicit little endian).
  std::string bytes(TestSyntax syntax = TestSyntax::explicit_le, const std::string& before_pixels = "") const;

 private:
  struct Element {
    std::string vr, value;
    bool words = false;  // 16-bit values: swapped in big endian
  };
  std::map<std::uint32_t, Element> elements_;
};

}  // namespace seldinger::casedb

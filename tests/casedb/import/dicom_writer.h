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
  // Items of undefined length end in delimiters, others say how long they are.
  TestDicom& sequence(std::uint32_t tag, const std::vector<TestDicom>& items, bool undefined_length = false);
  // Packed pixels: one fragment each, behind an offset table (one entry for each of `frame_starts`, in fragments).
  TestDicom& fragments(const std::string& syntax_uid, const std::vector<std::string>& pieces,
                       const std::vector<std::size_t>& frame_starts = {});
  TestDicom& at(const glm::dvec3& position_lps_mm);
  TestDicom& lying(const glm::dvec3& row, const glm::dvec3& column);
  TestDicom& pixels(const std::vector<int>& stored);

  // `before_pixels` is spliced in as it is (explicit little endian).
  std::string bytes(TestSyntax syntax = TestSyntax::explicit_le, const std::string& before_pixels = "") const;
  std::string data_set(bool explicit_vr, bool big_endian, const std::string& before_pixels = "") const;

 private:
  struct Element {
    std::string vr, value;
    bool words = false;  // 16-bit values: swapped in big endian
    std::vector<TestDicom> items{};
    bool undefined_length = false;
  };
  std::map<std::uint32_t, Element> elements_;
  std::string syntax_uid_;  // of packed pixels
};

// What stands before the data set; `with_length`: the meta group's own length, which some writers forget.
std::string dicom_head(const std::string& syntax_uid, bool with_length = true);

// An enhanced CT of columns × rows pixels, 0.5 × 0.25 mm, whose frame k lies at places[k]; frame k's stored pixel i
// is 100 · k + i. Orientation, measures and rescaling are shared.
TestDicom enhanced_ct(glm::ivec2 size, const std::vector<glm::dvec3>& places_lps_mm);

// A frame of 16-bit values as RLE (PS3.5 §G), in literal runs.
std::string rle_frame(const std::vector<int>& stored);

}  // namespace seldinger::casedb

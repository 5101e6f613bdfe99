// Small packed frames for tests, by GDCM's encoders.
#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

namespace seldinger::casedb {

// One frame of signed 16-bit values in the syntax; even length.
std::string packed_frame(const std::string& syntax_uid, glm::ivec2 size, const std::vector<int>& stored);

}  // namespace seldinger::casedb

// Who or what lies on the table.
#pragma once

#include <array>
#include <string_view>

namespace seldinger::cases {

// phantom: a block to practise on. It is nobody: nothing hurts it, it does not breathe, nobody signs in for it.
enum class Subject { patient, phantom };
constexpr std::array<std::string_view, 2> kSubjectNames = {"patient", "phantom"};

}  // namespace seldinger::cases

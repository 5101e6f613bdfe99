// Who or what lies on the table.
#pragma once

#include "sim/base/names.h"

namespace seldinger::cases {

// phantom: a block to practise on. It is nobody: nothing hurts it, it does not breathe, nobody signs in for it.
enum class Subject { patient, phantom };
inline constexpr auto kSubjectNames =
    base::names<Subject>({{Subject::patient, "patient"}, {Subject::phantom, "phantom"}});

}  // namespace seldinger::cases

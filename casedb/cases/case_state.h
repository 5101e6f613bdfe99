// How far a case, or a curriculum, is on its way to trainees. The names are those that the database, JSON and pages
// write.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace seldinger::casedb {

enum class CaseState { draft, review, published, retired };
std::string name_of(CaseState state);
std::optional<CaseState> case_state_from(std::string_view name) noexcept;

enum class CurriculumState { draft, published, retired };
std::string name_of(CurriculumState state);
std::optional<CurriculumState> curriculum_state_from(std::string_view name) noexcept;

}  // namespace seldinger::casedb

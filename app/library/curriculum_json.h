// What the commands about curricula answer.
#pragma once

#include <string>
#include <vector>

#include "casedb/grading/learner_records.h"

namespace seldinger::app {

std::string json_of_curriculum_id(const std::string& curriculum_id);
std::string json_of_curriculum_item(int number);
std::string json_of_curricula(const std::vector<casedb::Curriculum>& curricula);
// With somebody's states, or nobody's.
std::string json_of_curriculum(const casedb::Curriculum& curriculum, const std::vector<casedb::ItemState>& items,
                               bool of_somebody);

}  // namespace seldinger::app

// What a case tells of its source's privacy, in lines for a person.
#pragma once

#include <string>

#include "casedb/cases/cases.h"

namespace seldinger::app {

// Face, burned-in text, and how much of the source stayed outside.
std::string privacy_text(const casedb::CaseRow& row);

}  // namespace seldinger::app

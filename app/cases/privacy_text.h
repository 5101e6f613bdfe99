// What a case tells of its source's privacy, in lines for a person.
#pragma once

#include <string>

#include "casedb/cases/cases.h"
#include "casedb/cases/received.h"

namespace seldinger::app {

// Face, burned-in text, and how much of the source stayed outside.
std::string privacy_text(const casedb::CaseRow& row);
// Of a case that came in a bundle: what its sender says, and who that is.
std::string received_text(const casedb::Received& received);

}  // namespace seldinger::app

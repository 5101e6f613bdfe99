// The study of a command's first word or of its --study, opened for somebody who may.
#pragma once

#include <string>

#include "app/acting/acting.h"
#include "casedb/people/consent.h"

namespace seldinger::app {

struct OpenStudy {
  casedb::Library library;
  casedb::Study study;
};

// `what`: "STUDY", or the option that names it. Refused as open_acting, acting and find_study.
base::Result<OpenStudy> open_study(const Arguments& arguments, const std::string& what, casedb::Action action);

}  // namespace seldinger::app

// The JSON documents of backup, restore, check and bundles.
#pragma once

#include <string>

#include "casedb/keeping/backup.h"
#include "casedb/keeping/bundle.h"
#include "casedb/keeping/check.h"
#include "casedb/keeping/trusted_keys.h"

namespace seldinger::app {

std::string json_of_copied(const casedb::Copied& copied);
std::string json_of_check(const casedb::CheckReport& report);
std::string json_of_bundle(const casedb::Bundle& bundle);
std::string json_of_trusted_keys(const std::vector<casedb::TrustedKey>& keys);
std::string json_of_unbundled(const casedb::Unbundled& cases);

}  // namespace seldinger::app

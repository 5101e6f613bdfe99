// Keys whose signatures under a bundle are known here: a site's public key and what it is called.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "casedb/database/library.h"
#include "sim/base/result.h"

namespace seldinger::casedb {

struct TrustedKey {
  std::string public_key;  // 64 digits of lower-case hexadecimal
  std::string label;
  std::int64_t added_us = 0;  // since 1970 UTC
};

std::vector<TrustedKey> list_trusted_keys(Library& library);  // by label
// `bad_key`, `bad_title` (1 to 100 bytes on one line), `key_known` (the key or the label is there already).
base::Result<void> add_trusted_key(Library& library, const std::string& public_key, const std::string& label);
// By key or label: `no_key`. What came signed by it is told as signed by a key that is not trusted from then on.
base::Result<void> remove_trusted_key(Library& library, const std::string& key_or_label);

}  // namespace seldinger::casedb

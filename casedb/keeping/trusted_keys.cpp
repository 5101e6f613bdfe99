#include "casedb/keeping/trusted_keys.h"

#include <algorithm>

#include "casedb/cases/authoring.h"
#include "casedb/database/audit.h"
#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/uuid.h"

namespace seldinger::casedb {

std::vector<TrustedKey> list_trusted_keys(Library& library) {
  std::vector<TrustedKey> keys;
  for (Statement rows = question(library.database(), "trusted_keys"); rows.step();)
    keys.push_back({rows.text("public_key"), rows.text("label"), rows.integer("added_us")});
  return keys;
}

base::Result<void> add_trusted_key(Library& library, const std::string& public_key, const std::string& label) {
  if (!is_asset_name(public_key))
    return base::Error{"bad_key", "a public key is 64 digits of lower-case hexadecimal, as `bundle key` prints it"};
  if (const auto fit = check_case_title(label); !fit) return fit.error();
  Transaction transaction(library.database());
  const auto known = list_trusted_keys(library);
  if (std::any_of(known.begin(), known.end(),
                  [&](const TrustedKey& one) { return one.public_key == public_key || one.label == label; }))
    return base::Error{"key_known", "that key or that label is among the trusted ones already"};
  question(library.database(), "add_trusted_key")
      .bind("public_key", public_key)
      .bind("label", label)
      .bind("added_us", now_us())
      .run();
  audit(library, Act::trust_key, {});
  transaction.commit();
  return {};
}

base::Result<void> remove_trusted_key(Library& library, const std::string& key_or_label) {
  Transaction transaction(library.database());
  const auto known = list_trusted_keys(library);
  if (std::none_of(known.begin(), known.end(), [&](const TrustedKey& one) {
        return one.public_key == key_or_label || one.label == key_or_label;
      }))
    return base::Error{"no_key", "no trusted key has that value or label"};
  question(library.database(), "remove_trusted_key").bind("key", key_or_label).run();
  audit(library, Act::distrust_key, {});
  transaction.commit();
  return {};
}

}  // namespace seldinger::casedb

#include "casedb/database/new_assets.h"

#include <algorithm>

#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"

namespace seldinger::casedb {

NewAssets::~NewAssets() {
  if (std::none_of(assets_.begin(), assets_.end(), [](const Asset& asset) { return asset.stored.created; })) return;
  try {
    // Another process may have found our file meanwhile; under the write lock its row is there or not.
    const Transaction lock(library_.database());
    Statement used = question(library_.database(), "asset_is_used");
    for (const Asset& asset : assets_) {
      if (!asset.stored.created) continue;
      used.bind("sha256", asset.stored.sha256);
      if (used.step() && used.integer("used") == 0) library_.remove_asset(asset.stored.sha256);
      used.rewind();
    }
  } catch (const base::Failure&) {
    // A file too many does no harm; one too few does.
  }
}

std::string NewAssets::add(std::vector<std::byte> bytes) {
  // Stored before the bytes move into the function that will tell them again.
  Library::StoredAsset stored = library_.store_asset(bytes);
  assets_.push_back({std::move(stored), [kept = std::move(bytes)] { return kept; }});
  return assets_.back().stored.sha256;
}

std::string NewAssets::add(std::function<std::vector<std::byte>()> read) {
  Library::StoredAsset stored = library_.store_asset(read());
  assets_.push_back({std::move(stored), std::move(read)});
  return assets_.back().stored.sha256;
}

void NewAssets::make_sure() {
  for (Asset& asset : assets_)
    if (!library_.has_asset(asset.stored.sha256)) asset.stored = library_.store_asset(asset.read());
}

}  // namespace seldinger::casedb

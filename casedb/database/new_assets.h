// The files that come with one new row: stored before the transaction, taken back when it does not happen.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "casedb/database/library.h"

namespace seldinger::casedb {

class NewAssets {
 public:
  explicit NewAssets(Library& library) : library_(library) {}
  NewAssets(const NewAssets&) = delete;
  NewAssets& operator=(const NewAssets&) = delete;
  ~NewAssets();

  std::string add(std::vector<std::byte> bytes);  // its SHA-256
  // For many or large ones: `read` is asked for the bytes now and, should they be needed again, once more.
  std::string add(std::function<std::vector<std::byte>()> read);

  // To be called in the transaction: another process that failed may have taken back a file it made and we found.
  // Nobody takes one back without the write lock, so what is there now stays.
  void make_sure();
  void keep() noexcept { assets_.clear(); }

 private:
  struct Asset {
    Library::StoredAsset stored;
    std::function<std::vector<std::byte>()> read;
  };
  Library& library_;
  std::vector<Asset> assets_;
};

}  // namespace seldinger::casedb

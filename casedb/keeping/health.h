// Whether what is stored now would be kept: asked of the file system, not of the database.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace seldinger::casedb {

enum class Health {
  ok,
  moved,      // the library is no longer in its folder, or another one is
  full,       // less room is left than an import of a large CT takes
  read_only,  // a file can be neither made nor written
};
std::string_view name_of(Health health) noexcept;

// An import stores at most what docs/import.md allows without `--large`, compressed, beside its copy under another
// name; a CT of 512 × 512 × 1000 voxels takes about this much.
inline constexpr std::uint64_t kLeastFree_bytes = std::uint64_t{256} << 20;

class HealthWatch {
 public:
  // Of the library that lies there now.
  explicit HealthWatch(const std::filesystem::path& folder, std::uint64_t least_free_bytes = kLeastFree_bytes);
  // Writes and removes a file of a page; leaves nothing behind.
  Health look() const noexcept;

 private:
  std::filesystem::path folder_;
  std::uint64_t least_free_bytes_;
  std::uint64_t device_ = 0, inode_ = 0;  // of the database's file
};

}  // namespace seldinger::casedb

// A folder is read whole or not at all: what cannot be looked into may hold slices.
#include <unistd.h>

#include <filesystem>

#include "tests/casedb/import/dicom_writer.h"
#include "tests/casedb/import/import_case.h"

namespace seldinger::casedb {
namespace {

namespace fs = std::filesystem;

// Root may read everything: for a while this process is nobody.
class Nobody {
 public:
  Nobody() : was_root_(::geteuid() == 0) {
    if (was_root_) be(kNobody);
  }
  ~Nobody() {
    if (was_root_) be(0);
  }
  Nobody(const Nobody&) = delete;
  Nobody& operator=(const Nobody&) = delete;

  // As who made the folder.
  void permit(const fs::path& folder, fs::perms perms) const {
    if (was_root_) be(0);
    fs::permissions(folder, perms);
    if (was_root_) be(kNobody);
  }

 private:
  static constexpr uid_t kNobody = 65534;
  static void be(uid_t id) { EXPECT_EQ(::seteuid(id), 0); }
  bool was_root_;
};

class DicomFolders : public ImportCase {
 protected:
  static std::string slice(int k) { return TestDicom::ct_slice({4, 3}).at({0.0, 0.0, 2.0 * k}).bytes(); }
};

TEST_F(DicomFolders, AnUnreadableSubFolderStopsTheImport) {
  for (int k = 0; k < 3; ++k) write(numbered("s", k), slice(k));
  for (int k = 3; k < 6; ++k) write(numbered("PLANTED_inner/s", k), slice(k));
  const Nobody nobody;
  EXPECT_EQ(read(folder_)->slices_used, 6);
  const fs::path inner = folder_ / "PLANTED_inner";
  // Three slices of six were a case without a word.
  nobody.permit(inner, fs::perms::none);
  const auto hidden = read(folder_);
  ASSERT_FALSE(hidden);
  EXPECT_EQ(hidden.error().code, "not_readable");
  nobody.permit(inner, fs::perms::owner_read | fs::perms::group_read |
                           fs::perms::others_read);  // names, and nothing behind them
  EXPECT_EQ(refusal(folder_), "not_readable");
  nobody.permit(inner, fs::perms::all);
  EXPECT_EQ(refusal(folder_), "");
}

TEST_F(DicomFolders, FoldersTooDeepToFollowStopIt) {
  for (int k = 0; k < 3; ++k) write(numbered("s", k), slice(k));
  std::string deep;
  for (int i = 0; i < 16; ++i) deep += "d/";
  write(deep + "s3", slice(3));
  EXPECT_EQ(read(folder_)->slices_used, 4);
  write(deep + "d/s4", slice(4));
  EXPECT_EQ(refusal(folder_), "not_readable");
}

}  // namespace
}  // namespace seldinger::casedb

// Files that survive, folders that are taken back, and which file systems are refused.
#include "casedb/database/disk.h"

#include <sys/vfs.h>

#include "sim/base/failure.h"
#include "tests/casedb/library_samples.h"

namespace seldinger::casedb {
namespace {

namespace fs = std::filesystem;

TEST(DiskTest, NetworkFileSystemsAreKnown) {
  // f_type as statfs(2) lists it: NFS, SMB, CIFS, SMB2, AFS, Coda, NCP.
  for (const long type : {0x6969L, 0x517bL, 0xff534d42L, 0xfe534d42L, 0x5346414fL, 0x73757245L, 0x564cL})
    EXPECT_TRUE(is_network_file_system(type)) << std::hex << type;
  // Sign-extended, as machines with a signed 32-bit f_type tell it.
  EXPECT_TRUE(is_network_file_system(static_cast<int>(0xff534d42U)));
  // ext2 to ext4, XFS, Btrfs, tmpfs, overlayfs, FUSE, 9p.
  for (const long type : {0xef53L, 0x58465342L, 0x9123683eL, 0x01021994L, 0x794c7630L, 0x65735546L, 0x01021997L})
    EXPECT_FALSE(is_network_file_system(type)) << std::hex << type;
}

TEST(DiskTest, AFolderThatIsYetToBeMadeLiesWhereItsParentLies) {
  const fs::path folder = fresh_folder();
  struct statfs about {};
  ASSERT_EQ(::statfs(folder.c_str(), &about), 0);
  EXPECT_EQ(lies_on_network(folder / "a" / "b"), is_network_file_system(static_cast<long>(about.f_type)));
  EXPECT_EQ(lies_on_network(folder), lies_on_network(folder / "a" / "b"));
}

TEST(DiskTest, AFileIsWrittenWholeAndReplaced) {
  const fs::path file = fresh_folder() / "a";
  const std::vector<std::byte> first(100'000, std::byte{1}), second(7, std::byte{2});
  write_durably(file, first);
  EXPECT_EQ(read_whole(file), first);
  write_durably(file, second);
  EXPECT_EQ(read_whole(file), second);
  EXPECT_EQ(std::distance(fs::directory_iterator(file.parent_path()), {}), 1);
}

TEST(DiskTest, AFailureNamesNoPath) {
  const fs::path folder = fresh_folder();
  try {
    write_durably(folder / "Jane Doe" / "a", {});
    FAIL() << "was written";
  } catch (const base::Failure& failure) {
    EXPECT_EQ(failure.code(), "disk");
    EXPECT_EQ(std::string(failure.what()).find("Jane"), std::string::npos);
  }
}

TEST(DiskTest, NewFoldersAreTakenBackUnlessKeptOrUsed) {
  const fs::path folder = fresh_folder();
  { const NewFolders made(folder / "a" / "b" / ""); }
  EXPECT_TRUE(fs::is_empty(folder));
  {
    const NewFolders made(folder / "a" / "b");
    std::ofstream(folder / "a" / "letter") << "text";
  }
  EXPECT_TRUE(fs::exists(folder / "a" / "letter"));
  EXPECT_FALSE(fs::exists(folder / "a" / "b"));
  {
    NewFolders made(folder / "a" / "b");
    made.keep();
  }
  EXPECT_TRUE(fs::exists(folder / "a" / "b"));
  { const NewFolders made(folder / "a" / "b"); }  // was there before
  EXPECT_TRUE(fs::exists(folder / "a" / "b"));
}

TEST(DiskTest, ALockKnowsWhetherItsFolderIsStillThere) {
  const fs::path folder = fresh_folder() / "a";
  fs::create_directory(folder);
  const FolderLock lock(folder);
  EXPECT_TRUE(lock.still_there());
  fs::remove(folder);
  EXPECT_FALSE(lock.still_there());
  fs::create_directory(folder);
  EXPECT_FALSE(lock.still_there());
  EXPECT_FALSE(FolderLock(folder / "missing").still_there());
}

}  // namespace
}  // namespace seldinger::casedb

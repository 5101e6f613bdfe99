// Files of a row that did not happen are taken back, and never those that another process came to need meanwhile.
#include "casedb/database/new_assets.h"

#include "sim/volume/volume_bytes.h"
#include "tests/casedb/library_samples.h"

namespace seldinger::casedb {
namespace {

class NewAssetsTest : public testing::Test {
 protected:
  std::filesystem::path folder_ = fresh_folder() / "library";
  Library one_ = open_library(folder_), other_ = open_library(folder_);
  std::vector<std::byte> bytes_ = volume::bytes_from_volume(sample_volume());

  bool there(const std::string& sha256) const { return std::filesystem::exists(folder_ / "assets" / sha256); }
};

TEST_F(NewAssetsTest, AreTakenBackUnlessKept) {
  std::string sha256;
  {
    NewAssets assets(one_);
    sha256 = assets.add(bytes_);
    EXPECT_TRUE(there(sha256));
  }
  EXPECT_FALSE(there(sha256));
  {
    NewAssets assets(one_);
    assets.add(bytes_);
    assets.keep();
  }
  EXPECT_TRUE(there(sha256));
  { NewAssets(one_).add(bytes_); }  // was there before
  EXPECT_TRUE(there(sha256));
}

TEST_F(NewAssetsTest, AreLeftToARowOfAnotherProcess) {
  std::string sha256;
  {
    NewAssets assets(one_);
    sha256 = assets.add(bytes_);
    add_case(other_, sample_case());  // of the same volume
  }
  EXPECT_TRUE(there(sha256));
  EXPECT_TRUE(load_volume(one_, list_cases(one_).front()).has_value());
}

TEST_F(NewAssetsTest, AreStoredAgainWhenAnotherProcessTookThemBack) {
  std::string sha256;
  NewAssets assets(one_);
  {
    NewAssets failing(other_);
    sha256 = failing.add(bytes_);
    assets.add(bytes_);  // found
  }
  EXPECT_FALSE(there(sha256));
  {
    Transaction transaction(one_.database());
    assets.make_sure();
    transaction.commit();
  }
  assets.keep();
  EXPECT_TRUE(there(sha256));
  EXPECT_EQ(one_.load_asset(sha256).value(), bytes_);
}

}  // namespace
}  // namespace seldinger::casedb

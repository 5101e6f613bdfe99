// What any library may hold comes out of its bundles again, however large, empty or many; and a file that somebody
// writes to while it is read is none that was checked.
#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "casedb/import/jail/confine.h"
#include "casedb/import/jail/jail.h"
#include "casedb/import/jail/unpacking.h"
#include "tests/casedb/keeping/bundle_fixture.h"

namespace seldinger::casedb {
namespace {

using BundleLimitsTest = BundleTest;

// One label map of a large case that marks a stone alone: `too_large`, as it shrinks far more than a thousand
// times; and nine or more that structures refer to: `reader_died`, as all lay in memory at once.
TEST_F(BundleLimitsTest, NearlyEmptyLabelMapsOfALargeCase) {
  const glm::ivec3 size{512, 512, 104};
  NewCase large = sample_case("Large");
  large.volume = volume::make_volume(size, {0.5, 0.5, 1.0}, glm::dmat3(1.0), {0.0, 0.0, 0.0});
  std::fill(large.volume.hu.begin(), large.volume.hu.end(), std::int16_t{-1000});
  base::Rng rng(3);
  for (std::size_t i = 0; i < std::size_t{512} * 512; ++i)
    large.volume.hu[i] = static_cast<std::int16_t>(rng.uniform() * 100.0);
  ASSERT_GT(large.volume.hu.size(), kBundlePart.free_bytes);
  const std::string case_id = add_case(home_, large);
  volume::LabelMap labels;
  labels.names = {"none", "stone"};
  for (int map = 0; map < 10; ++map) {
    labels.label.assign(large.volume.hu.size(), 0);
    for (std::size_t i = 0; i < 4000; ++i) labels.label[i + static_cast<std::size_t>(map)] = 1;
    StructureRow stone;
    stone.case_id = case_id;
    stone.name = "stone " + std::to_string(map);
    stone.kind = StructureKind::label;
    stone.tissue = volume::TissueClass::bone;
    stone.labels_sha256 = add_label_map(home_, case_id, labels).value();
    stone.label = 1;
    ASSERT_TRUE(add_structure(home_, stone).has_value());
    if (map != 0 && map != 9) continue;
    ASSERT_TRUE(write_bundle(home_, {case_id}, file_, "0.1.0").has_value());
    EXPECT_EQ(check_bundle(file_) ? "" : check_bundle(file_).error().code, "") << map + 1 << " label maps";
  }
}

// The largest file alone counted: 500 lawful cases died of SIGXCPU.
TEST_F(BundleLimitsTest, TimeIsThatOfAllCases) {
  std::uint64_t one = 0;
  for (std::uint64_t i = 0; i < 20; ++i) {
    if (i == 1) {
      ASSERT_TRUE(write_bundle(home_, {}, file_, "0.1.0").has_value());
      ASSERT_TRUE(check_bundle(file_).has_value());
      one = last_jail_use().work_bytes;
    }
    NewCase next = sample_case("Case " + std::to_string(i));
    next.volume = sample_volume({9, 7, 5}, 100 + i);
    add_case(home_, next);
  }
  ASSERT_TRUE(write_bundle(home_, {}, file_, "0.1.0").has_value());
  ASSERT_TRUE(check_bundle(file_).has_value());
  EXPECT_GE(last_jail_use().work_bytes, one + 19 * kSlowestBytesPerSecond);
}

// The list was read anew after the check: what was written over it in between counted, unchecked, after some 20
// tries.
TEST_F(BundleLimitsTest, AFileThatChangesMeanwhileIsNotTaken) {
  write();
  const std::string good = fixtures::whole_file(file_);
  Parts parts = parts_of(file_);
  replace(parts.list, "program 0.1.0", "program 6.6.6");
  char& digit = parts.list[parts.list.find("\nasset ") - 1];  // of the rows' hash: no check lets it through
  digit = digit == '0' ? '1' : '0';
  put_as_listed(file_, parts);
  ASSERT_EQ(check_bundle(file_).error().code, "damaged");
  const std::string bad = fixtures::whole_file(file_);
  ASSERT_EQ(good.size(), bad.size());
  std::atomic<bool> done = false;
  const int written = ::open(file_.c_str(), O_WRONLY | O_CLOEXEC);
  std::thread writer([&] {  // takes no memory, whose locks a sanitizer does not know at a fork
    for (bool turn = false; !done; turn = !turn) {
      const std::string& now = turn ? good : bad;
      if (::pwrite(written, now.data(), now.size(), 0) < 0) break;
      std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
  });
  int refused = 0;
  for (int round = 0; round < 300; ++round) {
    const auto bundle = check_bundle(file_);
    refused += bundle ? 0 : 1;
    EXPECT_EQ(bundle ? bundle->program_version : "0.1.0", "0.1.0") << "round " << round;
  }
  done = true;
  writer.join();
  ::close(written);
  EXPECT_GT(refused, 0);
}

// A title of `import --title` was not looked at: 1,500 bytes or two lines were stored, and no bundle with that case
// could be read again.
TEST_F(BundleLimitsTest, TitlesOfBeforeAreFitted) {
  const std::pair<std::string, std::string> titles[] = {{std::string(1500, 'x'), std::string(100, 'x')},
                                                        {"a\nb", "a b"},
                                                        {"  a ", "a"},
                                                        {"\t", "untitled"},
                                                        {"a\xC2\x9B"
                                                         "31m",
                                                         "a 31m"},
                                                        {std::string(99, 'x') + "\xC3\xA4", std::string(99, 'x')}};
  for (const auto& [before, after] : titles) {
    EXPECT_EQ(check_case_title(before).has_value(), false) << before;
    Statement set = home_.database().prepare("UPDATE training_case SET title = :title");
    set.bind("title", before).run();
    write();
    Library fresh = open_library(scratch_ / ("at " + std::to_string(before.size()) + before.substr(0, 1)));
    ASSERT_TRUE(import_bundle(fresh, file_).has_value()) << before;
    EXPECT_EQ(find_case(fresh, case_id_).value().title, after);
    EXPECT_EQ(import_bundle(fresh, file_).value().present.size(), 1U);
  }
  EXPECT_EQ(check_case_title("a\xE4").error().code, "bad_title") << "not UTF-8";
  EXPECT_TRUE(check_case_title("M\xC3\xBCller").has_value());
}

}  // namespace
}  // namespace seldinger::casedb

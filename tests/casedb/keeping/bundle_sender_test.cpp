// What a bundle says of itself is its sender's word: nothing of it counts as reviewed or confirmed here, a
// signature tells who that is, and what a killed export left goes with the next.
#include "casedb/cases/received.h"

#include <set>

#include "casedb/cases/versions.h"
#include "casedb/keeping/trusted_keys.h"
#include "casedb/people/people.h"
#include "tests/casedb/keeping/bundle_fixture.h"

namespace seldinger::casedb {
namespace {

namespace fs = std::filesystem;

using BundleSenderTest = BundleTest;

// It arrived published, its pictures confirmed "at the command line", and could be practised at once: whoever edits
// a bundle could say so of any case.
TEST_F(BundleSenderTest, WhatTheSenderSaysIsTheSenders) {
  home_.database().run(
      "UPDATE training_case SET state = 'published', audience = 'own_cohort', burned_in_checked_us = "
      "1700000000000000");
  write();
  const Unbundled cases = import_bundle(away_, file_).value();
  EXPECT_EQ(cases.for_review, std::vector{case_id_});
  EXPECT_FALSE(cases.signing_key.has_value());
  const CaseRow row = find_case(away_, case_id_).value();
  EXPECT_EQ(row.state, CaseState::review);
  EXPECT_FALSE(row.own_cohort_only);
  EXPECT_EQ(row.face_state, FaceState::unchecked);
  EXPECT_FALSE(row.burned_in_checked.has_value());
  const Received received = find_received(away_, case_id_).value();
  EXPECT_EQ(received.state, CaseState::published);
  EXPECT_EQ(received.burned_in_checked_us, 1700000000000000);
  EXPECT_EQ(received.face_state, find_case(home_, case_id_).value().face_state);
  EXPECT_FALSE(received.signing_key.has_value());
  EXPECT_FALSE(find_received(home_, case_id_).has_value());
  EXPECT_TRUE(refused_by_constraint([&] { away_.database().run("UPDATE case_received SET state = 'draft'"); }));
  EXPECT_TRUE(refused_by_constraint([&] { away_.database().run("DELETE FROM structure"); })) << "no draft here";

  // As of any case: somebody looks, a second person approves, and both are of this library.
  for (const char* mentor : {"ann", "bob"})
    ASSERT_TRUE(add_user(away_, mentor, Role::mentor, "a secret password").has_value());
  CaseCheck check;
  check.content_mark = content_mark(away_, case_id_);
  const auto published_by = [&](const char* by) {
    const auto done = publish_case(away_, case_id_, check, by, false);
    return done ? std::string("done") : done.error().code;
  };
  EXPECT_EQ(published_by("ann"), "not_allowed") << "nobody has approved it";
  ASSERT_TRUE(judge_case(away_, case_id_, "ann", true).has_value());
  EXPECT_EQ(published_by("ann"), "not_allowed") << "one person alone";
  EXPECT_EQ(published_by("bob"), "burned_in_unchecked");
  ASSERT_TRUE(confirm_no_burned_in_text(away_, case_id_, {}).has_value());
  EXPECT_EQ(published_by("bob"), "done");
  // The same bundle again: nothing is done to what was published here.
  EXPECT_EQ(import_bundle(away_, file_).value().present, std::vector{case_id_});
  EXPECT_EQ(find_case(away_, case_id_).value().state, CaseState::published);
}

TEST_F(BundleSenderTest, OnlyWhatWasPublishedIsForReview) {
  for (const auto& [there, here] : {std::pair("draft", CaseState::draft),
                                    {"review", CaseState::review},
                                    {"published", CaseState::review},
                                    {"retired", CaseState::retired}}) {
    Library target = open_library(scratch_ / there);
    home_.database().run(std::string("UPDATE training_case SET state = '") + there + "'");
    write();
    ASSERT_TRUE(import_bundle(target, file_).has_value());
    EXPECT_EQ(find_case(target, case_id_).value().state, here);
    EXPECT_EQ(name_of(find_received(target, case_id_).value().state), there);
  }
}

HashKey key_of(int number) {
  HashKey key{};
  key.fill(static_cast<std::byte>(number));
  return key;
}

TEST_F(BundleSenderTest, ASignatureTellsWhoSent) {
  ASSERT_TRUE(write_bundle(home_, {case_id_}, file_, "0.1.0", key_of(7)).has_value());
  const std::string key = public_key_of(key_of(7));
  EXPECT_EQ(key.size(), 64U);
  EXPECT_EQ(check_bundle(file_).value().signing_key, key);
  EXPECT_EQ(check_bundle(file_).value().bytes, fs::file_size(file_));
  const Unbundled unknown = import_bundle(away_, file_).value();
  EXPECT_EQ(unknown.signing_key, key);
  EXPECT_FALSE(unknown.trusted_as.has_value());
  EXPECT_EQ(find_received(away_, case_id_).value().signing_key, key);
  EXPECT_FALSE(find_received(away_, case_id_).value().trusted_as.has_value());

  ASSERT_TRUE(add_trusted_key(away_, key, "Site B").has_value());
  EXPECT_EQ(import_bundle(away_, file_).value().trusted_as, "Site B");
  EXPECT_EQ(find_received(away_, case_id_).value().trusted_as, "Site B");
  EXPECT_EQ(add_trusted_key(away_, key, "Again").error().code, "key_known");
  EXPECT_EQ(add_trusted_key(away_, public_key_of(key_of(8)), "Site B").error().code, "key_known");
  EXPECT_EQ(add_trusted_key(away_, "12", "Short").error().code, "bad_key");
  EXPECT_EQ(add_trusted_key(away_, public_key_of(key_of(9)), "two\nlines").error().code, "bad_title");
  EXPECT_EQ(list_trusted_keys(away_).size(), 1U);
  EXPECT_EQ(remove_trusted_key(away_, "Site A").error().code, "no_key");
  ASSERT_TRUE(remove_trusted_key(away_, "Site B").has_value());
  EXPECT_FALSE(find_received(away_, case_id_).value().trusted_as.has_value());
}

// One byte of 200 places of the file, and every byte of its head: told, whichever it is. Beside a sanitizer,
// where each takes twenty times as long, every seventh.
#ifdef __SANITIZE_ADDRESS__
constexpr std::size_t kPlaceStep = 7;
#else
constexpr std::size_t kPlaceStep = 1;
#endif

TEST_F(BundleSenderTest, AnyByteOfASignedBundleCounts) {
  ASSERT_TRUE(write_bundle(home_, {case_id_}, file_, "0.1.0", key_of(7)).has_value());
  const std::string good = fixtures::whole_file(file_);
  const auto before = state_of(away_);
  const std::set<std::string> known = {"damaged", "bad_signature", "bundle_version", "not_a_bundle"};
  std::uint64_t list_bytes = 0;
  std::memcpy(&list_bytes, good.data() + 16, sizeof list_bytes);
  const std::size_t head = kBundleHeader + list_bytes + 96;
  std::map<std::string, int> told;
  std::vector<std::size_t> places;
  for (std::size_t at = 0; at < head; ++at) places.push_back(at);
  for (std::size_t i = 0; i < 200; ++i) places.push_back(i * (good.size() - 1) / 199);
  for (std::size_t i = 0; i < places.size(); i += kPlaceStep) {
    const std::size_t at = places[i];
    for (const char flip : {'\x01', '\x03', '\x80'}) {
      std::string bad = good;
      bad[at] = static_cast<char>(bad[at] ^ flip);
      std::ofstream(file_, std::ios::binary) << bad;
      const std::string code = refusal();
      ASSERT_TRUE(known.contains(code)) << at << " of " << good.size() << ": " << code;
      ++told[code];
    }
  }
  EXPECT_GE(told["bad_signature"], static_cast<int>(96 / kPlaceStep * 3));
  EXPECT_EQ(state_of(away_), before);
}

// What another key signed, and what was signed of another bundle.
TEST_F(BundleSenderTest, ABorrowedSignatureIsRefused) {
  ASSERT_TRUE(write_bundle(home_, {case_id_}, file_, "0.1.0", key_of(7)).has_value());
  const std::string one = fixtures::whole_file(file_);
  home_.database().run("UPDATE training_case SET title = 'Another'");
  ASSERT_TRUE(write_bundle(home_, {case_id_}, file_, "0.1.0", key_of(7)).has_value());
  std::string other = fixtures::whole_file(file_);
  std::uint64_t one_list = 0, other_list = 0;
  std::memcpy(&one_list, one.data() + 16, sizeof one_list);
  std::memcpy(&other_list, other.data() + 16, sizeof other_list);
  other.replace(kBundleHeader + other_list, 96, one.substr(kBundleHeader + one_list, 96));
  std::ofstream(file_, std::ios::binary) << other;
  EXPECT_EQ(refusal(), "bad_signature");
  const HashKey key = key_of(8);
  const std::string mine = public_key_of(key);
  ASSERT_TRUE(write_bundle(home_, {case_id_}, file_, "0.1.0", key_of(7)).has_value());
  other = fixtures::whole_file(file_);
  for (std::size_t i = 0; i < 32; ++i)  // the key of another beside a signature
    other[kBundleHeader + other_list + i] = static_cast<char>(std::stoi(mine.substr(2 * i, 2), nullptr, 16));
  std::ofstream(file_, std::ios::binary) << other;
  EXPECT_EQ(refusal(), "bad_signature");
}

// A killed export left OUT.tmp-PID-N beside it for ever. What somebody is writing, what bears another name or holds
// something else stays, and links are not followed.
TEST_F(BundleSenderTest, TheNextExportTakesWhatAKilledOneLeft) {
  write();
  const auto put_file = [&](const char* name, const std::string& content) {
    std::ofstream(scratch_ / name, std::ios::binary) << content;
    return scratch_ / name;
  };
  const fs::path left = put_file("a.sdbundle.tmp-4194305-0", fixtures::whole_file(file_).substr(0, 200)),
                 dated = put_file("2026-01-01.sdbundle.tmp-4194305-17", "SDBUN"),
                 foreign = put_file("notes.tmp-4194305-0", "mine"),
                 named = put_file("a.sdbundle.tmp-x", "SDBUNDLE");
  fs::create_symlink(foreign, scratch_ / "link.tmp-1-1");
  NewFile running(scratch_ / "b.sdbundle");
  running.write(bytes_of(std::string("SDBUNDLE and more")));
  write();
  EXPECT_FALSE(fs::exists(left));
  EXPECT_FALSE(fs::exists(dated));
  EXPECT_TRUE(fs::exists(foreign));
  EXPECT_TRUE(fs::exists(named));
  EXPECT_TRUE(fs::is_symlink(scratch_ / "link.tmp-1-1"));
  running.keep();
  EXPECT_EQ(fixtures::whole_file(scratch_ / "b.sdbundle"), "SDBUNDLE and more");
}

}  // namespace
}  // namespace seldinger::casedb

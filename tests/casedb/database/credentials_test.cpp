// Passwords, randomness, SHA-256.
#include "casedb/database/credentials.h"

#include <gtest/gtest.h>
#include <sodium.h>

#include <algorithm>
#include <array>
#include <set>

namespace seldinger::casedb {
namespace {

TEST(CredentialsTest, PasswordsAreHashedWithArgon2idOf64MiBAndTwoPasses) {
  const std::string hash = hash_password("correct horse");
  EXPECT_EQ(hash.substr(0, 31), "$argon2id$v=19$m=65536,t=2,p=1$");
  EXPECT_NE(hash, hash_password("correct horse"));  // salted
  EXPECT_TRUE(verify_password(hash, "correct horse"));
  EXPECT_FALSE(verify_password(hash, "correct horsf"));
  EXPECT_FALSE(verify_password(hash, ""));
  EXPECT_FALSE(needs_rehash(hash));
}

TEST(CredentialsTest, APasswordMayHoldAnyBytes) {
  const std::string password("a\0b\xff\xc3", 5);
  const std::string hash = hash_password(password);
  EXPECT_TRUE(verify_password(hash, password));
  EXPECT_FALSE(verify_password(hash, std::string("a")));  // not cut at the zero
}

TEST(CredentialsTest, AHashOfWeakerParametersIsToBeRenewed) {
  std::array<char, crypto_pwhash_STRBYTES> weak{};
  ASSERT_EQ(crypto_pwhash_str(weak.data(), "password", 8, 1, 8 << 20), 0);
  EXPECT_TRUE(verify_password(weak.data(), "password"));
  EXPECT_TRUE(needs_rehash(weak.data()));
}

TEST(CredentialsTest, WhatIsNoHashFitsNothing) {
  for (const char* hash : {"", "$", "password", "$argon2id$v=19$m=65536,t=2,p=1$x"})
    EXPECT_FALSE(verify_password(hash, "password"));
}

TEST(CredentialsTest, TheUnmatchableHashHasTheParametersOfARealOne) {
  const std::string real = hash_password("password");
  EXPECT_EQ(unmatchable_hash().size(), real.size());
  EXPECT_EQ(unmatchable_hash().substr(0, 31), real.substr(0, 31));
  EXPECT_FALSE(needs_rehash(unmatchable_hash()));  // well formed
  for (const char* password : {"", "password", "AAAA"}) EXPECT_FALSE(verify_password(unmatchable_hash(), password));
}

TEST(CredentialsTest, RandomPasswordsAreLongLegibleAndDiffer) {
  std::set<std::string> passwords;
  std::array<int, 256> seen{};
  for (int i = 0; i < 2000; ++i) {
    const std::string password = random_password();
    EXPECT_EQ(password.size(), 20U);
    EXPECT_EQ(password.find_first_of("0Oo1lIi"), std::string::npos);
    for (const char c : password) ++seen[static_cast<unsigned char>(c)];
    passwords.insert(password);
  }
  EXPECT_EQ(passwords.size(), 2000U);
  // 40 000 characters over 55 letters: 727 each, standard deviation 27. Eight of them either way.
  int letters = 0;
  for (const int count : seen) {
    if (count == 0) continue;
    ++letters;
    EXPECT_NEAR(count, 40'000 / 55.0, 8 * 27);
  }
  EXPECT_EQ(letters, 55);
}

TEST(CredentialsTest, RandomBytesFillTheWholeSpan) {
  std::array<std::byte, 4096> first{}, second{};
  fill_random(first);
  fill_random(second);
  EXPECT_NE(first, second);
  // 4096 bytes with 16 zeros expected, standard deviation 4.
  EXPECT_LT(std::count(first.begin(), first.end(), std::byte{0}), 16 + 10 * 4);
}

TEST(CredentialsTest, Sha256HasThePublishedValues) {  // FIPS 180-2, appendix B
  const std::string abc = "abc", two_blocks = "abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq";
  EXPECT_EQ(sha256_hex(std::as_bytes(std::span(abc))),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_hex(std::as_bytes(std::span(two_blocks))),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256_hex({}), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST(CredentialsTest, AWipedSecretIsEmpty) {
  std::string secret = "a password that is longer than a short string";
  const char* at = secret.data();
  wipe(secret);
  EXPECT_TRUE(secret.empty());
  EXPECT_EQ(secret.data(), at);  // the same memory, still owned: may be looked at
  EXPECT_TRUE(std::all_of(at, at + 40, [](char c) { return c == 0; }));
}

}  // namespace
}  // namespace seldinger::casedb

// Passwords, random numbers that nobody guesses, and SHA-256: the door of libsodium.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace seldinger::casedb {

// Argon2id with the parameters of libsodium's "interactive" limits; OWASP asks for at least 19 MiB at t = 2.
constexpr unsigned kPasswordMemory_kib = 64 * 1024;
constexpr unsigned kPasswordPasses = 2;

// "$argon2id$v=19$m=65536,t=2,p=1$<salt>$<hash>". Throws base::Failure("memory") when 64 MiB cannot be had.
std::string hash_password(const std::string& password);
bool verify_password(const std::string& hash, const std::string& password) noexcept;
bool needs_rehash(const std::string& hash) noexcept;  // made with other parameters
// No password fits it, and refusing one takes as long as with a real hash.
const std::string& unmatchable_hash();

void fill_random(std::span<std::byte> bytes) noexcept;
std::string random_password();  // 20 characters that are not mistaken for each other: 115 bits
std::string sha256_hex(std::span<const std::byte> bytes);
// The same, of bytes that come in pieces.
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  void add(std::span<const std::byte> bytes);
  std::string hex();  // once, at the end

 private:
  struct State;
  std::unique_ptr<State> state_;
};
// 16 bytes that say nothing of `text` to who does not know the key (BLAKE2b, RFC 7693, keyed).
using HashKey = std::array<std::byte, 32>;
std::array<std::byte, 16> keyed_hash(const HashKey& key, std::string_view text) noexcept;
void wipe(std::string& secret) noexcept;  // overwrites, then empties
void wipe(std::span<char> secret) noexcept;

}  // namespace seldinger::casedb

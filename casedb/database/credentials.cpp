#include "casedb/database/credentials.h"

#include <sodium.h>

#include <array>
#include <string_view>

#include "sim/base/check.h"
#include "sim/base/failure.h"

namespace seldinger::casedb {
namespace {

static_assert(kPasswordMemory_kib * 1024ULL == crypto_pwhash_MEMLIMIT_INTERACTIVE);
static_assert(kPasswordPasses == crypto_pwhash_OPSLIMIT_INTERACTIVE);

void start_sodium() noexcept {
  static const bool ready = sodium_init() >= 0;
  CHECK(ready);
}

}  // namespace

std::string hash_password(const std::string& password) {
  start_sodium();
  std::array<char, crypto_pwhash_STRBYTES> text{};
  if (crypto_pwhash_str(text.data(), password.data(), password.size(), kPasswordPasses,
                        std::size_t{kPasswordMemory_kib} * 1024) != 0)
    throw base::Failure("memory", "not enough memory to hash a password");
  return text.data();
}

bool verify_password(const std::string& hash, const std::string& password) noexcept {
  start_sodium();
  return crypto_pwhash_str_verify(hash.c_str(), password.data(), password.size()) == 0;
}

bool needs_rehash(const std::string& hash) noexcept {
  start_sodium();
  return crypto_pwhash_str_needs_rehash(hash.c_str(), kPasswordPasses, std::size_t{kPasswordMemory_kib} * 1024) !=
         0;
}

const std::string& unmatchable_hash() {
  // Salt and hash (16 and 32 bytes in base64) are all zero: no known password hashes to zero.
  static const std::string hash = "$argon2id$v=19$m=" + std::to_string(kPasswordMemory_kib) +
                                  ",t=" + std::to_string(kPasswordPasses) + ",p=1$" + std::string(22, 'A') + '$' +
                                  std::string(43, 'A');
  return hash;
}

void fill_random(std::span<std::byte> bytes) noexcept {
  start_sodium();
  randombytes_buf(bytes.data(), bytes.size());
}

std::string random_password() {
  start_sodium();
  // Without 0 O o, 1 l I i.
  static constexpr std::string_view kAlphabet = "23456789abcdefghjkmnpqrstuvwxyzABCDEFGHJKLMNPQRSTUVWXYZ";
  std::string password(20, ' ');
  for (char& c : password) c = kAlphabet[randombytes_uniform(static_cast<std::uint32_t>(kAlphabet.size()))];
  return password;
}

struct Sha256::State {
  crypto_hash_sha256_state value;
};

Sha256::Sha256() : state_(std::make_unique<State>()) {
  crypto_hash_sha256_init(&state_->value);
}
Sha256::~Sha256() = default;

void Sha256::add(std::span<const std::byte> bytes) {
  crypto_hash_sha256_update(&state_->value, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
}

std::string Sha256::hex() {
  std::array<unsigned char, crypto_hash_sha256_BYTES> hash{};
  crypto_hash_sha256_final(&state_->value, hash.data());
  std::array<char, 2 * crypto_hash_sha256_BYTES + 1> text{};
  sodium_bin2hex(text.data(), text.size(), hash.data(), hash.size());
  return text.data();
}

std::string sha256_hex(std::span<const std::byte> bytes) {
  Sha256 hash;
  hash.add(bytes);
  return hash.hex();
}

std::array<std::byte, 16> keyed_hash(const HashKey& key, std::string_view text) noexcept {
  static_assert(std::tuple_size_v<HashKey> == crypto_generichash_KEYBYTES);
  start_sodium();
  std::array<std::byte, 16> hash{};
  crypto_generichash(reinterpret_cast<unsigned char*>(hash.data()), hash.size(),
                     reinterpret_cast<const unsigned char*>(text.data()), text.size(),
                     reinterpret_cast<const unsigned char*>(key.data()), key.size());
  return hash;
}

void wipe(std::span<char> secret) noexcept {
  sodium_memzero(secret.data(), secret.size());
}

void wipe(std::string& secret) noexcept {
  sodium_memzero(secret.data(), secret.size());
  secret.clear();
}

}  // namespace seldinger::casedb

#include "tests/casedb/import/mutate.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace seldinger::casedb {
namespace {

class Mutation {
 public:
  Mutation(std::string& bytes, std::mt19937_64& random) : bytes_(bytes), random_(random) {}

  void apply(const std::vector<std::string>& others) {
    if (bytes_.empty()) bytes_.push_back('\0');
    switch (below(11)) {
      case 0:
        bytes_[place()] = static_cast<char>(random_());
        return;
      case 1:
        bytes_[place()] = static_cast<char>(bytes_[place()] ^ (1 << below(8)));
        return;
      case 2:
        return put_number(2);
      case 3:
      case 4:
        return put_number(4);
      case 5:
        bytes_.erase(place(), 1 + below(below(2) == 0 ? 4 : 400));
        return;
      case 6:
        bytes_.insert(place(), std::string(1 + below(64), static_cast<char>(random_())));
        return;
      case 7:
        return copy_from(bytes_);
      case 8:
        return copy_from(others[below(others.size())]);
      case 9:
        bytes_.resize(place());
        return;
      default:
        return put_word();
    }
  }

 private:
  std::size_t below(std::size_t end) { return end == 0 ? 0 : random_() % end; }
  // Half of the time near the beginning, where headers are.
  std::size_t place() {
    return below(2) == 0 ? below(bytes_.size()) : below(std::min<std::size_t>(bytes_.size(), 1500));
  }

  // A length or count that decides something.
  void put_number(std::size_t size) {
    static constexpr std::array<std::uint32_t, 18> kNumbers = {
        0,      1,      2,      7,      8,       0x7F,       0x80,       0xFF,       0x100,
        0x7FFF, 0x8000, 0xFFFE, 0xFFFF, 0x10000, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFE, 0xFFFFFFFF};
    std::uint32_t number = kNumbers[below(kNumbers.size())];
    if (below(3) == 0) number = static_cast<std::uint32_t>(bytes_.size() + below(64) - 32);
    const std::size_t at = place();
    const bool big_endian = below(4) == 0;
    for (std::size_t i = 0; i < size && at + i < bytes_.size(); ++i)
      bytes_[at + i] = static_cast<char>(number >> 8 * (big_endian ? size - 1 - i : i));
  }

  // What means something in one of the formats.
  void put_word() {
    using namespace std::string_literals;
    static const std::array<std::string, 24> kWords = {"\xFE\xFF\x00\xE0\xFF\xFF\xFF\xFF"s,
                                                       "\xFE\xFF\xDD\xE0\0\0\0\0"s,
                                                       "\xFE\xFF\x0D\xE0\0\0\0\0"s,
                                                       "\xE0\x7F\x10\0OW\0\0"s,
                                                       "\x28\0\x10\0US\2\0"s,
                                                       "\x28\0\x11\0US\2\0\xFF\xFF"s,
                                                       "\x28\0\x08\0IS\4\0"
                                                       "9999"s,
                                                       "\0\x52\x30\x92SQ\0\0"s,
                                                       "\x20\0\x13\x91SQ\0\0"s,
                                                       "\x20\0\x32\0DS"s,
                                                       "SQ\0\0\xFF\xFF\xFF\xFF"s,
                                                       "UN"s,
                                                       "OB"s,
                                                       "1.2.840.10008.1.2.4.90\0"s,
                                                       "1.2.840.10008.1.2.4.70\0"s,
                                                       "1.2.840.10008.1.2.5\0"s,
                                                       "1.2.840.10008.1.2.1.99"s,
                                                       "\xFF\x4F\xFF\x51"s,
                                                       "\xFF\xC3"s,
                                                       "\xFF\xC4"s,
                                                       "\xFF\xD9"s,
                                                       "1e308\\-1e308"s,
                                                       "nan\\inf"s,
                                                       "-99999999"s};
    const std::string& word = kWords[below(kWords.size())];
    const std::size_t at = place();
    if (below(2) == 0)
      bytes_.insert(at, word);
    else
      bytes_.replace(at, std::min(word.size(), bytes_.size() - at), word);
  }

  void copy_from(const std::string& other) {
    if (other.empty()) return;
    const std::size_t from = below(other.size());
    const std::string piece = other.substr(from, 1 + below(300));
    const std::size_t at = place();
    if (below(2) == 0)
      bytes_.insert(at, piece);
    else
      bytes_.replace(at, std::min(piece.size(), bytes_.size() - at), piece);
  }

  std::string& bytes_;
  std::mt19937_64& random_;
};

}  // namespace

std::string mutated(const std::string& seed, const std::vector<std::string>& others, std::size_t most_bytes,
                    std::mt19937_64& random) {
  std::string bytes = seed;
  Mutation mutation(bytes, random);
  for (std::size_t i = 1 + random() % 8; i > 0; --i) mutation.apply(others);
  if (bytes.size() > most_bytes) bytes.resize(most_bytes);
  return bytes;
}

}  // namespace seldinger::casedb

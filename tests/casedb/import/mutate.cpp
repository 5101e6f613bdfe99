#include "tests/casedb/import/mutate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace seldinger::casedb {
namespace {

class Mutation {
 public:
  Mutation(std::string& bytes, std::mt19937_64& random) : bytes_(bytes), random_(random) {}

  void apply(const std::vector<std::string>& others) {
    if (bytes_.empty()) bytes_.push_back('\0');
    switch (below(14)) {
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
      case 10:
      case 11:
      case 12:
        if (is_nifti()) return put_nifti_field();
        if (header_lines() > 2) return change_line();
        return put_number(2);
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

  bool is_nifti() const { return bytes_.size() >= 352 && bytes_.compare(0, 4, std::string("\x5C\1\0\0", 4)) == 0; }

  // nifti1.h: dimensions, type, sizes, where voxels begin, rescaling, units, forms and their numbers.
  void put_nifti_field() {
    static constexpr std::array<std::int16_t, 12> kShorts = {-32768, -1, 0, 1, 2, 4, 8, 16, 64, 255, 512, 32767};
    static const std::array<float, 12> kFloats = {0.0F,   -0.0F, 1.0F,  -1.0F, 0.5F,   352.0F,
                                                  1e-30F, 1e30F, 1e10F, 1e4F,  -3e38F, std::nanf("")};
    const bool number = below(2) == 0;
    const std::size_t at = number ? 76 + 4 * below(63) : (below(2) == 0 ? 40 + 2 * below(18) : 252 + 2 * below(2));
    if (number) {
      const float value = kFloats[below(kFloats.size())];
      std::memcpy(bytes_.data() + at, &value, sizeof value);
    } else {
      const std::int16_t value = kShorts[below(kShorts.size())];
      std::memcpy(bytes_.data() + at, &value, sizeof value);
    }
  }

  // How many lines of text the file begins with.
  std::size_t header_lines() const {
    std::size_t lines = 0;
    for (const char c : bytes_.substr(0, 4096)) {
      if (c == '\n') ++lines;
      if (static_cast<unsigned char>(c) >= 0x7F || (c < ' ' && c != '\n' && c != '\r' && c != '\t')) break;
    }
    return lines;
  }

  // A line of a header is lost, doubled, or has a key, a word or a list of another length or size.
  void change_line() {
    static constexpr std::array<std::size_t, 11> kLengths = {0, 1, 200, 254, 255, 256, 300, 999, 1024, 5000, 40000};
    static constexpr std::array<const char*, 10> kNumbers = {"0",    "-1",   "1",   "4096", "99999999999999999999",
                                                             "1e18", "-1e9", "nan", "inf",  "2147483648"};
    std::size_t begin = 0;
    for (std::size_t skip = below(header_lines()); skip > 0; --skip) begin = bytes_.find('\n', begin) + 1;
    const std::size_t end = std::min(bytes_.find('\n', begin), bytes_.size());
    std::string line = bytes_.substr(begin, end - begin);
    const std::size_t length = kLengths[below(kLengths.size())];
    const std::size_t digit = line.find_first_of("0123456789");
    switch (below(7)) {
      case 0:
        line.clear();
        break;
      case 1:
        line += "\n" + line;
        break;
      case 2:
        line.insert(0, std::string(length, 'K'));
        break;
      case 3:
        line += std::string(length, 'v');
        break;
      case 4:
        for (std::size_t i = 0; i < length; ++i) line += " 8";
        break;
      case 5:
        line = std::string(below(2) == 0 ? "Comment = " : "# ") + std::string(length, 'c');
        break;
      default:
        if (digit == std::string::npos) return;
        line.replace(digit, line.find_first_not_of("0123456789.", digit) - digit, kNumbers[below(kNumbers.size())]);
    }
    bytes_.replace(begin, end - begin, line);
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

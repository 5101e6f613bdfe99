// Overlays in the bits above and below a pixel's: eight of eight such files kept theirs and said that the patient's
// identity was removed.
#include "casedb/export/hidden_bits.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace seldinger::casedb {
namespace {

std::string cells(std::initializer_list<unsigned> values, bool big_endian = false, std::size_t bytes = 2) {
  std::string text;
  for (const unsigned value : values)
    for (std::size_t i = 0; i < bytes; ++i)
      text.push_back(static_cast<char>(value >> 8 * (big_endian ? bytes - 1 - i : i) & 0xFFU));
  return text;
}

void put(DicomDataSet& set, DicomTag tag, const char* vr, std::string value) {
  DicomElement& made = set.emplace_back();
  made.tag = tag;
  made.set(vr, std::move(value));
}

struct Bits {
  unsigned allocated = 16, stored = 12, high = 11;
  bool is_signed = false;
};

DicomDataSet picture(const Bits& bits, std::string pixels, bool big_endian = false) {
  DicomDataSet set;
  const auto number = [&](DicomTag tag, unsigned value) { put(set, tag, "US", cells({value}, big_endian)); };
  number(0x00280010, 1);
  number(0x00280011, 4);
  number(0x00280100, bits.allocated);
  number(0x00280101, bits.stored);
  number(0x00280102, bits.high);
  number(0x00280103, bits.is_signed ? 1 : 0);
  put(set, 0x7FE00010, "OW", std::move(pixels));
  return set;
}

std::string pixels(const DicomDataSet& set) {
  return std::string(set.back().value);
}

constexpr DicomFormat kLittle{true, false}, kBig{true, true};

TEST(HiddenBits, WhatIsNotThePixelsIsCleared) {
  const auto cleared = [](const Bits& bits, std::initializer_list<unsigned> before) {
    DicomDataSet set = picture(bits, cells(before));
    EXPECT_EQ(clear_hidden_bits(set, kLittle).value(), 1);
    return pixels(set);
  };
  EXPECT_EQ(cleared({}, {0x1234, 0xF000, 0x0FFF, 0xFFFF}), cells({0x0234, 0x0000, 0x0FFF, 0x0FFF}));
  // Signed: the sign goes on, so that -1 is still -1 to who reads all 16 bits.
  EXPECT_EQ(cleared({16, 12, 11, true}, {0x7FFF, 0x0800, 0xF7FF, 0xF800}), cells({0xFFFF, 0xF800, 0x07FF, 0xF800}));
  EXPECT_EQ(cleared({16, 12, 15, false}, {0x123F, 0xFFFF, 0x0001, 0xABC0}), cells({0x1230, 0xFFF0, 0x0000, 0xABC0}))
      << "below the pixel's";
  DicomDataSet wide = picture({32, 20, 19, false}, cells({0x12345678, 0xFFFFF}, false, 4));
  EXPECT_EQ(clear_hidden_bits(wide, kLittle).value(), 1);
  EXPECT_EQ(pixels(wide), cells({0x00045678, 0xFFFFF}, false, 4));
}

TEST(HiddenBits, EightBitsAndBigEndianAndIcons) {
  DicomDataSet eight = picture({8, 7, 6, false}, "\x81\x7F");
  EXPECT_EQ(clear_hidden_bits(eight, kLittle).value(), 1);
  EXPECT_EQ(pixels(eight), "\x01\x7F");
  DicomDataSet big = picture({}, cells({0xF123, 0x0456}, true), true);
  EXPECT_EQ(clear_hidden_bits(big, kBig).value(), 1);
  EXPECT_EQ(pixels(big), cells({0x0123, 0x0456}, true));
  DicomDataSet outer;
  DicomElement& icon = outer.emplace_back();
  icon.tag = 0x00880200;
  icon.is_sequence = true;
  icon.inside = kLittle;
  icon.items.push_back(picture({}, cells({0xF123, 0x0456})));
  EXPECT_EQ(clear_hidden_bits(outer, kLittle).value(), 1);
  EXPECT_EQ(pixels(outer.back().items.front()), cells({0x0123, 0x0456}));
}

TEST(HiddenBits, SoundPicturesStayByteForByte) {
  for (const Bits& bits : {Bits{}, Bits{16, 12, 11, true}, Bits{16, 16, 15, true}, Bits{8, 8, 7, false}}) {
    const std::string before = bits.stored == 16
                                   ? cells({0xFFFF, 0x8000})
                                   : cells(bits.is_signed ? std::initializer_list<unsigned>{0xF800, 0x07FF}
                                                          : std::initializer_list<unsigned>{0x0FFF, 1});
    DicomDataSet set = picture(bits, before);
    EXPECT_EQ(clear_hidden_bits(set, kLittle).value(), 0);
    EXPECT_EQ(pixels(set), before);
  }
  // Padding outside the stored bits, as many CTs have it, is a constant and stays what viewers look for.
  DicomDataSet padded = picture({}, cells({0xF830, 0x0123, 0xF831}));
  DicomElement padding;
  padding.tag = 0x00280120;
  padding.set("US", cells({0xF830}));
  padded.insert(padded.begin(), std::move(padding));
  EXPECT_EQ(clear_hidden_bits(padded, kLittle).value(), 1);
  EXPECT_EQ(pixels(padded), cells({0xF830, 0x0123, 0x0831}));
}

// Only the first value stayed: cells of the rest of the range became tissue.
TEST(HiddenBits, TheDeclaredRangeOfPaddingStays) {
  const auto cleared = [](bool is_signed, unsigned first, unsigned limit, std::initializer_list<unsigned> before) {
    DicomDataSet set = picture({16, 12, 11, is_signed}, cells(before));
    DicomDataSet padding;
    put(padding, 0x00280120, "US", cells({first}));
    put(padding, 0x00280121, "US", cells({limit}));
    set.insert(set.begin(), std::make_move_iterator(padding.begin()), std::make_move_iterator(padding.end()));
    EXPECT_EQ(clear_hidden_bits(set, kLittle).value(), 1);
    return pixels(set);
  };
  EXPECT_EQ(cleared(false, 0xF830, 0xF83F, {0xF830, 0xF839, 0xF83F, 0xF840}),
            cells({0xF830, 0xF839, 0xF83F, 0x0840}));
  EXPECT_EQ(cleared(false, 0xF83F, 0xF830, {0xF830, 0xF839, 0xF83F, 0xF82F}),
            cells({0xF830, 0xF839, 0xF83F, 0x082F}))
      << "whichever end is named first";
  // From -2048 to 4096, as signed pixels have it.
  EXPECT_EQ(cleared(true, 0xF800, 0x1000, {0xF800, 0x1000, 0x7123, 0x8123}),
            cells({0xF800, 0x1000, 0x0123, 0x0123}));
}

std::string item(std::string fragment) {
  if (fragment.size() % 2 != 0) fragment += '\0';
  return cells({0xE000FFFE}, false, 4) + cells({static_cast<unsigned>(fragment.size())}, false, 4) + fragment;
}

// A packed picture is either known to hold no such bits, or refused.
TEST(HiddenBits, PackedPicturesThatMayHoldSomeAreRefused) {
  const auto outcome = [](const Bits& bits, const std::string& fragment) {
    DicomDataSet set = picture(bits, item({}) + item(fragment));
    set.back().is_encapsulated = true;
    const auto done = clear_hidden_bits(set, kLittle);
    return done ? std::string("sound") : done.error().code;
  };
  const auto jpeg = [](char precision, char marker = '\xC3') {
    return std::string("\xFF\xD8\xFF") + marker + std::string("\0\x0B", 2) + precision +
           std::string("\0\1\0\4\1\1\x11\0", 8) + "\xFF\xD9";
  };
  EXPECT_EQ(outcome({}, jpeg(12)), "sound");
  EXPECT_EQ(outcome({}, jpeg(12, '\xF7')), "sound") << "JPEG-LS";
  EXPECT_EQ(outcome({}, jpeg(16)), "hidden_bits");
  EXPECT_EQ(outcome({16, 16, 15, false}, jpeg(16)), "sound");
  EXPECT_EQ(outcome({}, std::string("\xFF\xD8\xFF", 3)), "hidden_bits") << "cut short";
  EXPECT_EQ(outcome({}, "MPEG or what not"), "hidden_bits");
  std::string j2k = "\xFF\x4F\xFF\x51" + std::string(38, '\0') + '\x0B' + "\1\1";
  EXPECT_EQ(outcome({}, j2k), "sound");
  j2k[42] = '\x0F';
  EXPECT_EQ(outcome({}, j2k), "hidden_bits");
  // RLE (PS3.5 §G): the high bytes, then the low ones, four pixels each as a literal run.
  const auto rle = [](const std::string& high) {
    std::string header = cells({2, 64, 70}, false, 4);
    header.resize(64);
    return header + std::string("\3") + high + std::string("\x80") + std::string("\3") + "abcd" +
           std::string("\x80");
  };
  EXPECT_EQ(outcome({}, rle("\1\2\3\4")), "sound");
  EXPECT_EQ(outcome({}, rle("\1\2\x33\4")), "hidden_bits");
  EXPECT_EQ(outcome({16, 11, 14, false}, jpeg(11)), "hidden_bits") << "beside the low bits";
  EXPECT_EQ(outcome({12, 10, 9, false}, "x"), "hidden_bits");
}

}  // namespace
}  // namespace seldinger::casedb

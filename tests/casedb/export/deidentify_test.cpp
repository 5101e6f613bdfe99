// The Basic Profile against files in which every element of its table holds an identifier, at four depths and in
// six transfer syntaxes; the standard's table; and what is refused.
#include "casedb/export/deidentify.h"

#include <gdcmReader.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iostream>
#include <map>
#include <set>
#include <sstream>

#include "casedb/export/clean_data_set.h"
#include "casedb/export/dicom_tree.h"
#include "casedb/import/jail/jail.h"
#include "casedb/import/privacy/basic_profile.h"
#include "tests/casedb/export/planted_dicom.h"
#include "tests/fixtures/outcomes.h"
#include "tests/fixtures/places.h"
#include "tests/fixtures/process.h"
#include "tests/fixtures/shared_data.h"

namespace seldinger::casedb {
namespace {

namespace fs = std::filesystem;

HashKey key_of(int number) {
  HashKey key{};
  key.fill(static_cast<std::byte>(number));
  return key;
}

fs::path write(const fs::path& file, const std::string& bytes) {
  fs::create_directories(file.parent_path());
  std::ofstream out(file, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return file;
}

fs::path scratch() {
  return fixtures::fresh_test_folder("casedb_export");
}

// A clean file read back: the data set behind the meta group.
struct ReadBack {
  std::string bytes, syntax;
  DicomDataSet meta, data_set;
};

ReadBack read_back(const std::string& bytes) {
  ReadBack read{bytes, {}, {}, {}};
  EXPECT_EQ(bytes.substr(0, 132), std::string(128, '\0') + "DICM");
  const std::size_t length = static_cast<unsigned char>(bytes[140]) + 256U * static_cast<unsigned char>(bytes[141]);
  auto meta = read_data_set(std::string_view(read.bytes).substr(132, 12 + length), {true, false});
  EXPECT_TRUE(meta.has_value());
  if (meta) read.meta = std::move(*meta);
  for (const DicomElement& one : read.meta)
    if (one.tag == 0x00020010) read.syntax = one.text();
  const DicomFormat format{read.syntax != "1.2.840.10008.1.2", read.syntax == "1.2.840.10008.1.2.2"};
  auto data = read_data_set(std::string_view(read.bytes).substr(144 + length), format);
  EXPECT_TRUE(data.has_value()) << (data ? "" : data.error().code);
  if (data) read.data_set = std::move(*data);
  return read;
}

const DicomElement* find(const DicomDataSet& set, std::uint32_t tag) {
  for (const DicomElement& one : set)
    if (one.tag == tag) return &one;
  return nullptr;
}

std::string text_of(const DicomDataSet& set, std::uint32_t tag) {
  const DicomElement* one = find(set, tag);
  return one == nullptr ? "" : one->text();
}

// The four levels of a planted file.
std::vector<const DicomDataSet*> levels_of(const DicomDataSet& top) {
  std::vector<const DicomDataSet*> levels = {&top};
  for (const std::uint32_t tag : {0x52009229U, 0x00209116U, 0x00209113U}) {
    const DicomElement* sequence = find(*levels.back(), tag);
    if (sequence == nullptr || sequence->items.empty()) return levels;
    levels.push_back(&sequence->items.front());
  }
  return levels;
}

const PlantedElement* find(const PlantedSet& set, std::uint32_t tag) {
  for (const PlantedElement& one : set)
    if (one.tag == tag) return &one;
  return nullptr;
}

// Whether one row's action was done. Compound codes allow each of their alternatives; none of them leaves the
// value.
testing::AssertionResult done(const ProfileRow& row, const DicomElement* after, const PlantedElement& before) {
  const bool gone = after == nullptr;
  const bool empty = !gone && after->value.empty() && after->items.empty();
  const bool other = !gone && !empty && (after->is_sequence || after->value != before.value);
  const std::string text = gone ? "" : after->text();
  bool good = false;
  std::istringstream codes(row.code);
  for (std::string code; std::getline(codes, code, '/');) {
    if (code == "X") good = good || gone;
    if (code == "Z") good = good || empty;
    if (code == "D") good = good || other;
    if (code == "U" && !(!gone && after->is_sequence)) good = good || (other && text.starts_with("2.25."));
    if (code == "U*")
      good = good || (!gone && after->is_sequence && after->items.size() == 2 &&
                      text_of(after->items[0], 0x00081155).starts_with("2.25."));
  }
  if (good) return testing::AssertionSuccess();
  return testing::AssertionFailure() << row.keyword << " " << row.code
                                     << (gone    ? " gone"
                                         : empty ? " empty"
                                                 : " there");
}

TEST(BasicProfile, IsTheStandardsTable) {
  SELDINGER_NEEDS_SHARED_DATA();
  std::ifstream tsv(fixtures::shared_data_dir() / "dicom-basic-profile-2024b.tsv");
  ASSERT_TRUE(tsv.good());
  std::string line;
  std::getline(tsv, line);
  std::size_t count = 0, ranges = 0;
  while (std::getline(tsv, line)) {
    ++count;
    std::istringstream fields(line);
    std::string tag, vr, keyword, code;
    std::getline(fields, tag, '\t');
    std::getline(fields, vr, '\t');
    std::getline(fields, keyword, '\t');
    std::getline(fields, code, '\t');
    const auto number = static_cast<std::uint32_t>(std::stoul(tag.substr(0, 4) + tag.substr(5, 4), nullptr, 16));
    const ProfileRow* row = profile_row(number);
    ASSERT_NE(row, nullptr) << tag;
    EXPECT_EQ(row->code, code) << tag;
    EXPECT_EQ(row->vr, vr) << tag;
    EXPECT_EQ(row->keyword, keyword) << tag;
    if (tag.size() > 9) {
      ++ranges;
      EXPECT_NE(row->mask, kWholeTag);
      EXPECT_EQ(profile_row(number + 0x001E0000), row) << "the last of the group's repeats";
      EXPECT_EQ(profile_row(number + 0x00010000), nullptr) << "odd groups are private";
    } else {
      EXPECT_EQ(row->mask, kWholeTag);
    }
  }
  EXPECT_EQ(count, 620U);
  EXPECT_EQ(ranges, 3U);
  EXPECT_EQ(basic_profile().size(), count);
  EXPECT_EQ(profile_row(0x00080060), nullptr);
}

TEST(Deidentify, EveryActionIsDoneAtEveryDepthInEverySyntaxAndNothingSurvives) {
  SELDINGER_NEEDS_SHARED_DATA();
  std::size_t actions = 0, right = 0, identifiers = 0, survived = 0;
  for (const PlantedSyntax syntax : kPlantedSyntaxes) {
    const fs::path folder = scratch();
    const Planted planted = planted_slice(1, syntax);
    const auto clean =
        deidentify_file(write(folder / "in.dcm", planted_bytes(planted.elements, syntax)), key_of(1));
    ASSERT_TRUE(clean.has_value()) << clean.error().code;
    const ReadBack back = read_back(clean->bytes);
    const auto levels = levels_of(back.data_set);
    ASSERT_EQ(levels.size(), 4U);
    std::vector<const PlantedSet*> before = {&planted.elements};
    for (const std::uint32_t tag : {0x52009229U, 0x00209116U, 0x00209113U})
      before.push_back(&find(*before.back(), tag)->items.front());
    for (std::size_t depth = 0; depth < levels.size(); ++depth)
      for (const ProfileRow& row : basic_profile()) {
        const PlantedElement* was = find(*before[depth], row.tag);
        if (was == nullptr) continue;
        ++actions;
        const auto good = done(row, find(*levels[depth], row.tag), *was);
        right += good ? 1 : 0;
        EXPECT_TRUE(good) << "depth " << depth << ", syntax " << static_cast<int>(syntax);
      }
    for (const DicomDataSet* level : levels)
      for (const DicomElement& one : *level) {
        EXPECT_EQ(one.tag >> 16 & 1U, 0U) << "private";
        EXPECT_NE(one.tag & 0xFFFF, 0U) << "group length";
        EXPECT_TRUE(one.tag >> 24 != 0x50 && one.tag >> 24 != 0x60) << "overlay or curve";
      }
    identifiers += planted.identifiers.size();
    EXPECT_GE(planted.identifiers.size(), 750U);
    const auto left = survivors(clean->bytes, planted.identifiers);
    survived += left.size();
    EXPECT_TRUE(left.empty()) << left.front();
    // The pixels, to the byte.
    const DicomElement* pixels = find(back.data_set, 0x7FE00010);
    ASSERT_NE(pixels, nullptr);
    std::string expected = pixels_of(planted.elements);
    if (syntax == PlantedSyntax::explicit_be)
      for (std::size_t i = 0; i + 1 < expected.size(); i += 2) std::swap(expected[i], expected[i + 1]);
    EXPECT_TRUE(pixels->value == expected) << "syntax " << static_cast<int>(syntax);
    // What says that it was done.
    EXPECT_EQ(text_of(back.data_set, 0x00120062), "YES");
    EXPECT_EQ(text_of(back.data_set, 0x00120063), kDeidentificationMethod);
    EXPECT_EQ(text_of(find(back.data_set, 0x00120064)->items.front(), 0x00080100), "113100");
    EXPECT_EQ(text_of(back.meta, 0x00020003), text_of(back.data_set, 0x00080018));
    EXPECT_EQ(text_of(back.meta, 0x00020003), clean->sop_instance_uid);
    EXPECT_EQ(text_of(back.data_set, 0x00181210), "") << "a kernel that repeats the name";
    EXPECT_EQ(text_of(back.data_set, 0x00080070), "") << "a maker that repeats the name";
    EXPECT_EQ(text_of(back.data_set, 0x00180022), "") << "no code string";
    // Another reader reads it.
    gdcm::Reader reader;
    const fs::path out = write(folder / "out.dcm", clean->bytes);
    reader.SetFileName(out.c_str());
    EXPECT_TRUE(reader.Read()) << static_cast<int>(syntax);
    EXPECT_TRUE(reader.GetFile().GetDataSet().FindDataElement(gdcm::Tag(0x7fe0, 0x0010)));
  }
  std::cout << "[ de-identification ] " << right << " of " << actions << " actions done, " << survived << " of "
            << identifiers << " identifiers survive, " << kPlantedSyntaxes.size() << " transfer syntaxes\n";
  EXPECT_GE(static_cast<double>(right), 0.999 * static_cast<double>(actions));
  EXPECT_EQ(survived, 0U);
  EXPECT_GT(actions, 6U * 4U * 600U);
}

TEST(Deidentify, ASeriesStaysASeriesAndFilesGetNewNames) {
  const fs::path folder = scratch();
  const auto identifiers = plant_series(folder / "PLNTFOLDER in", PlantedSyntax::explicit_le);
  ASSERT_TRUE(deidentify(folder / "PLNTFOLDER in", folder / "out", key_of(1)).has_value());
  ASSERT_TRUE(deidentify(folder / "PLNTFOLDER in", folder / "same", key_of(1)).has_value());
  ASSERT_TRUE(deidentify(folder / "PLNTFOLDER in", folder / "other", key_of(2)).has_value());
  std::set<std::string> studies, series, instances;
  for (int i = 1; i <= 3; ++i) {
    const std::string name = "image_00000" + std::to_string(i) + ".dcm";
    const std::string bytes = fixtures::whole_file(folder / "out" / name);
    EXPECT_EQ(bytes, fixtures::whole_file(folder / "same" / name));
    EXPECT_TRUE(survivors(bytes, identifiers).empty());
    const ReadBack back = read_back(bytes), other = read_back(fixtures::whole_file(folder / "other" / name));
    studies.insert(text_of(back.data_set, 0x0020000D));
    series.insert(text_of(back.data_set, 0x0020000E));
    instances.insert(text_of(back.data_set, 0x00080018));
    EXPECT_NE(text_of(back.data_set, 0x0020000E), text_of(other.data_set, 0x0020000E)) << "another key";
    const std::string uid = text_of(back.data_set, 0x00080018);
    EXPECT_TRUE(uid.starts_with("2.25.") && uid.size() <= 64 && uid[5] != '0') << uid;
    EXPECT_EQ(uid.find_first_not_of("0123456789."), std::string::npos);
    EXPECT_EQ(text_of(back.data_set, 0x00080016), "1.2.840.10008.5.1.4.1.1.2") << "UIDs of the standard stay";
  }
  EXPECT_EQ(studies.size(), 1U);
  EXPECT_EQ(series.size(), 1U);
  EXPECT_EQ(instances.size(), 3U);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "out"), {}), 3);
}

// The largest file alone counted, so that a study of 7,000 pictures ended after the minute that one file has.
TEST(Deidentify, ItsTimeIsThatOfAllFiles) {
  const fs::path folder = scratch();
  static_cast<void>(plant_series(folder / "in", PlantedSyntax::explicit_le));
  std::uintmax_t bytes = 0, count = 0;
  for (const auto& entry : fs::directory_iterator(folder / "in")) {
    bytes += entry.file_size();
    ++count;
  }
  ASSERT_GE(count, 3U);
  ASSERT_TRUE(deidentify(folder / "in", folder / "out", key_of(1)).has_value());
  EXPECT_GE(last_jail_use().work_bytes, bytes + count * 64 * 1024);
}

TEST(Deidentify, SeveralUidsInOneElementAreReplacedEach) {
  DataSetCleaner cleaner(key_of(3));
  DicomDataSet set(1);
  set[0].tag = 0x00080058;
  set[0].set("UI", "1.2.3\\1.2.4\\\\1.2.3");
  cleaner.clean(set);
  EXPECT_EQ(set[0].text(),
            cleaner.new_uid("1.2.3") + "\\" + cleaner.new_uid("1.2.4") + "\\\\" + cleaner.new_uid("1.2.3"));
  EXPECT_NE(cleaner.new_uid("1.2.3"), cleaner.new_uid("1.2.4"));
  EXPECT_EQ(cleaner.new_uid(""), "");
}

const char* const kVrs[] = {"AE", "AS", "AT", "CS", "DA", "DS", "DT", "FD", "FL", "IS", "LO", "LT",
                            "OB", "OD", "OF", "OL", "OV", "OW", "PN", "SH", "SL", "SQ", "SS", "ST",
                            "SV", "TM", "UC", "UI", "UL", "UN", "UR", "US", "UT", "UV"};

// Every VR, in elements with every action, without one, unknown ones and private ones: empty, of odd length, and
// not what the VR says.
TEST(Deidentify, NoVrBringsItDown) {
  static_assert(std::size(kVrs) == 34);
  const fs::path folder = scratch();
  const std::uint32_t tags[] = {0x00080014, 0x00080050, 0x00100010, 0x0008002A, 0x00180022, 0x00181210,
                                0x00081115, 0x0040A730, 0x00081140, 0x0008FFF0, 0x00091001, 0x00280301};
  Planted few = planted_slice(0, PlantedSyntax::explicit_le);
  std::erase_if(few.elements,
                [](const PlantedElement& one) { return one.tag >> 16 >= 0x0028 || one.tag % 5 == 0; });
  int cleaned = 0;
  for (const char* vr : kVrs) {
    EXPECT_FALSE(dummy_value(vr).empty()) << vr;
    for (const std::string& value :
         {std::string(), std::string("x"), std::string(7, '\xFF'), std::string(1001, 'Z'), std::string(8, '\0'),
          std::string("\xFE\xFF\x00\xE0\xFF\xFF\xFF\xFF", 8), std::string("\\\\\\")}) {
      Planted planted = few;
      for (const std::uint32_t tag : tags) {
        std::erase_if(planted.elements, [&](const PlantedElement& one) { return one.tag == tag; });
        const PlantedElement odd{tag, vr, value};
        planted.elements.insert(std::find_if(planted.elements.begin(), planted.elements.end(),
                                             [&](const auto& one) { return one.tag > tag; }),
                                odd);
      }
      for (const PlantedSyntax syntax : {PlantedSyntax::explicit_le, PlantedSyntax::implicit_le}) {
        if (syntax == PlantedSyntax::implicit_le)  // there the dictionary makes them sequences of garbage
          std::erase_if(planted.elements, [](const PlantedElement& one) {
            return one.tag == 0x00081115 || one.tag == 0x0040A730 || one.tag == 0x00081140;
          });
        const auto clean =
            deidentify_file(write(folder / "in.dcm", planted_bytes(planted.elements, syntax)), key_of(1));
        if (!clean) continue;  // e.g. a sequence of garbage
        ++cleaned;
        EXPECT_GT(read_back(clean->bytes).data_set.size(), 20U);
      }
    }
  }
  EXPECT_GT(cleaned, 34 * 6 * 2);  // of 34 · 7 · 2
}

TEST(Deidentify, NestingOfAHundredIsFollowedAndOfTwoHundredRefused) {
  const fs::path folder = scratch();
  for (const int depth : {100, 128, 129, 200, 20000}) {
    Planted planted = planted_slice(0, PlantedSyntax::explicit_le);
    std::erase_if(planted.elements, [](const PlantedElement& one) { return one.tag == 0x52009229; });
    PlantedSet inner = {{0x00100010, "PN", "Deepestname^Of"}, {0x00081115, "SQ", {}, {}}};
    std::string bytes;
    // Text by hand: recursion of the writer would end before ours does.
    const std::string open("\x08\x00\x15\x11SQ\0\0\xFF\xFF\xFF\xFF\xFE\xFF\x00\xE0\xFF\xFF\xFF\xFF", 20);
    const std::string close("\xFE\xFF\x0D\xE0\0\0\0\0\xFE\xFF\xDD\xE0\0\0\0\0", 16);
    for (int i = 0; i < depth; ++i) bytes += open;
    bytes += std::string("\x10\x00\x10\x00PN\x0E\x00", 8) + "Deepestname^Of";
    for (int i = 0; i < depth; ++i) bytes += close;
    const std::string whole = planted_bytes(planted.elements, PlantedSyntax::explicit_le);
    const std::size_t at =
        whole.find(std::string("\x08\x00\x60\x00"
                               "CS",
                               6));
    ASSERT_NE(at, std::string::npos);
    const auto clean =
        deidentify_file(write(folder / "in.dcm", whole.substr(0, at) + bytes + whole.substr(at)), key_of(1));
    ASSERT_EQ(clean.has_value(), depth <= 128) << depth;
    if (!clean)
      EXPECT_EQ(clean.error().code, "too_deep");
    else
      EXPECT_EQ(clean->bytes.find("Deepestname"), std::string::npos);
  }
}

TEST(Deidentify, DamageBringsItDownNowhere) {
  const fs::path folder = scratch();
  fixtures::Outcomes outcomes;
  std::uint64_t state = 42;
  const auto random = [&](std::size_t below) {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<std::size_t>(state >> 33) % below;
  };
  for (const PlantedSyntax syntax :
       {PlantedSyntax::explicit_le, PlantedSyntax::implicit_le, PlantedSyntax::deflated, PlantedSyntax::rle}) {
    Planted planted = planted_slice(0, syntax);
    // Fewer elements, so that a change hits heads as often as values.
    std::erase_if(planted.elements, [](const PlantedElement& one) { return one.tag == 0x7FE00010; });
    std::erase_if(planted.elements,
                  [](const PlantedElement& one) { return one.tag % 7 != 0 && one.tag >> 16 != 0x0008; });
    const std::string good = planted_bytes(planted.elements, syntax);
    for (int round = 0; round < 300; ++round) {
      std::string bad = good;
      switch (round % 3) {
        case 0:
          bad.resize(random(good.size()));
          break;
        case 1:
          for (int i = 0; i < 3; ++i) bad[random(bad.size())] = static_cast<char>(random(256));
          break;
        default:
          bad.erase(random(bad.size() - 8), 1 + random(8));
      }
      const auto clean = deidentify_file(write(folder / "in.dcm", bad), key_of(1));
      outcomes.add(clean);
      if (clean) {
        EXPECT_EQ(text_of(read_back(clean->bytes).data_set, 0x00120062), "YES");
      }
    }
  }
  outcomes.expect_both();
  EXPECT_GT(outcomes.refused, 300);
}

TEST(Deidentify, WhatTheProfileCannotMakeSafeIsRefused) {
  SELDINGER_NEEDS_SHARED_DATA();
  const fs::path samples = fixtures::shared_data_dir() / "dicom-samples";
  const std::map<std::string, std::string> expected = {{"CT_small", ""},
                                                       {"MR_small", ""},
                                                       {"MR_small_bigendian", ""},
                                                       {"SC_rgb_rle", "secondary_capture"},
                                                       {"chest_deflated", ""},
                                                       {"chest_explicit_le", ""},
                                                       {"chest_j2k_lossless", ""},
                                                       {"chest_jpeg12_lossy", ""},
                                                       {"chest_jpeg_lossless_sv1", ""},
                                                       {"chest_jpegls_lossless", ""},
                                                       {"chest_rle", ""},
                                                       {"emri_small", ""},
                                                       {"liver_1frame", ""},
                                                       {"rtdose", ""},
                                                       {"rtstruct", ""},
                                                       {"sr_no_pixel_data", "report"},
                                                       {"us_no_pixel_spacing", "may_have_text"},
                                                       {"no_meta_group_length", ""},
                                                       {"priv_SQ", ""}};
  for (const auto& [name, code] : expected) {
    const auto clean = deidentify_file(samples / (name + ".dcm"), key_of(1));
    EXPECT_EQ(clean ? "" : clean.error().code, code) << name;
  }
  const fs::path folder = scratch();
  const auto one = [&](std::uint32_t tag, const char* vr, const std::string& value) {
    Planted planted = planted_slice(0, PlantedSyntax::explicit_le);
    std::erase_if(planted.elements, [&](const PlantedElement& e) { return e.tag == tag; });
    planted.elements.insert(
        std::find_if(planted.elements.begin(), planted.elements.end(), [&](const auto& e) { return e.tag > tag; }),
        {tag, vr, value});
    const auto clean = deidentify_file(
        write(folder / "in.dcm", planted_bytes(planted.elements, PlantedSyntax::explicit_le)), key_of(1));
    return clean ? std::string() : clean.error().code;
  };
  EXPECT_EQ(one(0x00280301, "CS", "YES "), "burned_in");
  EXPECT_EQ(one(0x00280301, "CS", "NO"), "");
  EXPECT_EQ(one(0x00080008, "CS", "DERIVED\\SECONDARY\\SCREEN SAVE"), "burned_in");
  EXPECT_EQ(one(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.104.1"), "report");
  EXPECT_EQ(one(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.66"), "unknown_object");
  EXPECT_EQ(one(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.66.4"), "") << "a segmentation";
  EXPECT_EQ(one(0x00080016, "UI", "1.2.840.113619.4.27"), "unknown_object");
  EXPECT_EQ(one(0x00080016, "UI", "1.2.840.10008.1.3.10"), "dicomdir");
  EXPECT_EQ(one(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.7.4"), "secondary_capture");
}

TEST(Deidentify, FilesWithoutPreambleAreReadAndGetOne) {
  const fs::path folder = scratch();
  const Planted planted = planted_slice(0, PlantedSyntax::explicit_le);
  const std::string whole = planted_bytes(planted.elements, PlantedSyntax::explicit_le);
  const auto clean = deidentify_file(write(folder / "in.dcm", whole.substr(132)), key_of(1));
  ASSERT_TRUE(clean.has_value()) << clean.error().code;
  EXPECT_EQ(clean->bytes, deidentify_file(write(folder / "in.dcm", whole), key_of(1)).value().bytes);
}

TEST(Deidentify, AFolderLeavesOutWhatCannotBeMadeSafe) {
  SELDINGER_NEEDS_SHARED_DATA();
  const fs::path folder = scratch();
  plant_series(folder / "in/deep/er", PlantedSyntax::implicit_le);
  const fs::path samples = fixtures::shared_data_dir() / "dicom-samples";
  fs::copy(samples / "SC_rgb_rle.dcm", folder / "in");
  write(folder / "in/PLNTname.txt", "a note about Plantedname");
  const auto done = deidentify(folder / "in", folder / "out", key_of(1));
  ASSERT_TRUE(done.has_value()) << done.error().code;
  EXPECT_EQ(done->files, 3);
  EXPECT_EQ(done->left_out, (std::map<std::string, int>{{"not_dicom", 1}, {"secondary_capture", 1}}));
  EXPECT_GT(done->counts.at("removed"), 3000);
  EXPECT_GT(done->counts.at("private"), 20);
}

TEST(Deidentify, NothingIsLeftBehindByARefusal) {
  const fs::path folder = scratch();
  const auto refusal = [&](const fs::path& in, const fs::path& out) {
    const auto done = deidentify(in, out, key_of(1));
    return done ? std::string() : done.error().code;
  };
  plant_series(folder / "in", PlantedSyntax::explicit_le);
  write(folder / "full/a", "a");
  EXPECT_EQ(refusal(folder / "in", folder / "full"), "exists");
  EXPECT_EQ(refusal(folder / "in", folder / "in"), "exists");
  EXPECT_EQ(refusal(folder / "absent", folder / "out"), "not_found");
  write(folder / "none/a.txt", "a");
  EXPECT_EQ(refusal(folder / "none", folder / "out"), "nothing_left");
  const std::string whole = fixtures::whole_file(folder / "in/PLNTFILE^NAME^1.dcm");
  write(folder / "in/z.dcm", whole.substr(0, whole.size() / 2));
  EXPECT_EQ(refusal(folder / "in", folder / "out"), "truncated");
  std::set<std::string> there;
  for (const auto& entry : fs::directory_iterator(folder)) there.insert(entry.path().filename());
  EXPECT_EQ(there, (std::set<std::string>{"full", "in", "none"}));
  fs::remove(folder / "in/z.dcm");
  fs::create_directory(folder / "empty");
  EXPECT_EQ(refusal(folder / "in", folder / "empty"), "");
  EXPECT_EQ(refusal(folder / "in/PLNTFILE^NAME^1.dcm", folder / "one.dcm"), "");
  EXPECT_TRUE(fs::is_regular_file(folder / "one.dcm"));
  EXPECT_EQ(refusal(folder / "in/PLNTFILE^NAME^1.dcm", folder / "new/one"), "");
  EXPECT_TRUE(fs::is_regular_file(folder / "new/one/image_000001.dcm"));
}

// Its folder bore a random name, so that no later run could know it.
TEST(Deidentify, TheNextRunTakesWhatAKilledOneLeft) {
  const fs::path folder = scratch();
  plant_series(folder / "in", PlantedSyntax::explicit_le);
  write(folder / "monday.unfinished/new_image_000001.dcm", "half");
  write(folder / "monday.unfinished/image_000002.dcm.tmp-4194305-1", "half");
  write(folder / "mine.unfinished/image_000001.dcm", "whole");
  write(folder / "mine.unfinished/notes.txt", "mine");
  write(folder / "out.unfinished/new_image_000001.dcm", "half");
  ASSERT_TRUE(deidentify(folder / "in", folder / "out", key_of(1)).has_value());
  EXPECT_FALSE(fs::exists(folder / "monday.unfinished"));
  EXPECT_TRUE(fs::exists(folder / "mine.unfinished/image_000001.dcm"));
  EXPECT_FALSE(fs::exists(folder / "out.unfinished"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "out"), {}), 3);
}

}  // namespace
}  // namespace seldinger::casedb

// Escaping: nothing that people wrote can become markup, hide, or turn around what stands beside it.
#include "reports/markup/html.h"

#include <gtest/gtest.h>

namespace seldinger::reports {
namespace {

TEST(Escaping, MarkupInTextIsShownAsText) {
  EXPECT_EQ(escaped("<img src=x onerror=alert(1)>"), "&lt;img src=x onerror=alert(1)&gt;");
  EXPECT_EQ(escaped("\" onmouseover='x' &amp;"), "&quot; onmouseover=&#39;x&#39; &amp;amp;");
}

TEST(Escaping, NoInputOfOneOrTwoBytesLeavesAnAngleBracketOrAQuote) {
  for (int a = 0; a < 256; ++a) {
    for (int b = 0; b < 256; ++b) {
      const std::string out = escaped(std::string{static_cast<char>(a), static_cast<char>(b)});
      ASSERT_EQ(out.find_first_of("<>\"'"), std::string::npos) << a << " " << b;
    }
  }
}

TEST(Escaping, BidirectionalControlsAndControlCharactersBecomeVisible) {
  EXPECT_EQ(escaped("ann\u202Egnp.exe"), "ann\uFFFDgnp.exe");
  EXPECT_EQ(escaped("a\u2066b\u200Fc\u061Cd"), "a\uFFFDb\uFFFDc\uFFFDd");
  EXPECT_EQ(escaped(std::string_view("a\0b\x1b\x7f", 5)), "a\uFFFDb\uFFFD\uFFFD");
  EXPECT_EQ(escaped("\u0085"), "\uFFFD");
}

TEST(Escaping, SoundTextOfAnyLanguagePassesUnchanged) {
  for (const char* text : {"Zoë Müller", "李雷", "שלום", "👩‍⚕️", "a\nb\tc", "𝔄"})
    EXPECT_EQ(escaped(text), text);
}

TEST(Escaping, InvalidUtf8IsReplacedByteByByte) {
  EXPECT_EQ(escaped("\xC0\xAF"), "\uFFFD\uFFFD");                      // overlong slash
  EXPECT_EQ(escaped("\xED\xA0\x80"), "\uFFFD\uFFFD\uFFFD");            // surrogate
  EXPECT_EQ(escaped("\xF4\x90\x80\x80"), "\uFFFD\uFFFD\uFFFD\uFFFD");  // beyond U+10FFFF
  EXPECT_EQ(escaped("ok\xE2\x80"), "ok\uFFFD\uFFFD");                  // cut off
  EXPECT_EQ(escaped("\xE2\x28\xA1"), "\uFFFD(\uFFFD");
}

TEST(Html, NamesAreIsolatedFromTheDirectionAroundThem) {
  EXPECT_EQ(Html().name("<b>").str(), "<bdi>&lt;b&gt;</bdi>");
}

}  // namespace
}  // namespace seldinger::reports

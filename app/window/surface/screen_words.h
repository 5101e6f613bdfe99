// The words of each screen, line by line, for a screen reader: what stands in the window, and what has the
// keyboard's focus. A password is not among them.
#pragma once

#include <filesystem>
#include <fstream>
#include <iosfwd>
#include <set>
#include <string>

namespace seldinger::app {

// --- while a frame is drawn; nothing happens unless its words are wanted ---
void want_words(bool wanted);  // of the frame that begins
void gather_words();           // from here on, if they are not gathered already: a popup that ends ends that
void say_words(const std::string& line);  // what is drawn as a picture
std::string take_words();                 // of the whole frame

class ScreenWords {
 public:
  // "-": standard output; empty: nothing is written. Throws base::Failure("disk") when the file cannot be.
  explicit ScreenWords(const std::filesystem::path& path);
  bool wanted() const { return out_ != nullptr; }
  // A screen's name and all of its lines where it has come up, of the same one those that are new; and the focus
  // where that has moved.
  void write(const std::string& screen, const std::string& words, const std::string& focus);

 private:
  std::ofstream file_;
  std::ostream* out_ = nullptr;
  std::string screen_, words_, focus_;
  std::set<std::string> lines_;
};

}  // namespace seldinger::app

// The screens of the workstation, drawn with Dear ImGui: each shows what the trainer knows and tells it what was
// pressed. Text is the case's, the grade's and the steps' own; nothing is decided here.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/window/screens/panel_planning.h"
#include "app/window/surface/attempt_layout.h"
#include "app/window/surface/window.h"
#include "app/window/trainer/trainer.h"
#include "sim/base/training_only.h"
#include "sim/gpu/screen_picture.h"

namespace seldinger::app {

using base::kTrainingOnly;  // every screen says so

class LogInPanel {
 public:
  void draw(Trainer& trainer);

 private:
  std::array<char, 66> name_{};
  std::array<char, 130> password_{};
  bool begun_ = false;
  // Where was typed last, and for how many frames nothing has been: the keyboard goes back there.
  bool in_password_ = false;
  int idle_frames_ = 0;
};

// Asks before what cannot be taken back; nothing else hears the mouse while it does.
class Question {
 public:
  void ask(std::string words, std::string yes, std::string no);
  bool open() const noexcept { return !words_.empty(); }
  void drop() noexcept { words_.clear(); }
  // Each frame of its screen. True: it was said yes, just now.
  bool draw(const Keys& keys);

 private:
  std::string words_, yes_, no_;  // words: empty: nothing is asked
};

class ChoosePanel {
 public:
  explicit ChoosePanel(gpu::Context& context) : context_(context) {}
  // `dropped`: a CT's file or folder that was let fall on the window; empty: none was.
  void draw(Trainer& trainer, const Keys& keys, const std::string& dropped);

 private:
  void draw_choices(Trainer& trainer, const Keys& keys, const std::string& curriculum);
  void draw_drafts(Trainer& trainer);
  void draw_thumbnail(const Trainer& trainer, const std::string& case_id);
  void draw_import(Trainer& trainer, const Keys& keys);

  gpu::Context& context_;
  struct Thumbnail {
    explicit Thumbnail(gpu::Context& context) : picture(context, gpu::ScreenPicture::Pixels::grey) {}
    std::shared_ptr<const CaseThumbnail> shown;
    gpu::ScreenPicture picture;
  };
  std::map<std::string, Thumbnail> thumbnails_;  // by case
  Question question_;
  std::string to_delete_;                           // the draft that is asked about
  bool importing_ = false, import_begins_ = false;  // the form is open; for its first frame
  std::array<char, 1024> source_{};
  std::array<char, 256> import_title_{};
  std::size_t import_guidance_ = 2;  // of casedb::kModalityWords
};

class BriefingPanel {
 public:
  explicit BriefingPanel(gpu::Context& context) : planning_(context) {}
  // True: the trainee has signed in and wants to begin.
  bool draw(Trainer& trainer, const Keys& keys);
  // Once after a drawing in which the trainee wanted to go on with an interrupted attempt.
  bool take_resume() noexcept { return std::exchange(resume_, false); }

 private:
  bool draw_sign_in(const casedb::CaseRow& row);  // whether all of it is checked
  bool draw_enter(Trainer& trainer, const Keys& keys, bool all, bool at_back);

  void draw_task(Trainer& trainer);

  PlanningPanel planning_;
  std::string case_id_;
  std::array<bool, 5> checked_{};
  bool resume_ = false;
  bool could_begin_ = false;  // when it was drawn last
};

// Pieces that several screens have.
void begin_screen(const char* name);  // the whole window; end_screen ends it
void end_screen();
// A part with words and fields, through which the keyboard's way leads. ImGui::EndChild ends it.
void begin_fields(const char* name, float width, float height);
// A part that a picture fills: nothing lies under it, nothing scrolls. 0: what there is. ImGui::EndChild ends it.
void begin_picture(const char* name, float width, float height);
// Pixels where a line's letters are 16 pixels high, as many as the letters of now make of them.
float scaled(float px);
// A part of the window's layout from that corner: of a picture, and of words. ImGui::EndChild ends both.
void begin_part(const char* name, const Part& part, float left, float top);
void begin_words(const char* name, const Part& part, float left, float top);
void heading(const char* text);
void quiet(const char* text);                              // smaller in weight: what explains
inline constexpr unsigned int kTargetColour = 0xFF78E65A;  // as IM_COL32(90, 230, 120, 255)
unsigned int colour_of_rule(cases::StructureRule rule);    // of its outline: red is critical
std::string modality_words(cases::Modality modality);
// In the top line of whatever screen is up, where nothing is pressed; `in_room`: before the clock.
void draw_notice(const std::string& words, bool in_room);

}  // namespace seldinger::app

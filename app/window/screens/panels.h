// The screens of the workstation, drawn with Dear ImGui: each shows what the trainer knows and tells it what was
// pressed. Text is the case's, the grade's and the steps' own; nothing is decided here.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <utility>

#include "app/window/surface/window.h"
#include "app/window/trainer/trainer.h"
#include "sim/base/training_only.h"

namespace seldinger::app {

using base::kTrainingOnly;  // every screen says so

class LogInPanel {
 public:
  void draw(Trainer& trainer);

 private:
  std::array<char, 66> name_{};
  std::array<char, 130> password_{};
  bool begun_ = false;
};

class ChoosePanel {
 public:
  void draw(Trainer& trainer, const Keys& keys);
};

class BriefingPanel {
 public:
  // True: the trainee has signed in and wants to begin.
  bool draw(Trainer& trainer, const Keys& keys);
  // Once after a drawing in which the trainee wanted to go on with an interrupted attempt.
  bool take_resume() noexcept { return std::exchange(resume_, false); }

 private:
  bool draw_sign_in(const casedb::CaseRow& row);  // whether all of it is checked

  std::string case_id_;
  std::array<bool, 5> checked_{};
  bool resume_ = false;
};

// Pieces that several screens have.
void begin_screen(const char* name);  // the whole window; end_screen ends it
void end_screen();
// A part that a picture fills: nothing lies under it, nothing scrolls. 0: what there is. ImGui::EndChild ends it.
void begin_picture(const char* name, float width, float height);
void heading(const char* text);
void quiet(const char* text);  // smaller in weight: what explains
std::string modality_words(cases::Modality modality);
// Below, in the middle, over whatever screen is up.
void draw_notice(const std::string& words);

}  // namespace seldinger::app

#include "app/window/surface/window.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include "app/window/surface/key_focus.h"
#include "app/window/surface/typed_queue.h"
#include "sim/base/failure.h"
#include "sim/gpu/window_surface.h"

namespace seldinger::app {
namespace {

static_assert(kSpace == GLFW_KEY_SPACE && kEscape == GLFW_KEY_ESCAPE && kEnter == GLFW_KEY_ENTER);
static_assert(kTab == GLFW_KEY_TAB && kBackspace == GLFW_KEY_BACKSPACE && kF1 == GLFW_KEY_F1);
static_assert(kRight == GLFW_KEY_RIGHT && kLeft == GLFW_KEY_LEFT && kDown == GLFW_KEY_DOWN && kUp == GLFW_KEY_UP);
static_assert(kPageUp == GLFW_KEY_PAGE_UP && kPageDown == GLFW_KEY_PAGE_DOWN && kHomeKey == GLFW_KEY_HOME);
constexpr int kKeypadEnter = GLFW_KEY_KP_ENTER;
static_assert(kF5 == GLFW_KEY_F5 && kF9 == GLFW_KEY_F9 && kF12 == GLFW_KEY_F12);

static_assert(devices::GamepadReading::kAxes == GLFW_GAMEPAD_AXIS_LAST + 1);
static_assert(devices::GamepadReading::kButtons == GLFW_GAMEPAD_BUTTON_LAST + 1);

// Debian's; without it the font that Dear ImGui brings along, which has no en dash.
constexpr const char* kFont = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
constexpr float kFontPx = 16.0F;

// Letters grow with the window, by eighths, so that they are not made anew with each pixel of it. Larger ones are
// asked for in vain where the screens' parts would no longer find room.
float letters_of(int width_px, int height_px, float asked) {
  constexpr float kLeastAcross = 640.0F, kLeastDown = 480.0F;  // of the window, where letters are 16 pixels high
  const auto width = static_cast<float>(width_px), height = static_cast<float>(height_px);
  const float share = std::min(width / 1280.0F, height / 800.0F);
  const float own = std::clamp(0.125F * std::floor(8.0F * (0.5F + 0.5F * share) + 0.01F), 0.875F, 1.5F);
  return std::min(asked * own, std::min(width / kLeastAcross, height / kLeastDown));
}

void set_style(float scale) {
  ImGuiStyle& style = ImGui::GetStyle();
  style = ImGuiStyle();
  ImGui::StyleColorsDark();
  style.WindowRounding = 0.0F;
  style.FrameRounding = 4.0F;
  style.GrabRounding = 4.0F;
  style.FramePadding = {8.0F, 5.0F};
  style.ItemSpacing = {8.0F, 6.0F};
  style.WindowBorderSize = 0.0F;
  style.WindowPadding = {12.0F, 10.0F};
  style.Colors[ImGuiCol_WindowBg] = {0.075F, 0.085F, 0.10F, 1.0F};
  style.Colors[ImGuiCol_ChildBg] = {0.095F, 0.108F, 0.125F, 1.0F};
  style.Colors[ImGuiCol_Button] = {0.16F, 0.30F, 0.38F, 1.0F};
  style.Colors[ImGuiCol_ButtonHovered] = {0.20F, 0.42F, 0.52F, 1.0F};
  style.Colors[ImGuiCol_ButtonActive] = {0.24F, 0.52F, 0.64F, 1.0F};
  style.Colors[ImGuiCol_FrameBg] = {0.15F, 0.17F, 0.20F, 1.0F};
  style.Colors[ImGuiCol_Header] = {0.16F, 0.30F, 0.38F, 0.8F};
  style.Colors[ImGuiCol_HeaderHovered] = {0.20F, 0.42F, 0.52F, 0.8F};
  style.Colors[ImGuiCol_SliderGrab] = {0.30F, 0.62F, 0.76F, 1.0F};
  style.Colors[ImGuiCol_CheckMark] = {0.40F, 0.80F, 0.95F, 1.0F};
  style.Colors[ImGuiCol_ModalWindowDimBg] = {0.0F, 0.0F, 0.0F, 0.55F};  // behind a question it is darker
  style.ScaleAllSizes(scale);
  ImGuiIO& io = ImGui::GetIO();
  static const ImWchar kLetters[] = {0x20,   0x24F,  0x370,  0x3FF,  0x2010, 0x2044, 0x2070, 0x209F,
                                     0x2190, 0x21FF, 0x2212, 0x2265, 0x2713, 0x2717, 0};
  io.Fonts->Clear();
  if (std::filesystem::exists(kFont)) io.Fonts->AddFontFromFileTTF(kFont, kFontPx * scale, nullptr, kLetters);
}

}  // namespace

bool Keys::pressed(int key) const noexcept {
  return (!typing_ || key >= kF1) && (key != kEnter || !alt) &&
         std::find(pressed_.begin(), pressed_.end(), key) != pressed_.end();
}

bool Keys::alt_enter() const noexcept {
  return alt && std::find(pressed_.begin(), pressed_.end(), kEnter) != pressed_.end();
}

bool Keys::held(int key) const noexcept {
  return pressed(key) || (!typing_ && std::find(down_.begin(), down_.end(), key) != down_.end());
}

struct Window::Parts {
  GLFWwindow* window = nullptr;
  Keys keys;     // of the frame
  Keys between;  // as poll found them
  std::vector<int> down;
  std::vector<int> pressed;  // since the frame began
  int heard = 0;             // that went down since the window opened
  bool shifted = false;      // one of them with Shift, which may be up again
  bool clicked = false;      // a button of the mouse went down since the frame began
  std::optional<gpu::Context> context;
  float screen = 1.0F, letters = 1.0F;  // of the screen's dots; what is asked for
  float scale = 1.0F;                   // of letters and distances, with what the window's size makes of it
  std::array<int, 4> framed{};          // where it was, and how large, before it took the whole screen
  TypedQueue typed;
  std::string dropped;
  bool tab_back = false;     // Shift was down when Tab was pressed last
  std::optional<int> given;  // the queue's key, down for this frame

  // Whether the queue has it, and Dear ImGui not yet. Letters come as such, too; F keys are no field's.
  bool queued(int key) {
    if (key < kEscape || key >= kF1) return false;
    if (!typed.waits() && !(key == kTab && ImGui::GetIO().WantTextInput)) return false;
    typed.key(key);
    return true;
  }
  void give_typed() {
    ImGuiIO& io = ImGui::GetIO();
    if (given) io.KeysDown[*given] = false;
    given.reset();
    if (io.InputQueueCharacters.Size > 0) return;  // what came before the queue
    const TypedQueue::Given now = typed.next_frame(kTab);
    for (const unsigned int letter : now.letters) io.AddInputCharacter(letter);
    given = now.key;
    if (given) io.KeysDown[*given] = true;
  }

  float scale_now() const {
    int width = 0, height = 0;
    glfwGetFramebufferSize(window, &width, &height);
    if (width < 1) return scale;
    return screen * letters_of(static_cast<int>(static_cast<float>(width) / screen),
                               static_cast<int>(static_cast<float>(height) / screen), letters);
  }
  void fit_letters() {
    const float now = scale_now();
    if (now == scale) return;
    scale = now;
    set_style(scale);
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui_ImplOpenGL3_CreateFontsTexture();
  }

  // What the framed item takes no screen hears of.
  void walk(bool walks) {
    std::vector<int>& now = keys.pressed_;
    const auto went_down = [&](int key) { return std::find(now.begin(), now.end(), key) != now.end(); };
    const auto is_press = [](int key) { return key == kEnter || key == kSpace || key == kKeypadEnter; };
    const bool press = !keys.alt && !keys.control && std::any_of(now.begin(), now.end(), is_press);
    const bool tab = went_down(kTab) || given == kTab;
    bool by_mouse = std::exchange(clicked, false);  // however short
    for (int button = GLFW_MOUSE_BUTTON_LEFT; button <= GLFW_MOUSE_BUTTON_MIDDLE; ++button)
      by_mouse = by_mouse || glfwGetMouseButton(window, button) == GLFW_PRESS;
    if (!walk_by_keys(walks, tab, press, by_mouse)) return;
    std::erase_if(now, is_press);
    for (const int key : std::array<int, 3>{kEnter, kSpace, kKeypadEnter}) ImGui::GetIO().KeysDown[key] = false;
  }

  void read(Keys& into) const {
    into.pressed_ = pressed;
    into.down_ = down;
    const auto either = [&](int left, int right) {
      return glfwGetKey(window, left) == GLFW_PRESS || glfwGetKey(window, right) == GLFW_PRESS;
    };
    into.shift = shifted || either(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT);
    into.control = either(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL);
    into.alt = either(GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT);
  }
};

Window::Window(const Settings& settings) : parts_(std::make_unique<Parts>()) {
  if (glfwInit() != GLFW_TRUE) throw base::Failure("display", "there is no display to open a window on");
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  GLFWmonitor* monitor = settings.whole_screen ? glfwGetPrimaryMonitor() : nullptr;
  const GLFWvidmode* mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
  parts_->window =
      glfwCreateWindow(mode != nullptr ? mode->width : settings.width,
                       mode != nullptr ? mode->height : settings.height, settings.title.c_str(), monitor, nullptr);
  if (parts_->window == nullptr) {
    glfwTerminate();
    throw base::Failure("gl", "cannot open a window with OpenGL 4.3");
  }
  if (mode == nullptr)
    glfwSetWindowSizeLimits(parts_->window, kLeastWidth, kLeastHeight, GLFW_DONT_CARE, GLFW_DONT_CARE);
  glfwMakeContextCurrent(parts_->window);
  parts_->context.emplace(gpu::Context::of_window());
  glfwSwapInterval(parts_->context->software() ? 0 : 1);  // software has nobody's beam to wait for
  glfwSetWindowUserPointer(parts_->window, parts_.get());
  glfwSetKeyCallback(parts_->window, [](GLFWwindow* window, int key, int code, int action, int modifiers) {
    auto* parts = static_cast<Parts*>(glfwGetWindowUserPointer(window));
    std::vector<int>& down = parts->down;
    if (key == GLFW_KEY_TAB && action == GLFW_PRESS) parts->tab_back = (modifiers & GLFW_MOD_SHIFT) != 0;
    if (action == GLFW_PRESS) {
      parts->pressed.push_back(key);
      ++parts->heard;
      parts->shifted = parts->shifted || (modifiers & GLFW_MOD_SHIFT) != 0;
      down.push_back(key);
    } else if (action == GLFW_RELEASE) {
      down.erase(std::remove(down.begin(), down.end(), key), down.end());
    }
    if (action == GLFW_PRESS && key >= 0 && parts->queued(key)) {
      parts->pressed.pop_back();
      return;
    }
    ImGui_ImplGlfw_KeyCallback(window, key, code, action, modifiers);
  });
  glfwSetCharCallback(parts_->window, [](GLFWwindow* window, unsigned int letter) {
    auto* parts = static_cast<Parts*>(glfwGetWindowUserPointer(window));
    if (parts->typed.waits())
      parts->typed.letter(letter);
    else
      ImGui_ImplGlfw_CharCallback(window, letter);
  });
  glfwSetDropCallback(parts_->window, [](GLFWwindow* window, int count, const char** paths) {
    if (count > 0) static_cast<Parts*>(glfwGetWindowUserPointer(window))->dropped = paths[0];
  });
  glfwSetMouseButtonCallback(parts_->window, [](GLFWwindow* window, int button, int action, int modifiers) {
    if (action == GLFW_PRESS) static_cast<Parts*>(glfwGetWindowUserPointer(window))->clicked = true;
    ImGui_ImplGlfw_MouseButtonCallback(window, button, action, modifiers);
  });
  glfwSetScrollCallback(parts_->window, ImGui_ImplGlfw_ScrollCallback);
  glfwSetWindowFocusCallback(parts_->window, ImGui_ImplGlfw_WindowFocusCallback);
  glfwSetCursorEnterCallback(parts_->window, ImGui_ImplGlfw_CursorEnterCallback);
  float scale_y = 1.0F;
  glfwGetWindowContentScale(parts_->window, &parts_->screen, &scale_y);
  parts_->letters = static_cast<float>(settings.letters);
  parts_->framed = {0, 0, settings.width, settings.height};
  parts_->scale = parts_->scale_now();
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;  // nothing of a person stays at the workstation
  set_style(parts_->scale);
  ImGui_ImplGlfw_InitForOpenGL(parts_->window, false);
  ImGui_ImplOpenGL3_Init("#version 430");
}

Window::~Window() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
  parts_->context.reset();
  glfwDestroyWindow(parts_->window);
  glfwTerminate();
}

gpu::Context& Window::context() noexcept {
  return *parts_->context;
}
bool Window::open() const noexcept {
  return glfwWindowShouldClose(parts_->window) == 0;
}
void Window::close() noexcept {
  glfwSetWindowShouldClose(parts_->window, GLFW_TRUE);
}
bool Window::hidden() const noexcept {
  return glfwGetWindowAttrib(parts_->window, GLFW_ICONIFIED) == GLFW_TRUE;
}
double Window::scale() const noexcept {
  return parts_->scale;
}
bool Window::whole_screen() const noexcept {
  return glfwGetWindowMonitor(parts_->window) != nullptr;
}

WindowSize Window::size() const noexcept {
  const auto& [left, top, width, height] = parts_->framed;
  WindowSize size{width, height, whole_screen()};
  if (!size.whole_screen) glfwGetWindowSize(parts_->window, &size.width, &size.height);
  return size;
}

void Window::set_whole_screen(bool whole) {
  auto& [left, top, width, height] = parts_->framed;
  if (whole == whole_screen()) return;
  if (!whole) {
    glfwSetWindowMonitor(parts_->window, nullptr, left, top, width, height, GLFW_DONT_CARE);
    glfwSetWindowSizeLimits(parts_->window, kLeastWidth, kLeastHeight, GLFW_DONT_CARE, GLFW_DONT_CARE);
    return;
  }
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
  if (mode == nullptr) return;
  glfwGetWindowPos(parts_->window, &left, &top);
  glfwGetWindowSize(parts_->window, &width, &height);
  glfwSetWindowMonitor(parts_->window, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

void Window::begin_frame(bool walks) {
  // Dear ImGui 1.86 sees what is down when a frame begins; a short press is down for the whole of its frame.
  bool* down = ImGui::GetIO().KeysDown;
  for (const int key : parts_->keys.pressed_)
    if (key >= 0 && glfwGetKey(parts_->window, key) == GLFW_RELEASE) down[key] = false;
  glfwPollEvents();
  for (const int key : parts_->pressed)
    if (key >= 0) down[key] = true;
  parts_->give_typed();
  parts_->read(parts_->keys);
  parts_->pressed.clear();
  parts_->shifted = false;
  parts_->walk(walks);
  parts_->fit_letters();
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
  go_on_from_focus(parts_->tab_back);
  parts_->keys.typing_ = parts_->between.typing_ =
      ImGui::GetIO().WantTextInput || parts_->typed.waits() || parts_->given;
}

void Window::end_frame() {
  ImGui::Render();
}

std::optional<int> Window::keys_heard() const noexcept {
  if (parts_->typed.waits() || parts_->given) return std::nullopt;
  return parts_->heard;
}

const Keys& Window::poll() {
  glfwPollEvents();
  parts_->read(parts_->between);
  return parts_->between;
}

bool Window::wait(double most_s) {
  const double until_s = glfwGetTime() + most_s;
  glfwWaitEventsTimeout(most_s);
  return glfwGetTime() < until_s;
}

bool Window::touched() const noexcept {
  const std::array<bool, 3> down = pointer().down;
  return !parts_->down.empty() || std::any_of(down.begin(), down.end(), [](bool is) { return is; });
}

Pointer Window::pointer() const {
  Pointer pointer;
  glfwGetCursorPos(parts_->window, &pointer.x_px, &pointer.y_px);
  constexpr std::array<int, 3> kButtons = {GLFW_MOUSE_BUTTON_LEFT, GLFW_MOUSE_BUTTON_RIGHT,
                                           GLFW_MOUSE_BUTTON_MIDDLE};
  for (std::size_t i = 0; i < kButtons.size(); ++i)
    pointer.down[i] = glfwGetMouseButton(parts_->window, kButtons[i]) == GLFW_PRESS;
  return pointer;
}

std::string Window::take_dropped() {
  return std::exchange(parts_->dropped, {});
}

double Window::take_wheel() {
  return std::exchange(ImGui::GetIO().MouseWheel, 0.0F);
}

void Window::show(std::vector<unsigned char>* pixels) {
  const ImVec4& ground = ImGui::GetStyle().Colors[ImGuiCol_WindowBg];  // screens have none of their own
  gpu::clear_window(*parts_->context, width_px(), height_px(), {ground.x, ground.y, ground.z});
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  if (pixels != nullptr) *pixels = gpu::window_pixels(*parts_->context, width_px(), height_px());
  glfwSwapBuffers(parts_->window);
}

std::optional<devices::GamepadReading> Window::gamepad() const {
  for (int place = GLFW_JOYSTICK_1; place <= GLFW_JOYSTICK_LAST; ++place) {
    GLFWgamepadstate now;
    if (glfwJoystickIsGamepad(place) != GLFW_TRUE || glfwGetGamepadState(place, &now) != GLFW_TRUE) continue;
    devices::GamepadReading reading;
    std::copy(std::begin(now.axes), std::end(now.axes), reading.axes.begin());
    std::transform(std::begin(now.buttons), std::end(now.buttons), reading.buttons.begin(),
                   [](unsigned char button) { return button == GLFW_PRESS; });
    return reading;
  }
  return std::nullopt;
}

void Window::set_title(const std::string& title) {
  glfwSetWindowTitle(parts_->window, title.c_str());
}

const Keys& Window::keys() const noexcept {
  return parts_->keys;
}

int Window::width_px() const noexcept {
  int width = 0, height = 0;
  glfwGetFramebufferSize(parts_->window, &width, &height);
  return width;
}

int Window::height_px() const noexcept {
  int width = 0, height = 0;
  glfwGetFramebufferSize(parts_->window, &width, &height);
  return height;
}

bool display_opens() {
  if (glfwInit() != GLFW_TRUE) return false;
  glfwTerminate();
  return true;
}

}  // namespace seldinger::app

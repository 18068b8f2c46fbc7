// A person at the window, played by Dear ImGui Test Engine: finds controls by name, clicks, types,
// presses keys, and waits for the effect.
#pragma once

#include <imgui.h>

#include <functional>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/ui/window/application.h"
#include "tests/app/ui/items.h"

struct ImGuiTestContext;

namespace hapticwall::test {

// The names of all items that were drawn, and of all items that the person used.
struct ItemLog {
  std::set<std::string> seen;
  std::set<std::string> used;
};

// Items that differ only by a number or a name ("toast 12") have one name in the log.
[[nodiscard]] std::string kind_of(const std::string& item);

class Person {
 public:
  using Drop = std::function<void(std::span<const std::string>)>;

  Person(ImGuiTestContext& engine, ui::Application& application, ItemLog& log, Drop drop)
      : engine_(&engine), application_(&application), log_(&log), drop_(std::move(drop)) {}

  // ---- state
  [[nodiscard]] ui::UiState& state() const { return application_->state(); }
  [[nodiscard]] session::SampleSource& session() const { return application_->session(); }
  [[nodiscard]] session::LiveSession& live() const { return *application_->live(); }
  [[nodiscard]] session::ReplaySession* replay() const { return application_->replay(); }
  [[nodiscard]] const Scene& scene() const { return application_->session().scene(); }
  [[nodiscard]] const draw::SampleHistory& history() const { return application_->history(); }
  [[nodiscard]] session::RecordingStatus recording() const;
  [[nodiscard]] ui::Message message() const { return state().toasts.newest(); }
  [[nodiscard]] static bool sees(const std::string& item);
  // True if a tooltip appears while the pointer rests on the item.
  [[nodiscard]] bool has_tooltip(const std::string& item);
  [[nodiscard]] static std::vector<std::string> items_called(std::string_view beginning);
  [[nodiscard]] std::string clipboard() const;
  // True after the test engine has failed to use a control.
  [[nodiscard]] bool is_stuck() const;
  [[nodiscard]] const ItemLog& log() const { return *log_; }

  // ---- actions
  // Returns after the frame that draws the result.
  void click(const std::string& item, ImGuiMouseButton button = ImGuiMouseButton_Left);
  void double_click(const std::string& item, ImGuiMouseButton button = ImGuiMouseButton_Left);
  void hover(const std::string& item);
  void drag(const std::string& item, ImVec2 way, ImGuiMouseButton button = ImGuiMouseButton_Left);
  // Starts at a share of the item's width and height.
  void drag_from(const std::string& item, ImVec2 share, ImVec2 way,
                 ImGuiMouseButton button = ImGuiMouseButton_Left);
  // Scrolls each area from its top to its end until the condition holds. False: it never does.
  bool scroll_until(const std::function<bool()>& condition);
  void turn_wheel(const std::string& item, float notches);
  // Replaces the text of a field, and confirms.
  void type(const std::string& item, const std::string& text);
  // On a slider, Ctrl+click moves the keyboard to the field beside it.
  void ctrl_click(const std::string& item);
  // Opens the list `item`, and chooses its entry `word`.
  void choose(const std::string& item, const std::string& word);
  void press(ImGuiKeyChord chord);
  void write(const std::string& text);
  void drop(std::span<const std::string> paths) { drop_(paths); }
  // Closes lists, the help and messages.
  void put_everything_away();

  // ---- waiting
  void wait_a_frame();
  // Waits for a condition. After a minute it fails the test and returns false.
  bool wait_until(const std::function<bool()>& condition, std::string_view what);
  // Waits until the session has made this many more ticks.
  bool wait_for_ticks(std::uint64_t ticks);

 private:
  [[nodiscard]] std::optional<ItemRect> take(const std::string& item);
  void point_at(const ItemRect& rect);

  ImGuiTestContext* engine_;
  ui::Application* application_;
  ItemLog* log_;
  Drop drop_;
};

}  // namespace hapticwall::test

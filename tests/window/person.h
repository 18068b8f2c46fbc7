// Somebody at the window: clicks what is there by the name under which it was drawn, types, presses
// keys and waits for what comes of it. Dear ImGui Test Engine is the hand.
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

// The names of everything that was drawn, and of everything that was used.
struct ItemLog {
  std::set<std::string> seen;
  std::set<std::string> used;
};

// One of a counted kind ("toast 12"), or of a kind with names, stands for all of them.
[[nodiscard]] std::string kind_of(const std::string& item);

class Person {
 public:
  using Drop = std::function<void(std::span<const std::string>)>;

  Person(ImGuiTestContext& engine, ui::Application& application, ItemLog& log, Drop drop)
      : engine_(&engine), application_(&application), log_(&log), drop_(std::move(drop)) {}

  // ---- what is there
  [[nodiscard]] ui::UiState& state() const { return application_->state(); }
  [[nodiscard]] runtime::SampleSource& session() const { return application_->session(); }
  [[nodiscard]] runtime::LiveSession& live() const { return *application_->live(); }
  [[nodiscard]] runtime::ReplaySession* replay() const { return application_->replay(); }
  [[nodiscard]] const Scene& scene() const { return application_->session().scene(); }
  [[nodiscard]] const draw::SampleHistory& history() const { return application_->history(); }
  [[nodiscard]] runtime::RecordingStatus recording() const;
  [[nodiscard]] ui::Message message() const { return state().transient.toasts.newest(); }
  [[nodiscard]] static bool sees(const std::string& item);
  [[nodiscard]] static std::vector<std::string> items_called(std::string_view beginning);
  [[nodiscard]] std::string clipboard() const;
  // Something could not be used: nothing more is done.
  [[nodiscard]] bool is_stuck() const;
  [[nodiscard]] const ItemLog& log() const { return *log_; }

  // ---- what one does
  void click(const std::string& item, ImGuiMouseButton button = ImGuiMouseButton_Left);
  void double_click(const std::string& item, ImGuiMouseButton button = ImGuiMouseButton_Left);
  void hover(const std::string& item);
  void drag(const std::string& item, ImVec2 way, ImGuiMouseButton button = ImGuiMouseButton_Left);
  // The same beginning at a share of the item's width and height.
  void drag_from(const std::string& item, ImVec2 share, ImVec2 way,
                 ImGuiMouseButton button = ImGuiMouseButton_Left);
  void turn_wheel(const std::string& item, float notches);
  // Puts this text in place of what is in a field, and confirms.
  void type(const std::string& item, const std::string& text);
  // Ctrl+click: then the field beside a slider has the keyboard.
  void ctrl_click(const std::string& item);
  // The entry `word` of the list that `item` opens.
  void choose(const std::string& item, const std::string& word);
  void press(ImGuiKeyChord chord);
  void write(const std::string& text);
  void drop(std::span<const std::string> paths) { drop_(paths); }
  // Lists, the help and messages.
  void put_everything_away();

  // ---- what one waits for
  void wait_a_frame();
  // A condition that comes soon; false, and a failure, where it does not for a very long time.
  bool wait_until(const std::function<bool()>& condition, std::string_view what);
  // Ticks of the session, as the window has taken them.
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

#include "tests/window/person.h"

#include <gtest/gtest.h>
#include <imgui_internal.h>
#include <imgui_te_context.h>

#include <algorithm>
#include <cfloat>
#include <chrono>
#include <thread>
#include <utility>

namespace hapticwall::test {
namespace {

// Much longer than any wait here takes.
constexpr std::chrono::seconds kPatience{60};
// Between two frames of a wait: frames without a pause would take a core from the tests beside
// this.
constexpr std::chrono::milliseconds kPause{2};

}  // namespace

std::string kind_of(const std::string& item) {
  for (const char* kind :
       {"ghost of", "spectrum of ", "under ", "map choice ", "map under ", "study column ",
        "layout of ", "window ", "take device ", "take hand "}) {
    if (item.starts_with(kind)) return kind;
  }
  for (const char* kind : {"toast ", "recent ", "slow motion "}) {
    if (item.starts_with(kind)) return kind + std::string("N");
  }
  return item;
}

session::RecordingStatus Person::recording() const { return live().recording_status(); }

bool Person::sees(const std::string& item) { return find_item(item).has_value(); }

std::vector<std::string> Person::items_called(std::string_view beginning) {
  std::vector<std::string> names;
  for (const auto& [name, rect] : drawn_items()) {
    if (name.starts_with(beginning)) names.push_back(name);
  }
  return names;
}

std::string Person::clipboard() const { return ImGui::GetClipboardText(); }

bool Person::is_stuck() const { return engine_->IsError(); }

// Text that is scrolled out of sight is not drawn, and must be looked for.
std::optional<ItemRect> Person::take(const std::string& item) {
  log_->used.insert(kind_of(item));
  scroll_until([&] { return sees(item); });
  auto found = find_item(item);
  if (!found) ADD_FAILURE() << "'" << item << "' is not there";
  return found;
}

bool Person::scroll_until(const std::function<bool()>& condition) {
  if (condition()) return true;
  const ImVector<ImGuiWindow*> windows = ImGui::GetCurrentContext()->Windows;
  for (ImGuiWindow* window : windows) {
    if (!window->WasActive || window->ScrollMax.y <= 0.0F) continue;
    const float before = window->Scroll.y;
    const float step = 0.5F * window->InnerRect.GetHeight();
    for (float y = 0.0F; y < window->ScrollMax.y + step; y += step) {
      ImGui::SetScrollY(window, std::min(y, window->ScrollMax.y));
      engine_->Yield(2);
      if (condition()) return true;
    }
    ImGui::SetScrollY(window, before);
    engine_->Yield(2);
  }
  return false;
}

bool Person::has_tooltip(const std::string& item) {
  hover(item);
  ImGuiStyle& style = ImGui::GetStyle();
  const float stationary_s = std::exchange(style.HoverStationaryDelay, 0.0F);
  const float short_s = std::exchange(style.HoverDelayShort, 0.0F);
  engine_->Yield(4);
  style.HoverStationaryDelay = stationary_s;
  style.HoverDelayShort = short_s;
  const ImGuiWindow* tooltip = ImGui::FindWindowByName("##Tooltip_00");
  return tooltip != nullptr && (tooltip->Active || tooltip->WasActive);
}

// Scrolls an item with an id into view; the test engine fails if something covers it.
void Person::point_at(const ItemRect& rect) {
  if (rect.id != 0) {
    engine_->MouseMove(rect.id);
  } else {
    engine_->MouseMoveToPos(rect.centre());
  }
}

void Person::click(const std::string& item, ImGuiMouseButton button) {
  const auto rect = take(item);
  if (!rect) return;
  point_at(*rect);
  engine_->MouseClick(button);
  engine_->Yield();
}

void Person::double_click(const std::string& item, ImGuiMouseButton button) {
  const auto rect = take(item);
  if (!rect) return;
  point_at(*rect);
  // A slow frame must not split the two clicks.
  ImGuiIO& io = ImGui::GetIO();
  const float usual = std::exchange(io.MouseDoubleClickTime, FLT_MAX);
  engine_->MouseDoubleClick(button);
  io.MouseDoubleClickTime = usual;
}

void Person::hover(const std::string& item) {
  if (const auto rect = take(item)) point_at(*rect);
}

void Person::drag(const std::string& item, ImVec2 way, ImGuiMouseButton button) {
  const auto rect = take(item);
  if (!rect) return;
  point_at(*rect);
  engine_->MouseDragWithDelta(way, button);
}

void Person::drag_from(const std::string& item, ImVec2 share, ImVec2 way, ImGuiMouseButton button) {
  const auto rect = take(item);
  if (!rect) return;
  engine_->MouseMoveToPos(rect->at(share.x, share.y));
  engine_->MouseDragWithDelta(way, button);
}

void Person::turn_wheel(const std::string& item, float notches) {
  const auto rect = take(item);
  if (!rect) return;
  point_at(*rect);
  engine_->MouseWheelY(notches);
  engine_->Yield(2);
}

void Person::type(const std::string& item, const std::string& text) {
  click(item);
  write(text);
  press(ImGuiKey_Enter);
}

void Person::ctrl_click(const std::string& item) {
  const auto rect = take(item);
  if (!rect) return;
  point_at(*rect);
  engine_->KeyDown(ImGuiMod_Ctrl);
  engine_->MouseClick();
  engine_->KeyUp(ImGuiMod_Ctrl);
  engine_->Yield(3);
}

void Person::choose(const std::string& item, const std::string& word) {
  click(item);
  log_->used.insert(kind_of(word));
  engine_->ItemClick(("//$FOCUSED/" + word).c_str());
}

void Person::press(ImGuiKeyChord chord) { engine_->KeyPress(chord); }

// A click into a field selects its whole text, and writing replaces it.
void Person::write(const std::string& text) {
  if (text.empty()) {
    engine_->KeyPress(ImGuiKey_Delete);
  } else {
    engine_->KeyChars(text.c_str());
    engine_->Yield(2);
  }
}

void Person::put_everything_away() {
  constexpr int kMax = 100;
  const auto something = [this] {
    return ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup) || state().window.help_shown ||
           !state().toasts.list().empty();
  };
  for (int i = 0; i < kMax && something() && !is_stuck(); ++i) press(ImGuiKey_Escape);
  EXPECT_FALSE(something()) << "Escape does not put everything away";
}

void Person::wait_a_frame() { engine_->Yield(); }

bool Person::wait_until(const std::function<bool()>& condition, std::string_view what) {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!condition()) {
    if (is_stuck() || std::chrono::steady_clock::now() > end) {
      ADD_FAILURE() << "waited too long for: " << what;
      return false;
    }
    wait_a_frame();
    std::this_thread::sleep_for(kPause);
  }
  return true;
}

bool Person::wait_for_ticks(std::uint64_t ticks) {
  const std::uint64_t wanted = session().snapshot().timing.ticks + ticks;
  return wait_until([&] { return session().snapshot().timing.ticks >= wanted; }, "ticks");
}

}  // namespace hapticwall::test

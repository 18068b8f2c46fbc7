#include "tests/window/person.h"

#include <gtest/gtest.h>
#include <imgui_te_context.h>

#include <cfloat>
#include <chrono>
#include <utility>

namespace hapticwall::test {
namespace {

// Long enough for the slowest machine; nothing here takes a hundredth of it.
constexpr std::chrono::seconds kPatience{60};

}  // namespace

std::string kind_of(const std::string& item) {
  for (const char* kind : {"ghost of", "under "}) {
    if (item.starts_with(kind)) return kind;
  }
  for (const char* kind : {"toast ", "recent "}) {
    if (item.starts_with(kind)) return kind + std::string("N");
  }
  return item;
}

runtime::RecordingStatus Person::recording() const { return live().recording_status(); }

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

std::optional<ItemRect> Person::take(const std::string& item) {
  log_->used.insert(kind_of(item));
  auto found = find_item(item);
  if (!found) ADD_FAILURE() << "'" << item << "' is not there";
  return found;
}

// What has an identity is scrolled into view, and must be what the pointer then really meets.
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
}

void Person::double_click(const std::string& item, ImGuiMouseButton button) {
  const auto rect = take(item);
  if (!rect) return;
  point_at(*rect);
  // However long a frame takes.
  ImGuiIO& io = ImGui::GetIO();
  const float usual = std::exchange(io.MouseDoubleClickTime, FLT_MAX);
  engine_->MouseDoubleClick(button);
  io.MouseDoubleClickTime = usual;
}

void Person::hover(const std::string& item) {
  const auto rect = take(item);
  if (!rect) return;
  ImVec2 place = rect->centre();
  const ImVec2 screen = ImGui::GetMainViewport()->WorkSize;
  if (place.y >= screen.y) {  // below the end of a panel that scrolls
    ImGuiWindow* panel = engine_->FindHoveredWindowAtPos(ImVec2(place.x, 0.5F * screen.y));
    engine_->ScrollToPosY(panel->ID, place.y);
    if (const auto now = find_item(item)) place = now->centre();
    EXPECT_LT(place.y, screen.y) << "'" << item << "' cannot be brought to light";
  }
  engine_->MouseMoveToPos(place);
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
  engine_->MouseMoveToPos(ImVec2(rect->from.x + share.x * (rect->to.x - rect->from.x),
                                 rect->from.y + share.y * (rect->to.y - rect->from.y)));
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

// A field selects all of its text when it is clicked: what is written takes its place.
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
    return ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup) || state().transient.help_shown ||
           !state().transient.toasts.list().empty();
  };
  for (int i = 0; i < kMax && something() && !is_stuck(); ++i) press(ImGuiKey_Escape);
  EXPECT_FALSE(something()) << "Escape does not put everything away";
}

void Person::wait_a_frame() { engine_->Yield(); }

bool Person::wait_until(const std::function<bool()>& condition, std::string_view what) {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!condition()) {
    if (is_stuck() || std::chrono::steady_clock::now() > end) {
      ADD_FAILURE() << "waited in vain: " << what;
      return false;
    }
    wait_a_frame();
  }
  return true;
}

bool Person::wait_for_ticks(std::uint64_t ticks) {
  const std::uint64_t wanted = session().snapshot().timing.ticks + ticks;
  return wait_until([&] { return session().snapshot().timing.ticks >= wanted; }, "ticks");
}

}  // namespace hapticwall::test

#include "app/ui/state/messages.h"

#include <algorithm>
#include <utility>

namespace hapticwall::ui {

void Toasts::tell(MessageKind kind, std::string text) {
  Toast toast{next_id_, {kind, std::move(text)}};
  const auto same = std::find_if(list_.begin(), list_.end(), [&](const Toast& other) {
    return other.message.kind == kind && other.message.text == toast.message.text;
  });
  if (same != list_.end()) {
    toast.id = same->id;
    toast.times = same->times + 1;
    list_.erase(same);
  } else {
    ++next_id_;
  }
  list_.push_back(std::move(toast));
  if (list_.size() > kMaxToasts) list_.erase(list_.begin());
}

void Toasts::put_away(std::uint64_t id) {
  std::erase_if(list_, [id](const Toast& toast) { return toast.id == id; });
}

void Toasts::put_newest_away() {
  if (!list_.empty()) list_.pop_back();
}

void Toasts::pass(double seconds, std::uint64_t looked_at) {
  for (Toast& toast : list_) toast.age_s = toast.id == looked_at ? 0.0 : toast.age_s + seconds;
  std::erase_if(list_, [](const Toast& toast) {
    return toast.message.kind == MessageKind::kNote && toast.age_s >= kNoteLifeS;
  });
}

Message Toasts::newest() const { return list_.empty() ? Message{} : list_.back().message; }

bool Toasts::moving() const {
  return std::any_of(list_.begin(), list_.end(), [](const Toast& toast) {
    return toast.message.kind == MessageKind::kNote && toast.age_s >= kNoteLifeS - kFadeS;
  });
}

float opacity(const Toast& toast) {
  if (toast.message.kind == MessageKind::kProblem) return 1.0F;
  return static_cast<float>(std::clamp((kNoteLifeS - toast.age_s) / kFadeS, 0.0, 1.0));
}

}  // namespace hapticwall::ui

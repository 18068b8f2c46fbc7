#include "app/ui/window/paint_gate.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string_view>

namespace hapticwall::ui {
namespace {

void mix(std::uint64_t& hash, std::uint64_t value) {
  hash = (hash ^ value) * 0x9e3779b97f4a7c15U;
  hash ^= hash >> 32U;
}

template <typename T>
void mix_all(std::uint64_t& hash, const ImVector<T>& items) {
  const std::string_view bytes(reinterpret_cast<const char*>(items.Data),
                               static_cast<std::size_t>(items.size_in_bytes()));
  mix(hash, std::hash<std::string_view>{}(bytes));
}

std::uint64_t hash_of(const ImDrawData& frame) {
  std::uint64_t hash = 0;
  mix(hash, static_cast<std::uint64_t>(frame.DisplaySize.x));
  mix(hash, static_cast<std::uint64_t>(frame.DisplaySize.y));
  for (const ImDrawList* list : frame.CmdLists) {
    mix_all(hash, list->VtxBuffer);
    mix_all(hash, list->IdxBuffer);
    for (const ImDrawCmd& command : list->CmdBuffer) {
      mix(hash, static_cast<std::uint64_t>(command.GetTexID()));
      mix(hash, command.ElemCount);
      for (const float edge :
           {command.ClipRect.x, command.ClipRect.y, command.ClipRect.z, command.ClipRect.w})
        mix(hash, static_cast<std::uint64_t>(static_cast<std::int64_t>(edge)));
    }
  }
  return hash;
}

// Glyphs that are not on the graphics card yet.
bool textures_wait(const ImDrawData& frame) {
  return frame.Textures != nullptr &&
         std::any_of(frame.Textures->begin(), frame.Textures->end(),
                     [](const ImTextureData* data) { return data->Status != ImTextureStatus_OK; });
}

}  // namespace

bool PaintGate::needs_painting(const ImDrawData& frame, std::uint64_t pictures) {
  const bool waits = textures_wait(frame);
  std::uint64_t hash = waits ? 0 : hash_of(frame);
  mix(hash, pictures);
  const bool same = known_ && !waits && hash == painted_;
  painted_ = hash;
  known_ = !waits;
  return !same;
}

}  // namespace hapticwall::ui

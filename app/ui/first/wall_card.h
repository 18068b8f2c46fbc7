// A card of the first window: an algorithm, its verdict, its wall and its contact.
#pragma once

#include "app/draw/plot/plot_labels.h"
#include "app/ui/first/first_window.h"
#include "app/ui/state/compare_state.h"

namespace hapticwall::ui {

// A wall of the first window with what is known of it.
struct CardWall {
  compare::Slot slot = compare::Slot::kA;
  bool leads = false;  // it is the session
  const AlgorithmSettings& algorithm;
  const Scene& scene;
  draw::Tail tail;
  const EnergyStory* story = nullptr;  // null: not known yet
  const draw::SampleHistory& history;
  draw::WallPicture picture;
  Sample newest;
};

// "no algorithm", "energy bounding".
[[nodiscard]] std::string spoken_name(const AlgorithmSettings& algorithm);

// Both cards have one magnification, `span_m` for a strip of `strip_width()`.
void draw_wall_card(const FirstParts& parts, WallRenderer& renderer, const CardWall& wall,
                    const draw::PixelBox& box, double span_m);
// Width of the contact in a card of this width, pixels.
[[nodiscard]] float strip_width(float card_width);

}  // namespace hapticwall::ui

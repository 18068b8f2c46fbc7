// The pointer leads the hand while its button is down in the wall view.
#pragma once

#include "app/ui/state/panel_context.h"
#include "app/ui/wall/wall_camera.h"

namespace hapticwall::ui {

// Call it once a frame, right after the item that takes the pointer. `held`: its button is down.
void lead_hand(const PanelContext& context, const WallCamera& camera, bool held);

// Takes the hand back to where the scene begins, at the speed of the settings.
void withdraw_hand(const PanelContext& context);

}  // namespace hapticwall::ui

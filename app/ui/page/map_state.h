// State of the map page.
#pragma once

#include "app/ui/computed/live_map.h"
#include "app/ui/computed/map_choice.h"

namespace hapticwall::ui {

// Lives as long as the window.
struct MapState {
  MapChoice choice;
  LiveMap live;
};

}  // namespace hapticwall::ui

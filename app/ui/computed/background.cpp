#include "app/ui/computed/background.h"

namespace hapticwall::ui {

std::launch background_launch() { return std::launch::async; }

}  // namespace hapticwall::ui

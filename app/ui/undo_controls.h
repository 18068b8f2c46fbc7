// Undo and redo as the buttons and the keys do it.
#pragma once

#include "app/ui/ui_state.h"

namespace hapticwall::ui {

// Asks the session for the scene of the step before, or of the next; where it takes another
// session, for that one. Harmless where there is no such step.
void undo_change(const PanelContext& context);
void redo_change(const PanelContext& context);

// After all panels of a frame, with the scene that now runs.
void notice_changes(UiState& state, const Scene& scene);

}  // namespace hapticwall::ui

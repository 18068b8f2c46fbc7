// The plug-ins in the list of algorithms. `core` knows no file: app/file/plugin loads them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "core/algorithm/plugin/library_call.h"

struct hw_plugin;  // hapticwall/plugin.h

namespace hapticwall {

// Why the program cannot take this plug-in, or "". Reads `abi` and `size` before anything else.
// Realtime-safe: no.
[[nodiscard]] std::string plugin_problem(const hw_plugin& plugin);

// Puts a plug-in at the end of algorithms() and gives its index. Everything that it points to must
// live as long as the program. Call it before other threads and sessions start. Precondition:
// plugin_problem() is "". Realtime-safe: no.
std::size_t add_plugin(const hw_plugin& plugin);

// Why a rebuilt plug-in cannot take the place of this one in a running program, or "": its name,
// parameters and signals must be the same, because menus, scenes and recordings have them.
// Realtime-safe: no.
[[nodiscard]] std::string replacement_problem(const hw_plugin& newer, std::size_t algorithm);
inline constexpr std::size_t kMaxPluginRevisions = 1000;
// The newest revision is this one from now on; older ones stay. Title, idea and equation stay those
// of the first one. One thread calls it; others may use the list meanwhile. Preconditions:
// replacement_problem() is "", and there are less than kMaxPluginRevisions.
void replace_plugin(std::size_t algorithm, const hw_plugin& newer);

// algorithms() from this index on are plug-ins. Realtime-safe: yes, all from here.
[[nodiscard]] std::size_t first_plugin();
// nullptr if the algorithm is no plug-in. `revision` as in AlgorithmSettings.
[[nodiscard]] const hw_plugin* plugin_at(std::size_t algorithm, std::uint32_t revision = 0);
// The newest one; 0 if the algorithm is no plug-in.
[[nodiscard]] std::uint32_t plugin_revision(std::size_t algorithm);
// Bytes for the state of any plug-in, with room for a rebuilt one; 0 without plug-ins.
[[nodiscard]] std::size_t plugin_state_capacity();

// Notes a fault of a function of the plug-in, and gives the newest one.
void note_plugin_fault(const hw_plugin& plugin, LibraryFault fault);
[[nodiscard]] LibraryFault plugin_fault(std::size_t algorithm);

}  // namespace hapticwall

// The plug-ins in the list of algorithms. `core` knows no file: app/file/plugin loads them.
#pragma once

#include <cstddef>
#include <string>

struct hw_plugin;  // hapticwall/plugin.h

namespace hapticwall {

// Why the program cannot take this plug-in, or "". Reads `abi` and `size` before anything else.
// Realtime-safe: no.
[[nodiscard]] std::string plugin_problem(const hw_plugin& plugin);

// Puts a plug-in at the end of algorithms() and gives its index. Everything that it points to must
// live as long as the program. Call it before other threads and sessions start. Precondition:
// plugin_problem() is "". Realtime-safe: no.
std::size_t add_plugin(const hw_plugin& plugin);

// algorithms() from this index on are plug-ins. Realtime-safe: yes, all from here.
[[nodiscard]] std::size_t first_plugin();
// nullptr if the algorithm is no plug-in.
[[nodiscard]] const hw_plugin* plugin_at(std::size_t algorithm);
// Bytes; 0 without plug-ins.
[[nodiscard]] std::size_t largest_plugin_state();

// Notes that a function of the plug-in threw an exception, and whether any did.
void note_plugin_exception(const hw_plugin& plugin);
[[nodiscard]] bool plugin_has_thrown(std::size_t algorithm);

}  // namespace hapticwall

// exit() and quick_exit() in a library end the process in the middle of a session, with the
// library's own status. Here they end the force first, and the program says so.
//
// _exit() and a system call that ends the process cannot be caught: the device drops the force
// after its time to live.
#pragma once

namespace hapticwall::session {

// Makes exit() and quick_exit() first end every loop with zero force. Call it again after libraries
// were loaded: the newest handler runs first, before theirs. Realtime-safe: no.
void watch_exit();

// While one exists, the program ends by the return of its main function only. An earlier exit() is
// an error in one line on standard error, with the exit status of a device plug-in's or of another
// library's fault, whatever the library asked for. Realtime-safe: no.
class EarlyExitIsAnError {
 public:
  EarlyExitIsAnError();
  EarlyExitIsAnError(const EarlyExitIsAnError&) = delete;
  EarlyExitIsAnError& operator=(const EarlyExitIsAnError&) = delete;
  ~EarlyExitIsAnError();
};

}  // namespace hapticwall::session

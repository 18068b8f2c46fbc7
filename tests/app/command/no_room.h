// A disk without one free block, for the real program.
#pragma once

namespace hapticwall::command::test {

// Prefix of a shell line: the program may write no file.
inline constexpr const char* kNoRoom = "ulimit -f 0; exec $P ";

// False under ThreadSanitizer, which writes a file itself before the program begins.
inline constexpr bool kStartsWithoutRoom =
#if defined(__SANITIZE_THREAD__)
    false;
#else
    true;
#endif

}  // namespace hapticwall::command::test

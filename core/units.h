// Conversion factors for display and I/O. The program computes in SI units.
#pragma once

namespace hapticwall {

inline constexpr double kPercent = 100.0;  // per cent in 1
inline constexpr double kNewtonsPerKilonewton = 1e3;
inline constexpr double kMillimetresPerMetre = 1e3;
inline constexpr double kMillijoulesPerJoule = 1e3;
inline constexpr double kMilliwattsPerWatt = 1e3;
inline constexpr double kMillisecondsPerSecond = 1e3;
inline constexpr double kMicrosecondsPerSecond = 1e6;
inline constexpr double kNanosecondsPerSecond = 1e9;
inline constexpr double kNanosecondsPerMicrosecond = 1e3;

}  // namespace hapticwall

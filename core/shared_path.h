// The intended path of a hand, as a scene holds it. Copies share the points: a map copies its scene
// for every cell.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace hapticwall {

struct PathPoint {
  double time_s = 0.0;
  double position_m = 0.0;

  friend bool operator==(const PathPoint&, const PathPoint&) = default;
};

// A stretch of a recorded hand at constant speed, up to the next one. Times are in ticks.
struct PathPiece {
  double from_tick = 0.0;
  double begin_tick = 0.0;  // the position is of this instant, which may be earlier
  double position_m = 0.0;
  double velocity_m_per_s = 0.0;
};

// The hand of a recording as it moved, whoever led it.
struct RecordedPieces {
  double rate_hz = 1000.0;        // of the ticks
  std::vector<PathPiece> pieces;  // at least one; the first is from tick 0
};

// The points; straight between them, constant before the first and after the last.
class SharedPath {
 public:
  SharedPath() = default;
  SharedPath(std::vector<PathPoint> points)  // NOLINT(google-explicit-constructor)
      : points_(std::make_shared<std::vector<PathPoint>>(std::move(points))) {}
  SharedPath(std::initializer_list<PathPoint> points) : SharedPath(std::vector(points)) {}

  [[nodiscard]] const std::vector<PathPoint>& points() const {
    static const std::vector<PathPoint> kNone;
    return points_ ? *points_ : kNone;
  }
  [[nodiscard]] bool empty() const { return points().empty() && !recorded; }
  [[nodiscard]] std::size_t size() const { return points().size(); }
  [[nodiscard]] const PathPoint& operator[](std::size_t index) const { return points()[index]; }
  [[nodiscard]] const PathPoint& front() const { return points().front(); }
  [[nodiscard]] const PathPoint& back() const { return points().back(); }
  [[nodiscard]] auto begin() const { return points().begin(); }
  [[nodiscard]] auto end() const { return points().end(); }

  // Points of its own and of no file, to change before the next copy. Copies all of them.
  [[nodiscard]] std::vector<PathPoint>& edit() {
    *this = SharedPath(points());
    return *points_;
  }

  // Absolute name and SHA-256 of the file that has the points (`path_file`), if there is one.
  std::string file{};
  std::string sha256{};

  // Motion of a recording in the place of points: the path then has none.
  std::shared_ptr<const RecordedPieces> recorded{};

  // True for the same motion; a file may move.
  friend bool operator==(const SharedPath& a, const SharedPath& b) {
    return a.recorded == b.recorded && (a.points_ == b.points_ || a.points() == b.points());
  }

 private:
  std::shared_ptr<std::vector<PathPoint>> points_;
};

}  // namespace hapticwall

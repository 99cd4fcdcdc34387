// Chooses the size of frames while a hand moves the camera: a part of the picture's, so that
// pictures follow the hand.
#pragma once

#include <chrono>
#include <cstdint>

namespace restlab {

class MovingSize {
 public:
  using Clock = std::chrono::steady_clock;

  // A camera that was not moved for so long rests.
  static constexpr double kRestS = 0.2;
  // Time of a round of frames that a motion begins with, and the longest one before frames become
  // smaller.
  static constexpr double kWantedRoundS = 0.04, kLongestRoundS = 0.08;
  // Width and height are divided by 1, 2, 4 or 8.
  static constexpr uint32_t kMostDivisor = 8;

  // Off: frames have the whole size while the camera moves, too.
  void setAdaptive(bool isOn) { isAdaptive_ = isOn; }
  bool isAdaptive() const { return isAdaptive_; }

  // The camera was moved.
  void move(Clock::time_point now);
  bool isMoving(Clock::time_point now) const;
  // Divisor of the next round of frames; 1: the whole size.
  uint32_t divisor(Clock::time_point now) const {
    return isAdaptive_ && isMoving(now) ? divisor_ : 1;
  }
  // A round of frames with that divisor took so long.
  void rendered(uint32_t divisor, double seconds);
  // Expected duration of a round, by the last one of its kind; 0: unknown.
  double roundS(uint32_t divisor) const {
    if (divisor == 1) return wholeS_;
    return movingS_ > 0.0 ? movingS_ : wholeS_ / double(divisor * divisor);
  }

 private:
  bool isAdaptive_ = true, hasMoved_ = false;
  Clock::time_point moved_;
  uint32_t divisor_ = 1;
  double wholeS_ = 0.0, movingS_ = 0.0;
};

}  // namespace restlab

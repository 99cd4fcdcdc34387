#include "experiments/view/moving_size.h"

namespace restlab {

void MovingSize::move(Clock::time_point now) {
  if (!isMoving(now)) {
    divisor_ = 1;
    movingS_ = 0.0;
    // Time is proportional to pixels. Without a measurement assume a slow method.
    const double seconds = wholeS_ > 0.0 ? wholeS_ : 16.0 * kWantedRoundS;
    while (divisor_ < kMostDivisor && seconds / double(divisor_ * divisor_) > kWantedRoundS)
      divisor_ *= 2;
  }
  hasMoved_ = true;
  moved_ = now;
}

bool MovingSize::isMoving(Clock::time_point now) const {
  return hasMoved_ && std::chrono::duration<double>(now - moved_).count() < kRestS;
}

void MovingSize::rendered(uint32_t divisor, double seconds) {
  (divisor == 1 ? wholeS_ : movingS_) = seconds;
  if (divisor == divisor_ && divisor > 1 && seconds > kLongestRoundS && divisor < kMostDivisor)
    divisor_ *= 2;
}

}  // namespace restlab

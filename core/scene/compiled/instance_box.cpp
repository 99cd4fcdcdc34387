#include "core/scene/compiled/instance_box.h"

#include <algorithm>
#include <limits>

#include "core/dialect/math.h"

namespace restlab {

std::array<glm::vec3, 2> boxOfInstance(const rl::Instance& inst,
                                       const std::array<glm::vec3, 2>& local) {
  glm::vec3 low(std::numeric_limits<float>::infinity()), high(-low);
  const glm::vec4 rows[3] = {inst.objectToWorldRow0, inst.objectToWorldRow1,
                             inst.objectToWorldRow2};
  for (size_t corner = 0; corner < 8; ++corner) {
    const glm::vec4 p(local[corner & 1].x, local[corner >> 1 & 1].y, local[corner >> 2].z, 1.0f);
    glm::vec3 at, magnitude;
    for (int c = 0; c < 3; ++c) {
      at[c] = glm::dot(rows[c], p);
      magnitude[c] = glm::dot(glm::abs(rows[c]), glm::abs(p));
    }
    const float error = rl::RL_HIT_ERROR * std::max({magnitude.x, magnitude.y, magnitude.z});
    low = glm::min(low, at - error);
    high = glm::max(high, at + error);
  }
  return {low, high};
}

}  // namespace restlab

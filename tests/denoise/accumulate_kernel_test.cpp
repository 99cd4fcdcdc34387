// Kernel of `accumulate` on synthetic images.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/backend/cpu_kernel.h"
#include "core/dialect/order.h"
#include "denoise/accumulate/accumulate.h"

namespace restlab {
namespace {

constexpr uint32_t kSide = 3;

// Runs the kernel over the frames of one history, in a still view.
class Kernel {
 public:
  // radianceFrames: as in FrameData.
  explicit Kernel(float radianceFrames = 1.0f, float cap = 20.0f) {
    frame_.width = frame_.height = kSide;
    frame_.stillFrames = 1;
    frame_.radianceFrames = radianceFrames;
    params_.cap = cap;
  }

  // Returns the shown image of a frame; health is summed over all frames.
  const std::vector<glm::vec3>& show(const std::vector<glm::vec3>& radiance) {
    radiance_ = radiance;
    void* buffers[] = {radiance_.data(), nullptr,     nullptr,       nullptr,
                       shown_.data(),    now_.data(), before_.data()};
    rl::CpuKernelArgs args;
    args.scene = &scene_;
    args.frame = &frame_;
    args.buffers = buffers;
    args.params = &params_;
    rl::findCpuKernel("accumulate", 0)->entry(args, {0, 0, kSide, kSide}, counters);
    std::swap(now_, before_);
    ++frame_.frame;
    return shown_;
  }

  rl::CpuKernelCounters counters;

 private:
  rl::SceneData scene_{};
  rl::FrameData frame_{};
  rl::AccumulateParams params_{};
  std::vector<glm::vec3> radiance_, shown_{kSide * kSide};
  std::vector<glm::uvec4> now_{kSide * kSide}, before_{kSide * kSide};
};

TEST(AccumulateKernel, NothingThatIsNotFiniteSpreadsOrStays) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  Kernel kernel;
  std::vector<glm::vec3> frame(kSide * kSide, glm::vec3(2.0f));
  kernel.show(frame);
  frame[4] = {1.0f, nan, 1.0f};
  frame[7] = {infinity, 0.0f, 0.0f};
  for (const glm::vec3& pixel : kernel.show(frame)) EXPECT_EQ(pixel, glm::vec3(2.0f));
  EXPECT_EQ(kernel.counters.health[rl::RL_HEALTH_NONFINITE], 2u);
  // The earlier average is kept and counts as one frame.
  frame.assign(kSide * kSide, glm::vec3(4.0f));
  const std::vector<glm::vec3>& shown = kernel.show(frame);
  for (size_t p = 0; p < shown.size(); ++p) {
    const float expected = p == 4 || p == 7 ? 3.0f : 2.0f + 2.0f / 3.0f;
    EXPECT_NEAR(shown[p].y, expected, 1e-6f) << "pixel " << p;
  }
  EXPECT_EQ(kernel.counters.health[rl::RL_HEALTH_NONFINITE], 2u);
}

TEST(AccumulateKernel, BlackIsShownUntilSomethingFiniteComes) {
  Kernel kernel;
  const std::vector<glm::vec3> broken(kSide * kSide, glm::vec3(std::nanf("")));
  for (const glm::vec3& pixel : kernel.show(broken)) EXPECT_EQ(pixel, glm::vec3(0.0f));
  const std::vector<glm::vec3> fine(kSide * kSide, glm::vec3(5.0f));
  for (const glm::vec3& pixel : kernel.show(fine)) EXPECT_EQ(pixel, glm::vec3(5.0f));
}

// Radiance that is itself an average of four frames is shown unchanged for four frames; then the
// shown images are averaged, at most three frames.
TEST(AccumulateKernel, AHistoryOfTheRadianceIsNotAveragedAgainWhileItIsYoung) {
  Kernel kernel(4.0f, 2.0f);
  const auto show = [&](float value) {
    return kernel.show(std::vector<glm::vec3>(kSide * kSide, glm::vec3(value))).front().x;
  };
  for (const float young : {8.0f, 4.0f, 2.0f, 6.0f}) EXPECT_EQ(show(young), young);
  EXPECT_NEAR(show(12.0f), 9.0f, 1e-5f);
  EXPECT_NEAR(show(0.0f), 6.0f, 1e-5f);
  EXPECT_NEAR(show(0.0f), 4.0f, 1e-5f);
}

}  // namespace
}  // namespace restlab

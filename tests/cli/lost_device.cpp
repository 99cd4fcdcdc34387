// Simulates a lost device: this library, loaded before the Vulkan loader, answers every submission
// with VK_ERROR_DEVICE_LOST
//   after the first RESTLAB_TEST_SUBMISSIONS, if that is set;
//   once the file RESTLAB_TEST_RESULTS, if that is set, has three lines.
// Writes the number of submissions to the file RESTLAB_TEST_SUBMISSION_COUNT.
#include <dlfcn.h>
#include <vulkan/vulkan.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

namespace {

constexpr int kLinesBeforeLoss = 3;

std::atomic<long> submissions{0};

struct WriteCount {
  ~WriteCount() {
    const char* name = std::getenv("RESTLAB_TEST_SUBMISSION_COUNT");
    if (name == nullptr) return;
    std::FILE* file = std::fopen(name, "w");
    if (file == nullptr) return;
    std::fprintf(file, "%ld\n", submissions.load());
    std::fclose(file);
  }
};
const WriteCount writeCount;

bool isLost() {
  const long count = ++submissions;
  if (const char* limit = std::getenv("RESTLAB_TEST_SUBMISSIONS")) return count > std::atol(limit);
  const char* results = std::getenv("RESTLAB_TEST_RESULTS");
  if (results == nullptr) return false;
  std::ifstream file(results);
  int lines = 0;
  for (std::string line; std::getline(file, line);) ++lines;
  return lines >= kLinesBeforeLoss;
}

}  // namespace

extern "C" VKAPI_ATTR VkResult VKAPI_CALL vkQueueSubmit(VkQueue queue, uint32_t count,
                                                        const VkSubmitInfo* submits,
                                                        VkFence fence) {
  static const auto next = reinterpret_cast<PFN_vkQueueSubmit>(dlsym(RTLD_NEXT, "vkQueueSubmit"));
  if (isLost()) return VK_ERROR_DEVICE_LOST;
  return next(queue, count, submits, fence);
}

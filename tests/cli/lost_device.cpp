// A device that is lost: this library, loaded before the Vulkan loader, answers every submission
// after the first RESTLAB_TEST_SUBMISSIONS with VK_ERROR_DEVICE_LOST. How many there were goes to
// the file RESTLAB_TEST_SUBMISSION_COUNT.
#include <dlfcn.h>
#include <vulkan/vulkan.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>

namespace {

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

}  // namespace

extern "C" VKAPI_ATTR VkResult VKAPI_CALL vkQueueSubmit(VkQueue queue, uint32_t count,
                                                        const VkSubmitInfo* submits,
                                                        VkFence fence) {
  static const auto next = reinterpret_cast<PFN_vkQueueSubmit>(dlsym(RTLD_NEXT, "vkQueueSubmit"));
  const char* limit = std::getenv("RESTLAB_TEST_SUBMISSIONS");
  if (++submissions > (limit != nullptr ? std::atol(limit) : 1'000'000'000L))
    return VK_ERROR_DEVICE_LOST;
  return next(queue, count, submits, fence);
}

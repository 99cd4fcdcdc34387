#include "core/backend/vulkan_device.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <optional>

#include "core/backend/vulkan_error.h"
#include "core/base/error.h"

namespace restlab {

namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";
constexpr const char* kRayExtensions[] = {VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME,
                                          VK_KHR_RAY_QUERY_EXTENSION_NAME,
                                          VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME};
constexpr uint32_t kNone = 0xffffffffu;

struct Features {
  VkPhysicalDeviceFeatures2 core{};
  VkPhysicalDeviceVulkan12Features v12{};
  VkPhysicalDeviceAccelerationStructureFeaturesKHR acceleration{};
  VkPhysicalDeviceRayQueryFeaturesKHR rayQuery{};
  VkSubgroupFeatureFlags subgroupOperations = 0;

  explicit Features(bool withRays) {
    core.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    v12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    acceleration.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR;
    rayQuery.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR;
    core.pNext = &v12;
    if (!withRays) return;
    v12.pNext = &acceleration;
    acceleration.pNext = &rayQuery;
  }
  Features(const Features&) = delete;
  Features& operator=(const Features&) = delete;
};

bool hasExtensions(VkPhysicalDevice device, const char* const* begin, const char* const* end) {
  uint32_t count = 0;
  vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr);
  std::vector<VkExtensionProperties> all(count);
  vkEnumerateDeviceExtensionProperties(device, nullptr, &count, all.data());
  return std::all_of(begin, end, [&](const char* name) {
    return std::any_of(all.begin(), all.end(), [&](const VkExtensionProperties& e) {
      return std::strcmp(e.extensionName, name) == 0;
    });
  });
}

// A queue family that computes, and draws if there is one of these.
uint32_t computeQueueFamily(VkPhysicalDevice device, uint32_t* timestampBits,
                            bool* draws = nullptr) {
  uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
  for (const VkQueueFlags wanted : {VkQueueFlags{VK_QUEUE_COMPUTE_BIT | VK_QUEUE_GRAPHICS_BIT},
                                    VkQueueFlags{VK_QUEUE_COMPUTE_BIT}}) {
    for (uint32_t i = 0; i < count; ++i) {
      if ((families[i].queueFlags & wanted) != wanted) continue;
      if (timestampBits != nullptr) *timestampBits = families[i].timestampValidBits;
      if (draws != nullptr) *draws = (wanted & VK_QUEUE_GRAPHICS_BIT) != 0;
      return i;
    }
  }
  return kNone;
}

// Lists what raster passes need and the device lacks.
std::string whatRasterLacks(VkPhysicalDevice device, const VkPhysicalDeviceFeatures& features) {
  bool draws = false;
  computeQueueFamily(device, nullptr, &draws);
  VkFormatProperties depth;
  vkGetPhysicalDeviceFormatProperties(device, VK_FORMAT_D32_SFLOAT, &depth);
  std::vector<std::string> missing;
  if (!draws) missing.emplace_back("a queue that draws and computes");
  if (!features.vertexPipelineStoresAndAtomics)
    missing.emplace_back("vertexPipelineStoresAndAtomics");
  if (!features.fragmentStoresAndAtomics) missing.emplace_back("fragmentStoresAndAtomics");
  if ((depth.optimalTilingFeatures & VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT) == 0)
    missing.emplace_back("depth of 32 bits");
  return missing.empty() ? "" : fmt::format("the driver lacks {}", fmt::join(missing, ", "));
}

uint32_t findMemoryType(const VkPhysicalDeviceMemoryProperties& memory,
                        VkMemoryPropertyFlags wanted, uint32_t allowed) {
  for (uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
    const bool isAllowed = (allowed >> i & 1u) != 0;
    if (isAllowed && (memory.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
  }
  return kNone;
}

const char* kindName(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return "discrete";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return "integrated";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return "virtual";
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return "cpu";
    default:
      return "other";
  }
}

int preference(const VulkanDeviceInfo& info) {
  const std::vector<std::string> order = {"discrete", "integrated", "virtual", "cpu", "other"};
  const auto place = std::find(order.begin(), order.end(), info.kind) - order.begin();
  return static_cast<int>(place) + (info.whyNot.empty() ? 0 : 100);
}

// Lists what the program needs and the device lacks, by the names of the specification.
std::string whatIsMissing(VkPhysicalDevice device, const VkPhysicalDeviceProperties& properties,
                          const Features& features) {
  std::vector<std::string> missing;
  if (properties.apiVersion < VK_API_VERSION_1_2) missing.emplace_back("Vulkan 1.2");
  if (!features.v12.bufferDeviceAddress) missing.emplace_back("bufferDeviceAddress");
  if (!features.v12.scalarBlockLayout) missing.emplace_back("scalarBlockLayout");
  if (!features.core.features.shaderInt64) missing.emplace_back("shaderInt64");
  if ((features.subgroupOperations & VK_SUBGROUP_FEATURE_ARITHMETIC_BIT) == 0)
    missing.emplace_back("arithmetic of subgroups");
  if (computeQueueFamily(device, nullptr) == kNone) missing.emplace_back("a compute queue");
  return missing.empty() ? "" : fmt::format("the driver lacks {}", fmt::join(missing, ", "));
}

VulkanDeviceInfo describe(VkPhysicalDevice device) {
  VkPhysicalDeviceDriverProperties driver{};
  driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
  VkPhysicalDeviceProperties2 properties{};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  VulkanDeviceInfo info;
  vkGetPhysicalDeviceProperties(device, &properties.properties);
  info.name = properties.properties.deviceName;
  info.kind = kindName(properties.properties.deviceType);
  const bool is12 = properties.properties.apiVersion >= VK_API_VERSION_1_2;
  const bool mayTrace = hasExtensions(device, std::begin(kRayExtensions), std::end(kRayExtensions));
  Features features(mayTrace && is12);
  if (is12) {
    VkPhysicalDeviceVulkan11Properties v11{};
    v11.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES;
    properties.pNext = &driver;
    driver.pNext = &v11;
    vkGetPhysicalDeviceProperties2(device, &properties);
    if ((v11.subgroupSupportedStages & VK_SHADER_STAGE_COMPUTE_BIT) != 0)
      features.subgroupOperations = v11.subgroupSupportedOperations;
    vkGetPhysicalDeviceFeatures2(device, &features.core);
    info.driver = fmt::format("{} {}", driver.driverName, driver.driverInfo);
  }
  info.hasRayQuery = features.rayQuery.rayQuery && features.acceleration.accelerationStructure;
  info.indexesUniforms = features.core.features.shaderUniformBufferArrayDynamicIndexing == VK_TRUE;
  info.whyNoRaster = whatRasterLacks(device, features.core.features);
  info.whyNot = whatIsMissing(device, properties.properties, features);
  VkPhysicalDeviceMemoryProperties memory;
  vkGetPhysicalDeviceMemoryProperties(device, &memory);
  for (uint32_t i = 0; i < memory.memoryHeapCount; ++i) {
    if (memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT)
      info.memoryBytes = std::max(info.memoryBytes, uint64_t(memory.memoryHeaps[i].size));
  }
  return info;
}

std::string lowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace

// The Vulkan instance, and the messages of the validation layers.
struct VulkanDevice::Instance {
  VkInstance handle = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;
  std::mutex mutex;
  std::vector<std::string> messages;

  Instance() = default;
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;
  ~Instance() {
    if (messenger != VK_NULL_HANDLE) {
      const auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
          vkGetInstanceProcAddr(handle, "vkDestroyDebugUtilsMessengerEXT"));
      destroy(handle, messenger, nullptr);
    }
    if (handle != VK_NULL_HANDLE) vkDestroyInstance(handle, nullptr);
    // Print messages that came after the last call that could throw, about objects still alive.
    for (const std::string& message : messages)
      fmt::print(stderr, "the Vulkan validation layers: {}\n", message);
  }

  static VKAPI_ATTR VkBool32 VKAPI_CALL onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                                  VkDebugUtilsMessageTypeFlagsEXT,
                                                  const VkDebugUtilsMessengerCallbackDataEXT* data,
                                                  void* user) {
    auto* self = static_cast<Instance*>(user);
    const std::lock_guard lock(self->mutex);
    self->messages.emplace_back(data->pMessage);
    return VK_FALSE;
  }

  // Returns null if there is no driver.
  static std::shared_ptr<Instance> make(bool validate) {
    auto instance = std::make_shared<Instance>();
    VkApplicationInfo app{};
    app.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    app.pApplicationName = "restlab";
    app.apiVersion = VK_API_VERSION_1_2;
    VkInstanceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info.pApplicationInfo = &app;
    const VkValidationFeatureEnableEXT enabled[] = {
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
    VkValidationFeaturesEXT validation{};
    validation.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
    validation.enabledValidationFeatureCount = 1;
    validation.pEnabledValidationFeatures = enabled;
    const char* extensions[] = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME,
                                VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
    if (validate) {
      info.pNext = &validation;
      info.enabledLayerCount = 1;
      info.ppEnabledLayerNames = &kValidationLayer;
      info.enabledExtensionCount = 2;
      info.ppEnabledExtensionNames = extensions;
    }
    const VkResult result = vkCreateInstance(&info, nullptr, &instance->handle);
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER) return nullptr;
    if (result == VK_ERROR_LAYER_NOT_PRESENT || result == VK_ERROR_EXTENSION_NOT_PRESENT) {
      throw Error(ExitCode::deviceUnavailable,
                  "validation: the Vulkan validation layers are not installed (package "
                  "vulkan-validationlayers)");
    }
    vulkanCheck(result, "Vulkan", "vkCreateInstance");
    if (validate) {
      VkDebugUtilsMessengerCreateInfoEXT messenger{};
      messenger.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
      messenger.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                                  VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
      messenger.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
                              VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
      messenger.pfnUserCallback = onMessage;
      messenger.pUserData = instance.get();
      const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
          vkGetInstanceProcAddr(instance->handle, "vkCreateDebugUtilsMessengerEXT"));
      vulkanCheck(create(instance->handle, &messenger, nullptr, &instance->messenger), "Vulkan",
                  "vkCreateDebugUtilsMessengerEXT");
    }
    return instance;
  }

  std::vector<std::pair<VulkanDeviceInfo, VkPhysicalDevice>> devices() const {
    uint32_t count = 0;
    vulkanCheck(vkEnumeratePhysicalDevices(handle, &count, nullptr), "Vulkan",
                "vkEnumeratePhysicalDevices");
    std::vector<VkPhysicalDevice> physical(count);
    vulkanCheck(vkEnumeratePhysicalDevices(handle, &count, physical.data()), "Vulkan",
                "vkEnumeratePhysicalDevices");
    std::vector<std::pair<VulkanDeviceInfo, VkPhysicalDevice>> all;
    for (VkPhysicalDevice device : physical) all.emplace_back(describe(device), device);
    std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
      return preference(a.first) < preference(b.first);
    });
    return all;
  }
};

std::vector<VulkanDeviceInfo> vulkanDeviceInfos() {
  std::vector<VulkanDeviceInfo> infos;
  const auto instance = VulkanDevice::Instance::make(false);
  if (!instance) return infos;
  for (const auto& entry : instance->devices()) infos.push_back(entry.first);
  return infos;
}

std::shared_ptr<VulkanDevice> VulkanDevice::open(const VulkanOptions& given) {
  VulkanOptions options = given;
  // RESTLAB_VALIDATE=1 runs a whole test suite with the layers.
  const char* always = std::getenv("RESTLAB_VALIDATE");
  options.validate = options.validate || (always != nullptr && std::strcmp(always, "1") == 0);
  static std::mutex mutex;
  static std::map<std::pair<std::string, bool>, std::weak_ptr<VulkanDevice>> opened;
  const std::lock_guard lock(mutex);
  std::weak_ptr<VulkanDevice>& known = opened[{lowerCase(options.device), options.validate}];
  if (auto device = known.lock()) return device;

  const auto instance = Instance::make(options.validate);
  std::vector<std::pair<VulkanDeviceInfo, VkPhysicalDevice>> all;
  if (instance) all = instance->devices();
  if (all.empty()) {
    throw Error(ExitCode::deviceUnavailable,
                "no Vulkan device; the package mesa-vulkan-drivers has one in software");
  }
  std::vector<std::string> names;
  const std::pair<VulkanDeviceInfo, VkPhysicalDevice>* chosen = nullptr;
  for (const auto& entry : all) {
    names.push_back("'" + entry.first.name + "'");
    if (chosen == nullptr &&
        lowerCase(entry.first.name).find(lowerCase(options.device)) != std::string::npos)
      chosen = &entry;
  }
  if (chosen == nullptr) {
    throw Error(ExitCode::deviceUnavailable,
                fmt::format("--device '{}': no Vulkan device has that in its name; there is {}",
                            options.device, fmt::join(names, ", ")));
  }
  if (!chosen->first.whyNot.empty()) {
    throw Error(ExitCode::deviceUnavailable,
                fmt::format("{}: {} (restlab list backends shows all devices)", chosen->first.name,
                            chosen->first.whyNot));
  }

  std::shared_ptr<VulkanDevice> device(new VulkanDevice);
  device->instance_ = instance;
  device->info_ = chosen->first;
  device->physical_ = chosen->second;
  VkPhysicalDeviceMaintenance3Properties maintenance{};
  maintenance.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES;
  VkPhysicalDeviceProperties2 properties{};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  properties.pNext = &maintenance;
  vkGetPhysicalDeviceProperties2(device->physical_, &properties);
  device->properties_ = properties.properties;
  device->largestAllocation_ = maintenance.maxMemoryAllocationSize;
  vkGetPhysicalDeviceMemoryProperties(device->physical_, &device->memory_);
  const uint32_t family = computeQueueFamily(device->physical_, &device->timestampBits_);

  Features features(device->info_.hasRayQuery);
  features.v12.bufferDeviceAddress = VK_TRUE;
  features.v12.scalarBlockLayout = VK_TRUE;
  features.core.features.shaderInt64 = VK_TRUE;
  features.core.features.shaderUniformBufferArrayDynamicIndexing =
      device->info_.indexesUniforms ? VK_TRUE : VK_FALSE;
  const VkBool32 draws = device->info_.whyNoRaster.empty() ? VK_TRUE : VK_FALSE;
  features.core.features.vertexPipelineStoresAndAtomics = draws;
  features.core.features.fragmentStoresAndAtomics = draws;
  features.acceleration.accelerationStructure = VK_TRUE;
  features.rayQuery.rayQuery = VK_TRUE;
  const float priority = 1.0f;
  VkDeviceQueueCreateInfo queue{};
  queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
  queue.queueFamilyIndex = family;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  VkDeviceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
  info.pNext = &features.core;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  if (device->info_.hasRayQuery) {
    info.enabledExtensionCount = static_cast<uint32_t>(std::size(kRayExtensions));
    info.ppEnabledExtensionNames = kRayExtensions;
  }
  device->check(vkCreateDevice(device->physical_, &info, nullptr, &device->device_),
                "vkCreateDevice");
  vkGetDeviceQueue(device->device_, family, 0, &device->queue_);
  VkCommandPoolCreateInfo pool{};
  pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  pool.queueFamilyIndex = family;
  device->check(vkCreateCommandPool(device->device_, &pool, nullptr, &device->pool_),
                "vkCreateCommandPool");
  known = device;
  return device;
}

VulkanDevice::~VulkanDevice() {
  if (device_ == VK_NULL_HANDLE) return;
  vkDeviceWaitIdle(device_);
  if (pool_ != VK_NULL_HANDLE) vkDestroyCommandPool(device_, pool_, nullptr);
  vkDestroyDevice(device_, nullptr);
}

void VulkanDevice::check(VkResult result, const char* what) const {
  vulkanCheck(result, info_.name, what);
}

double VulkanDevice::timestampMs(uint64_t begin, uint64_t end) const {
  const uint64_t mask = timestampBits_ >= 64 ? ~uint64_t{0} : (uint64_t{1} << timestampBits_) - 1;
  return double((end - begin) & mask) * double(properties_.limits.timestampPeriod) * 1e-6;
}

VkCommandBuffer VulkanDevice::newCommands() {
  VkCommandBufferAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
  info.commandPool = pool_;
  info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  info.commandBufferCount = 1;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  check(vkAllocateCommandBuffers(device_, &info, &commands), "vkAllocateCommandBuffers");
  return commands;
}

void VulkanDevice::freeCommands(VkCommandBuffer commands) {
  vkFreeCommandBuffers(device_, pool_, 1, &commands);
}

void VulkanDevice::submit(VkCommandBuffer commands, VkFence fence, const char* what) {
  VkSubmitInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  info.commandBufferCount = 1;
  info.pCommandBuffers = &commands;
  check(vkQueueSubmit(queue_, 1, &info, fence), what);
}

void VulkanDevice::runNow(const std::function<void(VkCommandBuffer)>& record, const char* what) {
  VkCommandBuffer commands = newCommands();
  VkCommandBufferBeginInfo begin{};
  begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  check(vkBeginCommandBuffer(commands, &begin), what);
  // Waiting for a queue does not make its writes visible to its next commands: a barrier is needed.
  VkMemoryBarrier before{};
  before.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
  before.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
  before.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                       VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 1, &before, 0, nullptr, 0, nullptr);
  record(commands);
  check(vkEndCommandBuffer(commands), what);
  submit(commands, VK_NULL_HANDLE, what);
  check(vkQueueWaitIdle(queue_), what);
  freeCommands(commands);
  throwValidationMessages();
}

void VulkanDevice::throwValidationMessages() {
  const std::lock_guard lock(instance_->mutex);
  if (instance_->messages.empty()) return;
  const std::string first = instance_->messages.front();
  const size_t count = instance_->messages.size();
  instance_->messages.clear();
  throw std::runtime_error(
      fmt::format("the Vulkan validation layers have {} messages; the first: {}", count, first));
}

uint32_t VulkanDevice::memoryTypeOf(VkMemoryPropertyFlags wanted, uint32_t allowed) const {
  return findMemoryType(memory_, wanted, allowed);
}

}  // namespace restlab

#include "core/backend/vulkan_acceleration.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "core/base/error.h"

namespace restlab {

namespace {

// Levels whose scratch memory fits together are built side by side.
constexpr VkDeviceSize kScratchBytes = VkDeviceSize{64} << 20;
constexpr uint64_t kCustomIndices = uint64_t{1} << 24;

VkTransformMatrixKHR transformOf(const rl::Instance& instance) {
  VkTransformMatrixKHR result;
  const glm::vec4 rows[3] = {instance.objectToWorldRow0, instance.objectToWorldRow1,
                             instance.objectToWorldRow2};
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 4; ++c) result.matrix[r][c] = rows[r][c];
  }
  return result;
}

bool isTransparent(const rl::Instance& instance) {
  return (instance.flags & rl::RL_INSTANCE_ALPHA) != 0;
}

VkAccelerationStructureGeometryKHR newGeometry(VkGeometryTypeKHR type) {
  VkAccelerationStructureGeometryKHR geometry{};
  geometry.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR;
  geometry.geometryType = type;
  return geometry;
}

}  // namespace

// The loader exports none of an extension's functions.
struct VulkanAcceleration::Calls {
  PFN_vkCreateAccelerationStructureKHR create;
  PFN_vkDestroyAccelerationStructureKHR destroy;
  PFN_vkGetAccelerationStructureBuildSizesKHR buildSizes;
  PFN_vkGetAccelerationStructureDeviceAddressKHR address;
  PFN_vkCmdBuildAccelerationStructuresKHR build;

  explicit Calls(VkDevice device) {
    const auto get = [&](auto& call, const char* name) {
      call = reinterpret_cast<std::remove_reference_t<decltype(call)>>(
          vkGetDeviceProcAddr(device, name));
      if (call == nullptr)
        throw Error(ExitCode::deviceUnavailable, fmt::format("the Vulkan driver lacks {}", name));
    };
    get(create, "vkCreateAccelerationStructureKHR");
    get(destroy, "vkDestroyAccelerationStructureKHR");
    get(buildSizes, "vkGetAccelerationStructureBuildSizesKHR");
    get(address, "vkGetAccelerationStructureDeviceAddressKHR");
    get(build, "vkCmdBuildAccelerationStructuresKHR");
  }
};

std::unique_ptr<VulkanAcceleration> VulkanAcceleration::build(std::shared_ptr<VulkanMemory> memory,
                                                              const BvhInput& scene,
                                                              const rl::SceneData& placed) {
  std::unique_ptr<VulkanAcceleration> built(new VulkanAcceleration(std::move(memory)));
  built->checkLimits(scene);
  built->buildBottom(scene, placed);
  built->buildTop(scene);
  for (const GpuBuffer& buffer : built->temporary_) built->memory_->free(buffer);
  built->temporary_.clear();
  return built;
}

VulkanAcceleration::VulkanAcceleration(std::shared_ptr<VulkanMemory> memory)
    : memory_(std::move(memory)),
      device_(memory_->device()),
      calls_(std::make_unique<Calls>(device_.handle())) {
  limits_.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_PROPERTIES_KHR;
  VkPhysicalDeviceProperties2 properties{};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  properties.pNext = &limits_;
  vkGetPhysicalDeviceProperties2(device_.physical(), &properties);
}

VulkanAcceleration::~VulkanAcceleration() {
  const auto release = [&](const Level& level) {
    if (level.handle != VK_NULL_HANDLE) calls_->destroy(device_.handle(), level.handle, nullptr);
    memory_->free(level.storage);
  };
  release(top_);
  for (const Level& level : bottom_) release(level);
  for (const GpuBuffer& buffer : temporary_) memory_->free(buffer);
}

size_t VulkanAcceleration::bytes() const {
  size_t sum = top_.storage.bytes;
  for (const Level& level : bottom_) sum += level.storage.bytes;
  return sum;
}

void VulkanAcceleration::checkLimits(const BvhInput& scene) const {
  const auto check = [&](uint64_t count, uint64_t limit, const char* what) {
    if (count <= limit) return;
    throw Error(ExitCode::deviceUnavailable,
                fmt::format("--ray-tracing query: {} {}, but {} takes at most {}; --ray-tracing "
                            "bvh works there",
                            count, what, device_.name(), limit));
  };
  // Hits name their instance by 24 bits.
  check(scene.instances.size(), std::min(limits_.maxInstanceCount, kCustomIndices), "instances");
  for (const rl::Geometry& geometry : scene.geometries)
    check(geometry.triangleCount, limits_.maxPrimitiveCount, "triangles of a mesh");
}

GpuBuffer VulkanAcceleration::allocateOnce(size_t bytes) {
  temporary_.push_back(memory_->allocate(bytes, MemoryKind::device));
  return temporary_.back();
}

// Creates the level that a plan builds, with the size that the driver asks for.
void VulkanAcceleration::create(Plan& plan) {
  plan.info.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_GEOMETRY_INFO_KHR;
  plan.info.flags = VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_TRACE_BIT_KHR;
  plan.info.mode = VK_BUILD_ACCELERATION_STRUCTURE_MODE_BUILD_KHR;
  plan.info.geometryCount = 1;
  plan.info.pGeometries = &plan.geometry;
  VkAccelerationStructureBuildSizesInfoKHR sizes{};
  sizes.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_SIZES_INFO_KHR;
  calls_->buildSizes(device_.handle(), VK_ACCELERATION_STRUCTURE_BUILD_TYPE_DEVICE_KHR, &plan.info,
                     &plan.range.primitiveCount, &sizes);
  Level& level = *plan.level;
  level.storage = memory_->allocate(sizes.accelerationStructureSize, MemoryKind::device);
  VkAccelerationStructureCreateInfoKHR info{};
  info.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_CREATE_INFO_KHR;
  info.buffer = level.storage.buffer;
  info.offset = level.storage.offset;  // a multiple of 256, as all of VulkanMemory's
  info.size = sizes.accelerationStructureSize;
  info.type = plan.info.type;
  device_.check(calls_->create(device_.handle(), &info, nullptr, &level.handle),
                "vkCreateAccelerationStructureKHR");
  VkAccelerationStructureDeviceAddressInfoKHR address{};
  address.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_DEVICE_ADDRESS_INFO_KHR;
  address.accelerationStructure = level.handle;
  level.address = calls_->address(device_.handle(), &address);
  plan.info.dstAccelerationStructure = level.handle;
  plan.scratchBytes = sizes.buildScratchSize;
}

// Builds the levels in batches that share one piece of scratch memory.
void VulkanAcceleration::run(std::vector<Plan*> plans) {
  if (plans.empty()) return;
  const VkDeviceSize alignment =
      std::max<VkDeviceSize>(limits_.minAccelerationStructureScratchOffsetAlignment, 1);
  const auto aligned = [&](VkDeviceSize value) {
    return (value + alignment - 1) / alignment * alignment;
  };
  // Put levels of similar size side by side: a batch takes as long as its largest.
  std::stable_sort(plans.begin(), plans.end(),
                   [](const Plan* a, const Plan* b) { return a->scratchBytes > b->scratchBytes; });
  VkDeviceSize all = 0;
  for (const Plan* plan : plans) all += aligned(plan->scratchBytes);
  const VkDeviceSize available =
      std::max(aligned(plans.front()->scratchBytes), std::min(all, kScratchBytes));
  const GpuBuffer scratch = allocateOnce(available + alignment);
  for (size_t begin = 0; begin < plans.size();) {
    std::vector<VkAccelerationStructureBuildGeometryInfoKHR> infos;
    std::vector<const VkAccelerationStructureBuildRangeInfoKHR*> ranges;
    VkDeviceSize used = 0;
    size_t end = begin;
    for (; end < plans.size(); ++end) {
      Plan& plan = *plans[end];
      if (used + plan.scratchBytes > available) break;
      plan.info.scratchData.deviceAddress = aligned(scratch.address) + used;
      used += aligned(plan.scratchBytes);
      infos.push_back(plan.info);
      ranges.push_back(&plan.range);
    }
    device_.runNow(
        [&](VkCommandBuffer commands) {
          // Wait for copies of the input, for levels that this one refers to, and for the previous
          // batch in the same scratch memory.
          VkMemoryBarrier before{};
          before.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
          before.srcAccessMask =
              VK_ACCESS_TRANSFER_WRITE_BIT | VK_ACCESS_ACCELERATION_STRUCTURE_WRITE_BIT_KHR;
          before.dstAccessMask = VK_ACCESS_SHADER_READ_BIT |
                                 VK_ACCESS_ACCELERATION_STRUCTURE_READ_BIT_KHR |
                                 VK_ACCESS_ACCELERATION_STRUCTURE_WRITE_BIT_KHR;
          vkCmdPipelineBarrier(commands,
                               VK_PIPELINE_STAGE_TRANSFER_BIT |
                                   VK_PIPELINE_STAGE_ACCELERATION_STRUCTURE_BUILD_BIT_KHR,
                               VK_PIPELINE_STAGE_ACCELERATION_STRUCTURE_BUILD_BIT_KHR, 0, 1,
                               &before, 0, nullptr, 0, nullptr);
          calls_->build(commands, static_cast<uint32_t>(infos.size()), infos.data(), ranges.data());
          // Make the levels visible to kernels: frames wait for kernels and copies alone.
          VkMemoryBarrier after{};
          after.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
          after.srcAccessMask = VK_ACCESS_ACCELERATION_STRUCTURE_WRITE_BIT_KHR;
          after.dstAccessMask = VK_ACCESS_ACCELERATION_STRUCTURE_READ_BIT_KHR;
          vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ACCELERATION_STRUCTURE_BUILD_BIT_KHR,
                               VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, 0, 1, &after, 0, nullptr, 0,
                               nullptr);
        },
        "building acceleration structures");
    begin = end;
  }
}

void VulkanAcceleration::buildBottom(const BvhInput& scene, const rl::SceneData& placed) {
  std::vector<bool> isUsed(scene.geometries.size(), false);
  std::vector<bool> asks(scene.geometries.size(), false);  // rays ask the material of an instance
  for (const rl::Instance& instance : scene.instances) {
    isUsed[instance.geometry] = scene.geometries[instance.geometry].triangleCount > 0;
    if (isTransparent(instance)) asks[instance.geometry] = true;
  }
  const auto positions = std::bit_cast<uint64_t>(placed.positions.data);
  const auto triangles = std::bit_cast<uint64_t>(placed.triangles.data);
  bottom_.resize(scene.geometries.size());
  std::vector<Plan> plans(static_cast<size_t>(std::count(isUsed.begin(), isUsed.end(), true)));
  std::vector<Plan*> order;
  for (size_t g = 0; g < scene.geometries.size(); ++g) {
    if (!isUsed[g]) continue;
    const rl::Geometry& geometry = scene.geometries[g];
    const size_t vertexEnd = g + 1 < scene.geometries.size() ? scene.geometries[g + 1].firstVertex
                                                             : scene.positions.size();
    Plan& plan = plans[order.size()];
    order.push_back(&plan);
    plan.geometry = newGeometry(VK_GEOMETRY_TYPE_TRIANGLES_KHR);
    // Shadow rays multiply transmittances: a surface that is reported twice would count twice.
    plan.geometry.flags =
        asks[g] ? VK_GEOMETRY_NO_DUPLICATE_ANY_HIT_INVOCATION_BIT_KHR : VK_GEOMETRY_OPAQUE_BIT_KHR;
    VkAccelerationStructureGeometryTrianglesDataKHR& data = plan.geometry.geometry.triangles;
    data.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_TRIANGLES_DATA_KHR;
    data.vertexFormat = VK_FORMAT_R32G32B32_SFLOAT;
    data.vertexData.deviceAddress = positions + geometry.firstVertex * sizeof(glm::vec3);
    data.vertexStride = sizeof(glm::vec3);
    data.maxVertex = static_cast<uint32_t>(vertexEnd - geometry.firstVertex - 1);
    data.indexType = VK_INDEX_TYPE_UINT32;
    data.indexData.deviceAddress = triangles + geometry.firstTriangle * sizeof(glm::uvec3);
    plan.range.primitiveCount = geometry.triangleCount;
    plan.info.type = VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR;
    plan.level = &bottom_[g];
    create(plan);
  }
  run(std::move(order));
}

void VulkanAcceleration::buildTop(const BvhInput& scene) {
  std::vector<VkAccelerationStructureInstanceKHR> instances;
  for (uint32_t i = 0; i < scene.instances.size(); ++i) {
    const rl::Instance& instance = scene.instances[i];
    const Level& bottom = bottom_[instance.geometry];
    if (bottom.handle == VK_NULL_HANDLE) continue;
    VkAccelerationStructureInstanceKHR entry{};
    entry.transform = transformOf(instance);
    entry.instanceCustomIndex = i & 0xffffffu;
    entry.mask = 0xff;
    if (!isTransparent(instance)) entry.flags = VK_GEOMETRY_INSTANCE_FORCE_OPAQUE_BIT_KHR;
    entry.accelerationStructureReference = bottom.address;
    instances.push_back(entry);
  }
  const size_t bytes = instances.size() * sizeof instances[0];
  const GpuBuffer input = allocateOnce(bytes);
  memory_->write(input, instances.data(), bytes);
  Plan plan;
  plan.geometry = newGeometry(VK_GEOMETRY_TYPE_INSTANCES_KHR);
  plan.geometry.geometry.instances.sType =
      VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_INSTANCES_DATA_KHR;
  plan.geometry.geometry.instances.data.deviceAddress = input.address;
  plan.range.primitiveCount = static_cast<uint32_t>(instances.size());
  plan.info.type = VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR;
  plan.level = &top_;
  create(plan);
  run({&plan});
}

}  // namespace restlab

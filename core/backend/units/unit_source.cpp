#include "core/backend/units/unit_source.h"

#include <fmt/format.h>

#include <glm/glm.hpp>

#include "core/backend/embree.h"

namespace restlab {

namespace {

constexpr const char* kBody = "core/backend/cpu_kernel.inl";
constexpr const char* kTrace = "core/backend/cpu_trace.inl";

}  // namespace

std::string unitText(const KernelUnit& unit, const std::string& compilerVersion) {
  const DialectKernel& files = dialectKernel(unit.kernel);
  return fmt::format(R"(#define RL_KERNEL_NAME {name}
#define RL_KERNEL_MASKS(M) M(unit, {mask}ull)
#define RL_KERNEL_HEADER "{header}"
#define RL_KERNEL_FILE "{file}"
#define RL_KERNEL_TRACE "{trace}"
#include "{body}"
static_assert(__builtin_strcmp(__VERSION__, R"rl({version})rl") == 0,
              "the compiler is another one than that of the program: build the program anew");
static_assert(__builtin_strcmp(RTC_VERSION_STRING, "{embree}") == 0 && GLM_VERSION == {glm},
              "headers of Embree or GLM are others than those of the program: build it anew");
extern "C" __attribute__((visibility("default"))) const rl::CpuKernelEntry {entry};
extern "C" const rl::CpuKernelEntry {entry} = rl::kernel_{name}_unit;
)",
                     fmt::arg("name", unit.kernel), fmt::arg("mask", unit.mask),
                     fmt::arg("header", files.header), fmt::arg("file", files.file),
                     fmt::arg("trace", kTrace), fmt::arg("body", kBody),
                     fmt::arg("version", compilerVersion), fmt::arg("entry", kUnitEntry),
                     fmt::arg("embree", RTC_VERSION_STRING), fmt::arg("glm", GLM_VERSION));
}

std::vector<DialectSource> unitSources(const KernelUnit& unit) {
  const DialectKernel& files = dialectKernel(unit.kernel);
  return includedSources({kBody, kTrace, files.header, files.file});
}

}  // namespace restlab

// Records every random draw of a kernel. A kernel is audited by compiling it once more with
// RL_RNG_AUDIT defined as below (the rng_audit_*.cpp files), for the general feature mask.
#pragma once

#include <cstdint>

#include "core/backend/cpu_kernel.h"

namespace restlab::unit {

void auditDraw(uint32_t keyX, uint32_t keyY, uint32_t vertex, uint32_t dimension);

}  // namespace restlab::unit

namespace rl {

extern const CpuKernelEntry kernel_path_audited;
extern const CpuKernelEntry kernel_template_audited;
extern const CpuKernelEntry kernel_bdpt_audited;
extern const CpuKernelEntry kernel_local_audited;
extern const CpuKernelEntry kernel_radiosity_rays_audited;
extern const CpuKernelEntry kernel_radiosity_direct_audited;
extern const CpuKernelEntry kernel_radiance_trace_audited;
extern const CpuKernelEntry kernel_restir_di_initial_audited;
extern const CpuKernelEntry kernel_restir_gi_light_edges_audited;
extern const CpuKernelEntry kernel_restir_gi_initial_audited;
extern const CpuKernelEntry kernel_restir_gi_temporal_audited;
extern const CpuKernelEntry kernel_restir_gi_spatial_shift_audited;
extern const CpuKernelEntry kernel_changes_trace_audited;
extern const CpuKernelEntry kernel_restir_gi_spatial_audited;
extern const CpuKernelEntry kernel_restir_gi_cache_reuse_audited;
extern const CpuKernelEntry kernel_restir_gi_cache_update_audited;
extern const CpuKernelEntry kernel_surflet_propose_audited;
extern const CpuKernelEntry kernel_voxel_propose_audited;

}  // namespace rl

#define RL_RNG_AUDIT(rng, dimension) \
  ::restlab::unit::auditDraw((rng).key.x, (rng).key.y, (rng).vertex, (dimension))
#define RL_KERNEL_MASKS(M) M(audited, rl::RL_FEATURE_ALL)

// Registers `restir_pt`: its parameters, its summary and its probe.
//
// One reservoir a pixel over the whole path space, direct light included (Lin et al. 2022; Lin,
// Kettunen and Wyman 2026). The shift replays the random numbers of the path up to the first pair
// of vertices that connects, and reconnects there; light samples are reconnected, never replayed.
// The integrand leaves out the density of the direction that a reconnection replaces, so that the
// Jacobian is a ratio of geometry terms.
#include "core/path_sample/method.h"
#include "core/path_sample/path_sample.h"
#include "core/path_sample/settings.h"

namespace restlab {

// Made by rl_add_path_probe (core/path_sample/pixel_donors.inl).
void restir_ptSetsProbe(IntegratorInfo& info);

const IntegratorInfo& restir_ptIntegratorInfo() {
  static const IntegratorInfo info = [] {
    IntegratorInfo i =
        pathReuseMethod("restir_pt", rl::RL_PATH_RESERVOIR_UVEC4S, replayParameters(),
                        "paths reconnect at the same vertex on both sides, ");
    i.summary = "ReSTIR PT: one reservoir a pixel, of all its paths; prefixes are replayed";
    restir_ptSetsProbe(i);
    i.reasonUnused = [ofPasses = i.reasonUnused](const std::string& name, const ParameterMap& p) {
      const std::string reason = replayReasonUnused(name, p);
      return reason.empty() ? ofPasses(name, p) : reason;
    };
    return i;
  }();
  return info;
}

}  // namespace restlab

// Host side of `restir_pt`: the declaration of its bias, and what a reservoir holds, for people.
//
// One reservoir a pixel over the whole path space, direct light included (Lin et al. 2022; Lin,
// Kettunen and Wyman 2026). The shift replays the random numbers of the path up to the first pair
// of vertices that connects, and reconnects there; light samples are reconnected, never replayed.
// The integrand leaves out the density of the direction that a reconnection replaces, so that the
// Jacobian is a ratio of geometry terms.
#include <fmt/format.h>

#include <bit>

#include "core/path_sample/method.h"
#include "core/path_sample/path_sample.h"
#include "core/path_sample/settings.h"

namespace restlab {

namespace {

// Words as core/path_sample/replay_words.glsl lays them out.
std::vector<ProbeValue> probe(const FrameSnapshot& snapshot, size_t pixel) {
  constexpr size_t kWords = 4 * rl::RL_PATH_RESERVOIR_UVEC4S;
  const auto words = snapshot.words("reservoir_history").subspan(kWords * pixel, kWords);
  std::vector<ProbeValue> values = weightProbe(words[10], words[11]);
  if (!(std::bit_cast<float>(words[10]) > 0.0f)) return values;
  static const std::array<const char*, 7> kinds = {
      "light of a rough vertex",     "Lambert vertex",
      "glossy vertex, light sample", "glossy vertex, emitter behind it",
      "glossy vertex, continued",    "light sample of a smooth vertex",
      "replayed as a whole"};
  const uint32_t kind = words[2] >> 24 & rl::RL_PATH_KIND_MASK, base = words[3] >> 24 & 15u;
  values.push_back({"kind", kinds.at(kind)});
  values.push_back({"k", fmt::format("{}", base + 2)});
  values.push_back({"replayed", fmt::format("{}", base)});
  return values;
}

}  // namespace

const IntegratorInfo& restir_ptIntegratorInfo() {
  static const IntegratorInfo info = [] {
    IntegratorInfo i =
        pathReuseMethod("restir_pt", rl::RL_PATH_RESERVOIR_UVEC4S, replayParameters(),
                        "paths reconnect at the same vertex on both sides, ");
    i.summary = "ReSTIR PT: one reservoir a pixel, of all its paths; prefixes are replayed";
    i.probe = probe;
    i.reasonUnused = [ofPasses = i.reasonUnused](const std::string& name, const ParameterMap& p) {
      const std::string reason = replayReasonUnused(name, p);
      return reason.empty() ? ofPasses(name, p) : reason;
    };
    return i;
  }();
  return info;
}

}  // namespace restlab

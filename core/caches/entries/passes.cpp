#include "core/caches/entries/passes.h"

#include "core/caches/entries/settings.h"

namespace restlab {

EntryBuffers entryBuffers(FrameGraph& g, const FrameInfo& f) {
  const rl::EntryParams entries = packEntries(f.parameters);
  EntryBuffers b;
  b.surfaces = g.shared.surfaces.now;
  b.proposals = g.buffer("proposals", f.pixels * entries.proposals, sizeof(uint32_t));
  b.shadingPoints = g.buffer("shading_points", entries.count, 16 * rl::RL_SHADING_POINT_UVEC4S);
  b.insertions = g.buffer("insertions", entries.count, sizeof(uint32_t) * rl::RL_ENTRY_INSERTIONS);
  b.keys = g.buffer("entry_keys", entries.count, 2 * sizeof(uint32_t));
  b.seen = g.buffer("entry_seen", entries.count, sizeof(uint32_t));
  b.claims = g.buffer("entry_claims", entries.count, sizeof(uint32_t));
  b.entryOfPixel = g.buffer(kEntryOfPixel, f.pixels, sizeof(uint32_t));
  g.shared.proposals = b.proposals;
  g.shared.shadingPoints = b.shadingPoints;
  g.shared.insertions = b.insertions;
  return b;
}

void recordEntries(const FrameInfo& f, const std::string& name, const EntryBuffers& b,
                   Buffer shapes, const Kernels& kernels) {
  const auto pass = [&](const std::string& what, const std::string& again = "") -> GraphPass& {
    return kernels.pass(name + "_" + what + again, name + "_" + what);
  };
  const auto find = [&](const std::string& what, const std::string& again = "") {
    pass(what, again).reads({b.surfaces, b.keys, shapes}).updates({b.seen, b.entryOfPixel});
  };
  const auto claim = [&](const std::string& again = "") {
    pass("claim", again).reads({b.surfaces, b.seen}).updates({b.claims, b.entryOfPixel});
    pass("resolve_claims", again)
        .reads({b.surfaces, b.claims, b.entryOfPixel})
        .updates({b.keys, b.seen, b.shadingPoints, shapes});
  };
  pass("clear").over(packEntries(f.parameters).count).writes({b.claims, b.insertions});
  if (f.isNewView) {
    find("find");
    // Twice: a query that loses a claim to another one has other hash slots to try.
    claim();
    find("find_after_claims");
    claim("_again");
    find("find_after_claims", "_last");
    pass("propose")
        .reads({b.surfaces, b.keys, b.entryOfPixel, b.shadingPoints, shapes})
        .writes({b.proposals});
  }
  pass("insertions").reads({b.surfaces, b.entryOfPixel, b.shadingPoints}).updates({b.insertions});
}

}  // namespace restlab

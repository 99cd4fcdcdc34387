#include "core/reuse/passes.h"

#include <array>
#include <cstring>

namespace restlab {

// Each spatial neighbour k has a buffer ReuseBuffers::pairedShifts<k>.
static_assert(rl::RL_MAX_DONORS == 4);

std::string pairedShiftsName(uint32_t neighbour) {
  return "spatial_shift_" + std::to_string(neighbour);
}

std::string lastRoundsReservoirs(uint32_t rounds) {
  // Two buffers take turns.
  return rounds > 1 ? "round_" + std::to_string(2 - rounds % 2) : "reservoirs";
}

namespace {

// Bytes of a Params struct for the passes of a round.
std::vector<std::byte> withRound(std::vector<std::byte> params, rl::ReuseParams reuse,
                                 uint32_t round) {
  reuse.spatialRound = round;
  std::memcpy(params.data(), &reuse, sizeof reuse);
  return params;
}

}  // namespace

void recordReuse(FrameGraph& g, const FrameInfo& f, const ReusedSample& sample,
                 const rl::ReuseParams& reuse, const rl::EntryParams& entries,
                 std::vector<std::byte> params) {
  const FrameBuffers& s = g.shared;
  const bool isTemporal = reuse.temporalReuse != 0, hasEntries = entries.count != 0;
  constexpr uint32_t kUvec4Bytes = 16;
  const uint32_t reservoirBytes = kUvec4Bytes * sample.reservoirUvec4s;
  const Buffer radiance = g.buffer("radiance", f.pixels, sizeof(glm::vec3));
  const Buffer radianceFrames =
      g.buffer("radiance_frames", reuse.writesRadianceFrames != 0 ? f.pixels : 0, sizeof(float));
  const History unresampled = g.advance(g.history("unresampled_radiance", f.pixels, kUvec4Bytes));
  const Buffer reservoirs = g.buffer("reservoirs", f.pixels, reservoirBytes);
  const Buffer history = g.buffer("reservoir_history", f.pixels, reservoirBytes);
  std::array<Buffer, rl::RL_MAX_DONORS> pairedShifts;
  for (uint32_t k = 0; k < reuse.spatialNeighbours; ++k)
    pairedShifts[k] = g.transient(pairedShiftsName(k), f.pixels, kUvec4Bytes);
  const Buffer outlines = g.buffer("outlines", f.pixels, sizeof(uint32_t));
  const size_t mapped = reuse.duplicationMap != 0 ? f.pixels : 0;
  const Buffer sampleFilms = g.transient("sample_films", mapped, sizeof(uint32_t));
  const Buffer duplicates = g.buffer("duplicates", mapped, sizeof(uint32_t));
  const Buffer entryReservoirs = g.buffer("entry_reservoirs", entries.count, reservoirBytes);
  // Kernels of a round over space, which reads reservoirs from `from` and leaves them in `to`.
  const auto kernelsOf = [&](uint32_t round, Buffer from, Buffer to) {
    std::vector<std::byte> bytes = withRound(params, reuse, round);
    return g.kernels<rl::ReuseBuffers>(std::move(bytes), {s.surfaces.now,
                                                          s.surfaces.previous,
                                                          s.proposals,
                                                          s.shadingPoints,
                                                          s.insertions,
                                                          s.cellKeys,
                                                          s.cellPlaces,
                                                          s.cellLight,
                                                          s.cellRays,
                                                          s.changes,
                                                          radiance,
                                                          radianceFrames,
                                                          unresampled.now,
                                                          unresampled.previous,
                                                          from,
                                                          to,
                                                          pairedShifts[0],
                                                          pairedShifts[1],
                                                          pairedShifts[2],
                                                          pairedShifts[3],
                                                          outlines,
                                                          sampleFilms,
                                                          duplicates,
                                                          entryReservoirs});
  };
  const Kernels kernels = kernelsOf(0, reservoirs, history);

  if (f.isNewView) {
    kernels.pass("light_edges", sample.method + "_light_edges")
        .reads({s.surfaces.now, unresampled.previous})
        .writes({unresampled.now});
  }
  GraphPass& initial = kernels.pass("initial", sample.method + "_initial")
                           .reads({s.cellKeys, s.cellPlaces, s.cellLight})
                           .writes({reservoirs, unresampled.now})
                           .updates({s.cellRays});
  if (f.isNewView) {
    initial.reads({unresampled.now});
  } else {
    // In a still view this pass merges the history, too.
    initial.reads({unresampled.previous, history, s.changes, duplicates});
  }
  if (hasEntries) {
    // Candidates of a still view stand in the history's place.
    if (!f.isNewView) initial.updates({history});
    GraphPass& update = kernels.pass("cache_update", sample.method + "_cache_update")
                            .over(entries.count)
                            .reads({s.surfaces.now, s.insertions, s.changes})
                            .updates({s.shadingPoints, entryReservoirs});
    if (f.isNewView) {
      update.reads({reservoirs});
    } else {
      update.reads({history});
    }
  }
  if (f.isNewView && isTemporal) {
    if (reuse.reproject != 0) {
      kernels.pass("temporal", sample.method + "_temporal")
          .reads({s.surfaces.now, s.surfaces.previous, s.changes, history, duplicates})
          .updates({reservoirs});
    }
    if (hasEntries) {
      kernels.pass("cache_reuse", sample.method + "_cache_reuse")
          .reads({s.surfaces.now, s.proposals, s.shadingPoints, s.changes, entryReservoirs})
          .updates({reservoirs});
    }
  }
  if (reuse.spatialNeighbours != 0 && f.isNewView) {
    kernels.pass("outlines", sample.method + "_outlines")
        .reads({s.surfaces.now})
        .writes({outlines});
  }
  std::array<Buffer, 2> ofRounds;
  for (uint32_t k = 0; k < 2 && k + 1 < reuse.spatialRounds; ++k)
    ofRounds[k] = g.transient(lastRoundsReservoirs(k + 2), f.pixels, reservoirBytes);
  Buffer from = reservoirs;
  for (uint32_t round = 0; round < reuse.spatialRounds; ++round) {
    const bool isLast = round + 1 == reuse.spatialRounds;
    const std::string name = isLast ? "spatial" : "round_" + std::to_string(round + 1);
    const Buffer to = isLast ? history : ofRounds[round % 2];
    const Kernels inRound = kernelsOf(round, from, to);
    if (reuse.spatialNeighbours != 0) {
      inRound.pass(name + "_shift", sample.method + "_spatial_shift")
          .reads({s.surfaces.now, from, outlines})
          .writes({pairedShifts[0], pairedShifts[1], pairedShifts[2], pairedShifts[3]});
    }
    // The last round shades, too, and so runs without neighbours.
    GraphPass& merge = inRound.pass(name, sample.method + "_spatial")
                           .reads({s.surfaces.now, from, pairedShifts[0], pairedShifts[1],
                                   pairedShifts[2], pairedShifts[3]})
                           .writes({to});
    if (isLast) merge.reads({unresampled.now}).writes({radiance, radianceFrames, sampleFilms});
    from = to;
  }
  if (mapped != 0)
    kernels.pass("duplicates", sample.method + "_duplicates")
        .reads({sampleFilms})
        .writes({duplicates});
  g.shared.radiance = radiance;
  g.shared.radianceFrames = radianceFrames;
}

}  // namespace restlab

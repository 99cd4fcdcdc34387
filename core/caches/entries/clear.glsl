// Pass over entries, in every frame: clears claims and insertions.

RL_FN void kernelMain(RL_IN(uvec2) row) {
  uint entry = row.y * RL_ENTRY_ROW + row.x;
  if (entry >= gParams.entries.count) return;
  gBuffers.claims.data[entry] = 0u;
  for (uint i = 0u; i < RL_ENTRY_INSERTIONS; i = i + 1u)
    gBuffers.insertions.data[entry * RL_ENTRY_INSERTIONS + i] = 0u;
}

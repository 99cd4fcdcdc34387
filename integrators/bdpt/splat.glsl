// Sums of splats as integers (bdpt.h), which any order of threads leaves alike.

// Exponent of the greatest radiance of a light, as a float has it: the unit of sums.
RL_FN uint bdptUnitExponent() {
  uint exponent = (gBuffers.table.data[RL_BDPT_TABLE_BRIGHTEST] >> 23u) & 0xffu;
  return exponent == 0u ? 127u : min(exponent, 254u);
}

// Returns whether a value is not beyond the range.
RL_FN bool bdptSplatFits(float value, uint unitExponent) {
  uint exponent = floatBitsToUint(value) >> 23u;
  int shift = int(exponent) - int(unitExponent) + int(RL_BDPT_UNIT_BIT) - 23;
  return exponent == 0u || shift < 0 || uint(shift) / RL_BDPT_DIGIT_BITS + 3u <= RL_BDPT_DIGITS;
}

// Adds one channel that fits.
RL_FN void bdptSplatChannel(uint at, float value, uint unitExponent) {
  uint bits = floatBitsToUint(value);
  uint exponent = bits >> 23u;
  if (exponent == 0u) return;
  uint mantissa = (bits & 0x7fffffu) | 0x800000u;
  int shift = int(exponent) - int(unitExponent) + int(RL_BDPT_UNIT_BIT) - 23;
  if (shift < 0) {
    if (shift <= -24) return;
    mantissa = mantissa >> uint(-shift);
    shift = 0;
  }
  uint digit = uint(shift) / RL_BDPT_DIGIT_BITS;
  uint within = uint(shift) % RL_BDPT_DIGIT_BITS;
  uint mask = (1u << RL_BDPT_DIGIT_BITS) - 1u;
  uint low = (mantissa << within) & mask;
  uint middle = (mantissa >> (RL_BDPT_DIGIT_BITS - within)) & mask;
  uint high = mantissa >> (2u * RL_BDPT_DIGIT_BITS - within);
  if (low != 0u) RL_ATOMIC_ADD(gBuffers.splats, at + digit * 3u, low);
  if (middle != 0u) RL_ATOMIC_ADD(gBuffers.splats, at + digit * 3u + 3u, middle);
  if (high != 0u) RL_ATOMIC_ADD(gBuffers.splats, at + digit * 3u + 6u, high);
}

// Adds radiance to a pixel. Values that are not finite, or more than 2^39 times as bright as any
// light, are left out and counted.
RL_FN void bdptSplat(uint pixelIndex, RL_IN(vec3) radiance) {
  if (rlIsBlack(radiance)) return;
  uint first = pixelIndex * RL_BDPT_SPLAT_WORDS;
  uint unitExponent = bdptUnitExponent();
  bool isInRange = rlIsFinite3(radiance) && bdptSplatFits(radiance.x, unitExponent) &&
                   bdptSplatFits(radiance.y, unitExponent) &&
                   bdptSplatFits(radiance.z, unitExponent);
  if (!isInRange) {
    RL_HEALTH(RL_HEALTH_NONFINITE);
  } else {
    bdptSplatChannel(first, radiance.x, unitExponent);
    bdptSplatChannel(first + 1u, radiance.y, unitExponent);
    bdptSplatChannel(first + 2u, radiance.z, unitExponent);
  }
  RL_ATOMIC_ADD(gBuffers.splats, first + RL_BDPT_SPLAT_WORDS - 1u, 1u);
}

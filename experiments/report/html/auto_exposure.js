// Exposure by the rule of the program's previewExposure(), for an image that is on the page.

const EXPOSURE_BLOCK = 8;  // side of a block, in pixels

function isFinitePixel(data, i) {
  return Number.isFinite(data[i]) && Number.isFinite(data[i + 1]) && Number.isFinite(data[i + 2]);
}

// Returns the mean luminance of each block's finite pixels, row by row; 0: it has no light.
function blockLuminances({data, width, height}) {
  const columns = Math.ceil(width / EXPOSURE_BLOCK), rows = Math.ceil(height / EXPOSURE_BLOCK);
  const sums = new Float64Array(columns * rows), counts = new Uint32Array(columns * rows);
  for (let y = 0, i = 0; y < height; ++y) {
    const row = Math.floor(y / EXPOSURE_BLOCK) * columns;
    for (let x = 0; x < width; ++x, i += 3) {
      if (!isFinitePixel(data, i)) continue;
      const block = row + Math.floor(x / EXPOSURE_BLOCK);
      sums[block] += luminance(data[i], data[i + 1], data[i + 2]);
      ++counts[block];
    }
  }
  return sums.map((sum, block) => sum > 0 ? sum / counts[block] : 0);
}

// Returns the largest channel of each pixel; 0 for black pixels, -1 for those that are not finite.
function brightnesses({data, width, height}) {
  const found = new Float32Array(width * height);
  for (let k = 0, i = 0; k < found.length; ++k, i += 3) {
    if (!isFinitePixel(data, i)) found[k] = -1;
    else if (luminance(data[i], data[i + 1], data[i + 2]) > 0) {
      found[k] = Math.max(data[i], data[i + 1], data[i + 2]);
    }
  }
  return found;
}

// Returns the value at x, y, or the fourth largest one of the 3x3 around if that is smaller.
function withoutSpike(values, width, height, x, y) {
  let first = -1, second = -1, third = -1, fourth = -1;
  const lastX = Math.min(width - 1, x + 1), lastY = Math.min(height - 1, y + 1);
  for (let j = Math.max(0, y - 1); j <= lastY; ++j) {
    for (let i = Math.max(0, x - 1); i <= lastX; ++i) {
      const value = values[j * width + i];
      if (value > first) [first, second, third, fourth] = [value, first, second, third];
      else if (value > second) [second, third, fourth] = [value, second, third];
      else if (value > third) [third, fourth] = [value, third];
      else if (value > fourth) fourth = value;
    }
  }
  return Math.min(values[y * width + x], fourth < 0 ? 0 : fourth);
}

// Returns the factor on radiance; 1 for an image without light.
function autoExposure(image) {
  const {width, height} = image, blocks = blockLuminances(image);
  const lit = blocks.filter(value => value > 0).sort();
  if (!lit.length) return 1;
  const at = (sorted, share) => sorted[Math.floor(share * (sorted.length - 1))];
  const least = 1e-4 * at(lit, 0.5);
  const sum = lit.reduce((all, value) => all + Math.log(Math.max(value, least)), 0);
  const exposure = 0.18 / Math.exp(sum / lit.length);
  const values = brightnesses(image), bright = new Float32Array(values.length);
  const columns = Math.ceil(width / EXPOSURE_BLOCK);
  let count = 0;
  for (let y = 0; y < height; ++y) {
    const row = Math.floor(y / EXPOSURE_BLOCK) * columns;
    for (let x = 0; x < width; ++x) {
      if (values[y * width + x] < 0 || !blocks[row + Math.floor(x / EXPOSURE_BLOCK)]) continue;
      bright[count++] = withoutSpike(values, width, height, x, y);
    }
  }
  const end = at(bright.subarray(0, count).sort(), 0.99);
  return Math.min(exposure, Math.max(0.25 * exposure, 1 / end));
}

// Returns the image that sets the exposure: the reference, else the first one; null without pixels.
function exposureSource(images) {
  const reference = images.find(image => image.role === 'reference' && image.data);
  return reference || images.find(image => image.data) || null;
}

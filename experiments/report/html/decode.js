// Decodes the pixels of a report: base64 of a zlib stream of twelve planes of one byte per pixel;
// the bytes of R from the most to the least significant one, then those of G, then of B. Lossless:
// every bit of every 32-bit float is restored.

function bytesOfBase64(text) {
  const binary = atob(text.trim());
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

async function inflate(bytes) {
  if (typeof DecompressionStream === 'undefined') {
    throw new Error('this browser cannot unpack them (DecompressionStream: browsers since 2023)');
  }
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// Returns R, G, B of `count` pixels, interleaved.
async function decodePixels(text, count) {
  const planes = await inflate(bytesOfBase64(text));
  if (planes.length !== 12 * count) throw new Error('their data are damaged');
  const words = new Uint32Array(3 * count);
  for (let c = 0; c < 3; ++c) {
    const first = 4 * c * count;
    for (let i = 0; i < count; ++i) {
      const at = first + i;
      words[3 * i + c] = (planes[at] << 24 | planes[at + count] << 16 |
                          planes[at + 2 * count] << 8 | planes[at + 3 * count]) >>> 0;
    }
  }
  return new Float32Array(words.buffer);
}

// Returns the indices of pixels with a NaN or an infinity.
function nonfinitePixels(data) {
  const found = [];
  for (let i = 0; i < data.length; i += 3) {
    if (!Number.isFinite(data[i] + data[i + 1] + data[i + 2]) &&
        !(Number.isFinite(data[i]) && Number.isFinite(data[i + 1]) &&
          Number.isFinite(data[i + 2]))) {
      found.push(i / 3);
    }
  }
  return found;
}

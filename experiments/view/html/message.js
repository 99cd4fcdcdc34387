// Decodes images from the program (image_message.h): a header of 32 bytes, then R, G, B of each
// pixel as floats or halves.

const IMAGE_HEAD_BYTES = 32;

// The value of each of the 65536 halves.
const HALVES = (() => {
  const values = new Float32Array(65536);
  for (let i = 0; i < 65536; ++i) {
    const exponent = i >> 10 & 31, fraction = i & 1023, sign = i >> 15 ? -1 : 1;
    values[i] = exponent === 0 ? sign * fraction * 2 ** -24
        : exponent < 31 ? sign * (1 + fraction / 1024) * 2 ** (exponent - 15)
        : fraction ? NaN : sign * Infinity;
  }
  return values;
})();

// Returns {slot, isHalf, width, height, frame, epoch, bytes}. Throws if `bytes` is not an image.
function readImageHead(bytes) {
  const view = new DataView(bytes);
  const isImage = bytes.byteLength >= IMAGE_HEAD_BYTES && view.getUint32(0, true) === 0x31494c52;
  if (!isImage) throw new Error('the program sent what is no image');
  const word = at => view.getUint32(at, true);
  const head = {slot: word(4), isHalf: word(8) === 1, width: word(12), height: word(16),
                frame: word(20), epoch: Number(view.getBigUint64(24, true)), bytes};
  const size = 3 * head.width * head.height * (head.isHalf ? 2 : 4);
  if (bytes.byteLength !== IMAGE_HEAD_BYTES + size) {
    throw new Error('the program sent an image that is cut off');
  }
  return head;
}

// Returns the pixels of a message. Reuses `room` if it has the right size.
function readPixels(head, room) {
  const count = 3 * head.width * head.height;
  const data = room && room.length === count ? room : new Float32Array(count);
  if (!head.isHalf) {
    data.set(new Float32Array(head.bytes, IMAGE_HEAD_BYTES, count));
    return data;
  }
  const halves = new Uint16Array(head.bytes, IMAGE_HEAD_BYTES, count);
  for (let i = 0; i < count; ++i) data[i] = HALVES[halves[i]];
  return data;
}

// Single channels of a picture: grey pictures of R, G, B or the luminance.

const CHANNELS = {
  rgb: {name: 'RGB', title: 'all channels', of: null},
  r: {name: 'R', title: 'red', of: (r, g, b) => r},
  g: {name: 'G', title: 'green', of: (r, g, b) => g},
  b: {name: 'B', title: 'blue', of: (r, g, b) => b},
  y: {name: 'Y', title: 'luminance', of: luminance}
};
const CHANNEL_ORDER = Object.keys(CHANNELS);

// Returns an image whose three channels hold the chosen one. A pixel that is not finite stays as it
// is, so that it is marked as in colour. `held`: an old result, which is used again.
function channelImage(image, channel, held) {
  const {data, width, height, nonfinite} = image, {of} = CHANNELS[channel];
  const grey = held && held.data.length === data.length ? held
                                                        : {data: new Float32Array(data.length)};
  for (let i = 0; i < data.length; i += 3) {
    const value = of(data[i], data[i + 1], data[i + 2]);
    grey.data[i] = grey.data[i + 1] = grey.data[i + 2] = value;
  }
  for (const k of nonfinite) grey.data.set(data.subarray(3 * k, 3 * k + 3), 3 * k);
  return Object.assign(grey, {width, height, nonfinite, version: `${channel} ${versionOf(image)}`});
}

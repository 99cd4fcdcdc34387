// Words in PNG files: chunks tEXt, or iTXt for what is not ASCII, as the program writes them.

const PNG_HEAD_BYTES = 33;  // the signature and IHDR

const CRC_TABLE = Int32Array.from({length: 256}, (_, byte) => {
  let crc = byte;
  for (let bit = 0; bit < 8; ++bit) crc = crc & 1 ? crc >>> 1 ^ 0xedb88320 : crc >>> 1;
  return crc;
});

// CRC-32 of ISO 3309.
function crc32(bytes) {
  let crc = -1;
  for (const byte of bytes) crc = CRC_TABLE[(crc ^ byte) & 255] ^ crc >>> 8;
  return ~crc >>> 0;
}

// Returns one chunk: length, type, content, CRC of type and content.
function pngChunk(type, content) {
  const chunk = new Uint8Array(12 + content.length), view = new DataView(chunk.buffer);
  view.setUint32(0, content.length);
  chunk.set(new TextEncoder().encode(type), 4);
  chunk.set(content, 8);
  view.setUint32(8 + content.length, crc32(chunk.subarray(4, 8 + content.length)));
  return chunk;
}

// `key`: 1 to 79 ASCII characters.
function wordChunk(key, text) {
  const isAscii = /^[\x20-\x7e\n]*$/.test(text);
  // A keyword; of iTXt: no compression, no language, no translated keyword.
  return pngChunk(isAscii ? 'tEXt' : 'iTXt',
                  new TextEncoder().encode(`${key}\0${isAscii ? '' : '\0\0\0\0'}${text}`));
}

// Returns the PNG with the words {key: text} behind its head.
async function pngWithWords(blob, words) {
  const bytes = new Uint8Array(await blob.arrayBuffer());
  const chunks = Object.entries(words).map(([key, text]) => wordChunk(key, String(text)));
  return new Blob([bytes.subarray(0, PNG_HEAD_BYTES), ...chunks, bytes.subarray(PNG_HEAD_BYTES)],
                  {type: 'image/png'});
}

// Returns the words of a picture of the page; keys are those of `--capture`. The address is only
// what stands behind its #: the rest holds a secret.
function pictureWords(page) {
  const {viewer, hello, state} = page, {images, painter} = viewer, view = viewer.state;
  const panes = (hello.has_scene ? state.panes : []).map((pane, i) => {
    if (pane.source) return {source: pane.source};
    const parameters = pane.parameters.map(({name, value}) => [`parameter.${name}`, value]);
    return {...Object.fromEntries(hello.settings.map(key => [key, pane[key]])),
            ...Object.fromEntries(parameters), seed: pane.seed, frame: (images[i].frame || 1) - 1};
  });
  const words = {
    program: 'restlab', kind: 'screenshot', utc: new Date().toISOString(), version: hello.version,
    scene: hello.scene.name, width: state.width, height: state.height,
    ...Object.fromEntries(state.transport.map(({name, value}) => [name, value])),
    images: images.map(image => image.name).join(', '),
    view: viewer.describe(), compared_with: images[view.compare].name, error: view.error,
    exposure: Number(painter.factor.toPrecision(6)),
    exposure_stops: Number(Math.log2(painter.factor).toFixed(4)), channel: view.channel,
    zoom: Number(viewer.camera.scale.toPrecision(6))
  };
  panes.forEach((pane, i) => Object.entries(pane).forEach(([key, value]) => {
    const isCommon = panes.every(other => other[key] === value);
    words[isCommon ? key : `${PANE_NAMES[i]}.${key}`] = value;
  }));
  const reference = images.find(image => image.role === 'reference' && image.data);
  if (reference && reference.frame) words.reference_spp = reference.frame;
  if (view.rectangle) words.crop = cropOptions(viewer, view.rectangle);
  page.link();
  words.address = location.hash;
  return words;
}

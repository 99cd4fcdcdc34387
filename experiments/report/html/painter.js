// Pictures and numbers of a view: images by exposure, errors by a common range. Everything is
// cached until an image has a new version; moving, zooming or wiping recolours nothing.
class Painter {
  constructor(state, images, exposure) {
    Object.assign(this, {state, images, exposure});
    this.cache = new SlotCache();
    this.planes = new SlotCache();
    this.range = new SteadyRange();
    this.overlays = new Map();
    this.rest = new RestMaps(images);
    // Called when pictures must be drawn again because the WebGL context was lost.
    this.onLost = () => {};
  }

  // Drops everything that was made of the images; called for other images.
  forget() {
    this.cache.clear();
    this.planes.clear();
    this.range = new SteadyRange();
    this.overlays.clear();
  }

  // Factor on radiance.
  get factor() { return this.exposure * Math.pow(2, this.state.stops); }

  // `kind`: 'webgl2', '2d' or 'auto' (WebGL2 if there is a GPU). Returns the kind that is used:
  // there may be no WebGL2.
  use(kind) {
    this.gl = kind === '2d' ? null : glColours(kind === 'auto');
    if (this.gl) this.gl.canvas.addEventListener('webglcontextlost', () => this.onLost());
    return this.kind;
  }

  get kind() {
    if (this.gl === undefined) this.use('auto');
    return this.gl && !this.gl.isLost ? 'webgl2' : '2d';
  }

  // Error of image i against the compared one; null while they cannot be compared, or while there
  // is no map of a kind that is computed at rest.
  plane(kind, i) {
    const image = this.images[i], other = this.images[this.state.compare];
    if (!areComparable(image, other)) return null;
    if (isRestError(kind)) return this.rest.map(kind, i, this.state.compare);
    const key = `${this.state.compare} ${versionOf(image)} ${versionOf(other)}`;
    return this.planes.get(`${kind} ${i}`, key, held => errorPlane(
                               kind, image.data, other.data, held && held.values));
  }

  // One scale for all images, to compare them; a brighter exposure narrows the range.
  errorScale() {
    const {error, compare, stops} = this.state, isRest = isRestError(error);
    const versions = isRest ? this.rest.made : this.images.map(versionOf).join(' ');
    // Few maps are made at rest: each new one has the range of its numbers.
    const subject = `${error} ${compare} ${isRest ? versions : ''}`;
    const range = this.range.get(subject, versions, () => {
      const planes = this.images.map((_, i) => i === compare ? null : this.plane(error, i));
      return commonSize(planes.filter(plane => plane).map(plane => plane.values),
                        ERRORS[error].isLikeness ? 1 : 0);
    });
    return errorScale(error, range * Math.pow(2, -stops), this.isLog());
  }

  isLog() {
    const {error, log} = this.state;
    return canBeLog(error) && (error in log ? log[error] : ERRORS[error].log);
  }

  // Twelve stops of luminance; the sRGB view's mid grey is near the middle.
  luminanceScale() {
    return makeScale(Math.pow(2, -8) / this.factor, Math.pow(2, 4) / this.factor, true,
                     MAPS.spectrum);
  }

  get encoder() {
    if (this.encoderFactor !== this.factor) {
      this.encoderFactor = this.factor;
      this.srgbEncoder = new SrgbEncoder(this.factor);
    }
    return this.srgbEncoder;
  }

  // Returns image i, or the grey image of the chosen channel. Requires its data.
  channelOf(i) {
    const image = this.images[i], {channel} = this.state;
    if (channel === 'rgb') return image;
    return this.planes.get(`channel ${i}`, `${channel} ${versionOf(image)}`,
                           held => channelImage(image, channel, held));
  }

  // Returns a canvas of the image's size, or null while there is nothing to show.
  layer(view) {
    if (!this.images[view.image].data) return null;
    if (this.isErrorShown(view)) return this.errorLayer(view.image);
    const image = this.channelOf(view.image);
    const key = `${this.kind} ${versionOf(image)} ${this.state.tone} ${this.factor}`;
    return this.cache.get(`image ${view.image}`, key, held => {
      if (this.state.tone === 'false') {
        const scale = this.luminanceScale();
        return this.glLayer({kind: 'luminance', image, scale}, held) ||
            falseColourLayer(image, scale, held);
      }
      return this.glLayer({kind: 'srgb', image, factor: this.factor}, held) ||
          srgbLayer(image, this.encoder, held);
    });
  }

  // False if a view shows the picture, since its map is still to be computed.
  isErrorShown(view) {
    const {error} = this.state;
    return view.isError && !(isRestError(error) && !this.plane(error, view.image));
  }

  errorLayer(i) {
    const {error, compare} = this.state, image = this.images[i], reference = this.images[compare];
    const plane = this.plane(error, i);
    if (!plane) return null;
    const scale = this.errorScale();
    const version = plane.serial ? `map ${plane.serial}`
                                 : `${versionOf(image)} ${versionOf(reference)}`;
    const key = `${this.kind} ${error} ${compare} ${version} ${scale.hi} ${scale.log}`;
    return this.cache.get(`error ${i}`, key, held => {
      const made = plane.serial ? null : this.glLayer({kind: error, image, reference, scale}, held);
      return made || scaledLayer(image, plane.values, scale, held);
    });
  }

  glLayer(job, held) { return this.kind === 'webgl2' ? this.gl.layer(job, held) : null; }

  // Returns the overlay of image i, {kind, values, range, scale}, or null (overlay_colours.js).
  // Numbers have a scale of their own, symmetric about zero if there are negative values, and as
  // steady as the errors' scale; the range of vectors is steady, too.
  overlay(i) {
    const image = this.images[i], {overlay} = image;
    if (!overlay || !overlay.data) return null;
    const version = versionOf(overlay), isWhole = overlay.data.length ===
        3 * image.width * image.height;
    const kind = isWhole && overlay.kind || 'number';
    if (kind === 'name' || kind === 'colour' || kind === 'radiance') {
      return {kind, values: overlay.data, range: 1, scale: null};
    }
    const size = `${image.width} ${image.height}`;
    let held = this.overlays.get(i);
    if (!held || held.name !== overlay.name) {
      held = {name: overlay.name, isSigned: false, range: new SteadyRange()};
      this.overlays.set(i, held);
    }
    if (kind !== 'number') {
      const components = kind === 'vector2' ? 2 : 3;
      const steady = held.range.get(overlay.name, version, () => commonSize(
                                        [vectorValues(overlay.data, components)]));
      return {kind, components, values: overlay.data, range: steady, scale: null};
    }
    const values = this.planes.get(`overlay ${i}`, `${overlay.name} ${version} ${size}`,
                                   () => overlayValues(image));
    if (!values) return null;
    if (held.version !== version) {
      held.version = version;
      held.isSigned = held.isSigned || values.some(value => value < 0);
    }
    const range = held.range.get(overlay.name, version, () => commonSize([values]));
    const scale = held.isSigned ? makeScale(-range, range, false, MAPS.diverging)
                                : makeScale(0, range, false, MAPS.rising);
    return {kind, values, range, scale};
  }

  // Explains the colours of an overlay without a scale.
  overlayText(i) {
    const found = this.overlay(i);
    return found && found.kind in OVERLAY_TEXTS
        ? OVERLAY_TEXTS[found.kind](this.images[i].overlay, found.range, this.factor) : '';
  }

  overlayScale(i) {
    const overlay = this.overlay(i);
    return overlay && overlay.scale;
  }

  // Returns a canvas of the image's size to draw over its layer, or null.
  overlayLayer(view) {
    const overlay = this.overlay(view.image);
    if (!overlay) return null;
    const image = this.images[view.image], {kind, values, range, scale, components} = overlay;
    const factor = kind === 'radiance' ? this.factor : 1;
    const key = `${image.overlay.name} ${versionOf(image.overlay)} ${kind} ${factor} ${range} ${
        scale && scale.lo}`;
    return this.cache.get(`overlay ${view.image}`, key, held => {
      if (scale) return scaledLayer(image, values, scale, held);
      return paintedCanvas(image.width, image.height, held, out => {
        if (kind === 'name') fillNames(values, out);
        else if (components) fillVectors(values, components, range, out);
        else (kind === 'radiance' ? this.encoder : new SrgbEncoder(1)).fill(values, out);
      });
    });
  }

  // Returns the numbers of a pixel in the layer over image i, as texts.
  overlayTexts(i, pixel) {
    const found = this.overlay(i);
    if (!found) return [];
    const {kind, values, components = 3} = found, isOne = kind === 'number' || kind === 'name';
    const n = values.length === 3 * this.images[i].width * this.images[i].height ? 3 : 1;
    const at = n * pixel;
    return Array.from(values.subarray(at, at + (isOne ? 1 : components)), shortNumber);
  }

  // True if the layer over an image is seen rather than the image.
  showsOverlay(view) { return this.state.opacity >= 0.5 && Boolean(this.overlay(view.image)); }

  // Returns the numbers of a pixel, of what its colour shows.
  texts(view, i) {
    const {data} = this.images[view.image];
    if (!data) return [];
    if (this.showsOverlay(view)) return this.overlayTexts(view.image, i);
    if (!this.isErrorShown(view)) {
      const isOne = this.state.channel !== 'rgb';
      return Array.from(this.channelOf(view.image).data.subarray(3 * i, 3 * i + (isOne ? 1 : 3)),
                        shortNumber);
    }
    const plane = this.plane(this.state.error, view.image);
    return plane ? [shortNumber(plane.values[i])] : [];
  }

  // True if the picture of a pixel is light. Computed, since reading the canvas back stalls the
  // browser.
  isLight(view, i) {
    const word = this.pixelColour(view, i);
    return 0.3 * (word & 255) + 0.59 * (word >> 8 & 255) + 0.11 * (word >> 16 & 255) > 140;
  }

  pixelColour(view, i) {
    if (!this.images[view.image].data) return 0;
    if (this.showsOverlay(view)) {
      const {values, scale} = this.overlay(view.image);
      if (scale) return scaledColour(values[i], scale);
    }
    if (this.isErrorShown(view)) {
      const plane = this.plane(this.state.error, view.image);
      return plane ? scaledColour(plane.values[i], this.errorScale()) : 0;
    }
    const {data} = this.channelOf(view.image);
    const rgb = data.subarray(3 * i, 3 * i + 3);
    if (!rgb.every(Number.isFinite)) return nonfiniteColour(data, i);
    if (this.state.tone === 'false') return scaledColour(luminance(...rgb), this.luminanceScale());
    return this.encoder.colour(bitsOf(rgb), 0);
  }
}

// Which picture and which numbers a view shows: images by exposure, errors by a common range.
class Painter {
  constructor(state, images, exposure) {
    Object.assign(this, {state, images, exposure});
    this.cache = new LayerCache();
    this.planes = new Map();
    this.ranges = new Map();
  }

  // Factor on radiance.
  get factor() { return this.exposure * Math.pow(2, this.state.stops); }

  // Error of image i against the one that is compared with; made once.
  plane(kind, i) {
    const key = `${kind} ${i} ${this.state.compare}`;
    if (!this.planes.has(key)) {
      const other = this.images[this.state.compare].data;
      this.planes.set(key, errorPlane(kind, this.images[i].data, other));
    }
    return this.planes.get(key);
  }

  // One scale for all images, so that they can be compared; brighter exposure, narrower range.
  errorScale() {
    const {error, compare, stops} = this.state;
    const key = `${error} ${compare}`;
    if (!this.ranges.has(key)) {
      const others = this.images.map((_, i) => i).filter(i => i !== compare);
      this.ranges.set(key, commonRange(others.map(i => this.plane(error, i))));
    }
    const range = this.ranges.get(key) * Math.pow(2, -stops);
    return errorScale(error, range, this.isLog());
  }

  isLog() {
    const {error, log} = this.state;
    return error in log ? log[error] : ERRORS[error].log;
  }

  // Twelve stops of luminance; mid grey of the sRGB view is near the middle.
  luminanceScale() {
    return makeScale(Math.pow(2, -8) / this.factor, Math.pow(2, 4) / this.factor, true,
                     MAPS.spectrum);
  }

  layer(view) {
    const image = this.images[view.image], {state} = this;
    if (view.isError) {
      const scale = this.errorScale();
      const key = `${state.error} ${state.compare} ${scale.hi} ${scale.log}`;
      return this.cache.get(`error ${view.image}`, key,
                            () => errorLayer(image, this.plane(state.error, view.image), scale));
    }
    return this.cache.get(`image ${view.image}`, `${state.tone} ${this.factor}`, () => {
      if (state.tone === 'false') return falseColourLayer(image, this.luminanceScale());
      return srgbLayer(image, this.factor);
    });
  }

  texts(view, i) {
    if (view.isError) return [shortNumber(this.plane(this.state.error, view.image).values[i])];
    return Array.from(this.images[view.image].data.subarray(3 * i, 3 * i + 3), shortNumber);
  }

  isLight(view, i) {
    const [r, g, b] = this.layer(view).bytes.subarray(4 * i, 4 * i + 3);
    return 0.3 * r + 0.59 * g + 0.11 * b > 140;
  }
}

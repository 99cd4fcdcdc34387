// Visible part of the images, shared by all views of a viewer: the image position at the centre of
// a view, and CSS pixels per image pixel. Images of another size are stretched to this one.
class Camera {
  constructor(width, height) {
    this.width = width;
    this.height = height;
    this.fit();
  }

  fit() {
    this.fitted = true;
    this.x = this.width / 2;
    this.y = this.height / 2;
  }

  // Takes over another image size; keeps showing the same part.
  resize(width, height) {
    if (!this.fitted) {
      this.x *= width / this.width;
      this.y *= height / this.height;
      this.scale *= this.width / width;
    }
    Object.assign(this, {width, height});
    if (this.fitted) this.fit();
  }

  // Returns the index of a pixel in an image that may have another size.
  indexIn(image, pixel) {
    const x = Math.floor((pixel.x + 0.5) * image.width / this.width);
    const y = Math.floor((pixel.y + 0.5) * image.height / this.height);
    return y * image.width + x;
  }

  // Called for each drawing: views may have changed their size.
  adapt(viewWidth, viewHeight) {
    this.fitScale = Math.min(viewWidth / this.width, viewHeight / this.height);
    if (this.fitted) this.scale = this.fitScale;
  }

  get least() { return Math.min(this.fitScale, 1); }
  get most() { return 256; }

  // Zooms and keeps the image position at (dx, dy), CSS pixels from the centre of the view, in
  // place. Returns false if the scale is at its limit.
  zoom(factor, dx, dy) {
    const scale = Math.min(this.most, Math.max(this.least, this.scale * factor));
    if (scale === this.scale) return false;
    this.fitted = false;
    this.x += dx / this.scale - dx / scale;
    this.y += dy / this.scale - dy / scale;
    this.scale = scale;
    this.keepInside();
    return true;
  }

  pan(dx, dy) {
    this.fitted = false;
    this.x -= dx / this.scale;
    this.y -= dy / this.scale;
    this.keepInside();
  }

  keepInside() {
    this.x = Math.min(this.width, Math.max(0, this.x));
    this.y = Math.min(this.height, Math.max(0, this.y));
  }

  // View position (CSS pixels) of an image position, and the inverse.
  toView(view, x, y) {
    return [view.x + view.width / 2 + (x - this.x) * this.scale,
            view.y + view.height / 2 + (y - this.y) * this.scale];
  }
  toImage(view, x, y) {
    return [this.x + (x - view.x - view.width / 2) / this.scale,
            this.y + (y - view.y - view.height / 2) / this.scale];
  }
}

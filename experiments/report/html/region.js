// Errors of a rectangle of an image.

// Returns {mse, relmse} of the pixels of a rectangle [x, y, width, height] of two images that can
// be compared. Both are the program's: the means of d^2 (`mse`) and of d^2 / (r^2 + 0.01)
// (`relmse_e1e-2`); NaN if a value there is not finite.
function regionErrors(image, reference, [x, y, width, height]) {
  const a = image.data, r = reference.data;
  let mse = 0, relmse = 0;
  for (let row = y; row < y + height; ++row) {
    const first = 3 * (row * image.width + x);
    for (let i = first; i < first + 3 * width; ++i) {
      const square = (a[i] - r[i]) ** 2;
      mse += square;
      relmse += square / (r[i] * r[i] + 1e-2);
    }
  }
  const count = 3 * width * height;
  const mean = sum => Number.isFinite(mse) && Number.isFinite(relmse) ? sum / count : NaN;
  return {mse: mean(mse), relmse: mean(relmse)};
}

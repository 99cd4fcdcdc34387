// Bilinear reads of histories, between four pixels.

// Share of the bilinear weights at a film position that lies on pixels of the image; 0 if the
// position itself is out of view. A history at the border counts for that share of its frames: it
// comes from one side alone, and content that enters by less than a pixel per frame would otherwise
// keep it for ever.
RL_FN float betweenShareInView(RL_IN(vec2) film) {
  if (!filmIsInView(film)) return 0.0f;
  float x = min(min(film.x, float(gFrame.width) - film.x), 0.5f);
  float y = min(min(film.y, float(gFrame.height) - film.y), 0.5f);
  return (0.5f + x) * (0.5f + y);
}

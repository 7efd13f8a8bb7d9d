// Seeing through a surface without an order of drawing: pixels are left out in all surfaces alike, so that what they
// hide is seen between them. A pixel in sixteen for each step, evenly spread (ordered dithering).
const float kThresholds[16] = float[16](0.0, 8.0, 2.0, 10.0, 12.0, 4.0, 14.0, 6.0, 3.0, 11.0, 1.0, 9.0, 15.0, 7.0, 13.0, 5.0);

bool left_out(float opacity) {
  ivec2 place = ivec2(gl_FragCoord.xy) & 3;
  return kThresholds[4 * place.y + place.x] + 0.5 > 16.0 * opacity;
}

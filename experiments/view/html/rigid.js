// Pose of a camera: a position, a yaw about the vertical and a pitch about the camera's right, in
// radians, without a roll. A camera looks along -Z, +Y is up; matrices are column-major.

const MOST_PITCH = 89 * Math.PI / 180;
const clampPitch = pitch => Math.min(MOST_PITCH, Math.max(-MOST_PITCH, pitch));

const plus = (a, b, factor = 1) => a.map((value, i) => value + factor * b[i]);
const distance = (a, b) => Math.hypot(...a.map((value, i) => value - b[i]));

function poseOf(m) {
  return {position: [m[12], m[13], m[14]], yaw: Math.atan2(m[8], m[10]),
          pitch: clampPitch(Math.asin(Math.min(1, Math.max(-1, -m[9]))))};
}

function axesOf({yaw, pitch}) {
  const [s, c, sp, cp] = [Math.sin(yaw), Math.cos(yaw), Math.sin(pitch), Math.cos(pitch)];
  return {right: [c, 0, -s], up: [s * sp, cp, c * sp], forward: [-s * cp, sp, -c * cp]};
}

function matrixOf(pose) {
  const {right, up, forward} = axesOf(pose);
  return [...right, 0, ...up, 0, ...forward.map(value => -value), 0, ...pose.position, 1];
}

// Turns the pose rigidly around the point `target`: by `turn` about the vertical through the
// target, then by `tilt` about the camera's right.
function orbited(pose, target, turn, tilt) {
  const pitch = clampPitch(pose.pitch + tilt);
  const axes = axesOf(pose), offset = plus(pose.position, target, -1);
  // Keep the target's position in the camera's own axes.
  const own = ['right', 'up', 'forward'].map(
      name => offset.reduce((sum, value, i) => sum + value * axes[name][i], 0));
  const turned = {...pose, yaw: pose.yaw + turn, pitch};
  const next = axesOf(turned);
  const position = ['right', 'up', 'forward'].reduce(
      (sum, name, i) => plus(sum, next[name], own[i]), target);
  return {...turned, position};
}

// Returns the direction of the ray through an image position; (0, 0) is the centre, (1, 1) the top
// right.
function rayThrough(pose, yfov, aspect, x, y) {
  const {right, up, forward} = axesOf(pose), t = Math.tan(yfov / 2);
  const way = plus(plus(forward, right, x * t * aspect), up, y * t);
  const length = Math.hypot(...way);
  return way.map(value => value / length);
}

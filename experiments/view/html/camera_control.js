// Moves the camera of the scene by hand: camera mode (fly with keys, look with the pointer) and
// orbits.

const FIRST_STEP_MS = 16;
const WHEEL_STEP = 1.2, FAST = 4, TURN_KEYS_SPEED = 1.2;  // radians a second

class CameraControl {
  constructor(page, bounds) {
    Object.assign(this, {page, isOn: false, isOrbit: false, held: new Set(), pose: null,
                         dragging: false, side: 1});
    const {lo, hi} = bounds;
    this.centre = lo.map((value, i) => (value + hi[i]) / 2);
    this.size = Math.max(1e-3, distance(lo, hi));
    this.speed = this.size / 8;  // metres a second
  }

  // Takes the camera from the program's state, unless a hand is moving it: the hand's pose is
  // newer.
  show({to_world, yfov, mirrored}) {
    this.yfov = yfov;
    this.side = mirrored ? -1 : 1;  // +1, or -1 if the picture is mirrored
    this.matrix = to_world;
    if (!this.isMoving && !this.isWaiting) this.pose = poseOf(to_world);
  }

  now() { return {to_world: this.matrix, yfov: this.yfov}; }

  get isMoving() { return this.held.size > 0 || this.dragging; }
  get isWaiting() { return this.page.session.waiting.has('camera'); }

  setMode(isOn) {
    this.isOn = isOn;
    if (!isOn) this.held.clear();
    this.page.showCameraMode();
  }

  setOrbit(isOrbit) {
    this.isOrbit = isOrbit;
    this.held.clear();
    this.page.showCameraMode();
  }

  moveTo(pose) {
    this.pose = pose;
    this.matrix = matrixOf(pose);
    const command = {do: 'camera', to_world: this.matrix};
    if (this.yfov) command.yfov = this.yfov;
    this.page.session.sendNewest('camera', command);
    this.page.recorder.note(this.pose, this.yfov, this.targetOf(pose));
  }

  // Looks upright from a position towards a target.
  lookFrom(position, target, yfov = this.yfov) {
    this.yfov = yfov;
    const [x, y, z] = plus(target, position, -1);
    this.moveTo({position, yaw: Math.atan2(-x, -z),
                 pitch: clampPitch(Math.atan2(y, Math.hypot(x, z)))});
  }

  // Returns a point straight ahead, as far away as the scene's centre.
  targetOf(pose) {
    return plus(pose.position, axesOf(pose).forward, this.reach(pose));
  }
  reach(pose) { return Math.max(0.02 * this.size, distance(pose.position, this.centre)); }

  // `way`: forward, back, left, right, up, down or turns.
  hold(way) {
    this.held.add(way);
    if (this.isFlying) return;
    this.orbitCentre = this.targetOf(this.pose);
    this.isFlying = true;
    // The first step is taken at once: a key is answered without waiting for a frame.
    const now = performance.now();
    this.last = now - FIRST_STEP_MS;
    this.fly(now);
  }

  release(way) { this.held.delete(way); }

  fly(time) {
    if (!this.held.size) {
      this.isFlying = false;
      return;
    }
    const seconds = Math.min(0.1, Math.max(0, (time - this.last) / 1000));
    this.last = time;
    const of = (plusWay, minusWay) => this.held.has(plusWay) - this.held.has(minusWay);
    const turn = TURN_KEYS_SPEED * seconds * this.side * of('turn-left', 'turn-right');
    const tilt = TURN_KEYS_SPEED * seconds * of('turn-up', 'turn-down');
    requestAnimationFrame(next => this.fly(next));
    if (this.isOrbit && !this.isOn) {
      this.moveTo(orbited(this.pose, this.orbitCentre, turn, tilt));
      return;
    }
    const step = this.speed * seconds * (this.isFast ? FAST : 1);
    const {right, forward} = axesOf(this.pose);
    let position = plus(this.pose.position, forward, step * of('forward', 'back'));
    position = plus(position, right, step * this.side * of('right', 'left'));
    position = plus(position, [0, 1, 0], step * of('up', 'down'));
    this.moveTo({position, yaw: this.pose.yaw + turn, pitch: clampPitch(this.pose.pitch + tilt)});
  }

  // Begins a drag; called by pointer.js.
  drag(event, hit) {
    const isOrbit = event.altKey || this.isOrbit;
    if (!isOrbit && !this.isOn) return null;
    if (!this.pose) return null;
    // Radians per CSS pixel at the centre of the picture.
    const scale = (this.yfov || 0.8) / (this.page.state.height * this.page.viewer.camera.scale);
    const sideways = scale * this.side, round = 0.008 * this.side;
    const target = isOrbit ? this.orbitTarget(hit, event.altKey && hit && hit.pixel) : null;
    this.dragging = true;
    const end = () => {
      this.dragging = false;
      for (const name of ['pointerup', 'pointercancel']) document.removeEventListener(name, end);
    };
    for (const name of ['pointerup', 'pointercancel']) document.addEventListener(name, end);
    if (isOrbit) {
      return {move: (dx, dy) => this.moveTo(orbited(this.pose, target, -round * dx, -0.008 * dy))};
    }
    return {move: (dx, dy) => this.moveTo({...this.pose, yaw: this.pose.yaw - sideways * dx,
                                           pitch: clampPitch(this.pose.pitch - scale * dy)})};
  }

  // Returns the point under the pointer at the distance of the scene's centre, or else the point
  // straight ahead.
  orbitTarget(hit, isUnderPointer) {
    if (!isUnderPointer) return this.targetOf(this.pose);
    const {width, height} = this.page.state;
    const x = this.side * (2 * (hit.pixel.x + 0.5) / width - 1);
    const y = 1 - 2 * (hit.pixel.y + 0.5) / height;
    const way = rayThrough(this.pose, this.yfov || 0.8, width / height, x, y);
    return plus(this.pose.position, way, this.reach(this.pose));
  }

  wheel(event) {
    if (!this.isOn || event.ctrlKey) return false;
    this.changeSpeed(event.deltaY < 0 ? 1 : -1);
    return true;
  }

  changeSpeed(steps) {
    const speed = this.speed * WHEEL_STEP ** steps;
    this.speed = Math.min(100 * this.size, Math.max(1e-4 * this.size, speed));
    this.page.showCameraMode();
  }

  click(hit) {
    if (!this.isOn && !this.isOrbit && hit && hit.pixel) this.page.probeAt(hit.pixel);
  }

  describe() {
    if (this.isOn) {
      return `camera mode: W A S D Q E fly, drag or arrows look, wheel: ${
          quantity(this.speed, 2)} m/s, Shift is faster; c or Escape leaves it`;
    }
    if (!this.isOrbit) return '';
    return 'orbit: drag or arrows turn about the point ahead; o or Escape leaves it';
  }
}

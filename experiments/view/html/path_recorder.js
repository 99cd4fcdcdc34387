// Records the camera's path as keyframes, plays it back and writes it for a suite.

const KEYFRAME_SECONDS = 0.2;

// Four decimals: a tenth of a millimetre.
const tomlNumber = value => {
  const text = String(Number(value.toFixed(4)));
  return /[.e]/.test(text) ? text : `${text}.0`;
};
const tomlPoint = point => `[${point.map(tomlNumber).join(', ')}]`;

// Returns a [[camera_path]] of a suite. Frames must increase: if several keyframes fall into one
// frame, the last one stays.
function cameraPathToml(name, keyframes, framesPerSecond) {
  const byFrame = new Map();
  for (const key of keyframes) byFrame.set(Math.round(key.seconds * framesPerSecond), key);
  const lines = ['[[camera_path]]', `name = ${JSON.stringify(name)}`, 'kind = "keyframes"'];
  for (const [frame, {position, target, yfov}] of byFrame) {
    lines.push('', '[[camera_path.keyframe]]', `frame = ${frame}`,
               `position = ${tomlPoint(position)}`, `target = ${tomlPoint(target)}`);
    if (yfov) lines.push(`yfov_degrees = ${tomlNumber(yfov * 180 / Math.PI)}`);
  }
  return `${lines.join('\n')}\n`;
}

class PathRecorder {
  constructor(page) {
    Object.assign(this, {page, keyframes: [], isRecording: false, playing: null});
    this.record = makeButton('record', commandTitle('record', page.commands), () => this.toggle());
    this.play = makeButton('play', commandTitle('play', page.commands), () => this.playBack());
    this.rate = make('input', {type: 'number', min: 1, max: 240, value: 30,
                               'aria-label': 'frames of the path a second'});
    this.name = make('input', {type: 'text', value: 'recorded', size: 9,
                                  'aria-label': 'name of the path'});
    this.text = make('textarea', {rows: 4, readonly: '', spellcheck: 'false',
                                  'aria-label': 'the path as part of a suite'});
    const save = makeButton('save TOML', 'save the path as part of a suite',
                            () => downloadText(`${this.name.value || 'path'}.toml`, this.toml()));
    const copy = copyButton(() => this.toml(), 'copy the path as part of a suite',
                            text => page.messages.notice(text));
    for (const input of [this.rate, this.name]) {
      input.addEventListener('input', () => this.show());
    }
    this.written = make('div', {}, this.text, make('div', {class: 'line packed'}, save, copy));
    this.state = make('p', {class: 'hint', role: 'status'});
    this.element = make('fieldset', {}, make('legend', {}, 'path of the camera'),
                        make('div', {class: 'line packed'}, this.record, this.play, this.name,
                             this.rate, 'frames/s'), this.state, this.written);
    this.show();
  }

  toml() {
    return cameraPathToml(this.name.value || 'recorded', this.keyframes,
                          Math.max(1, Number(this.rate.value) || 30));
  }

  toggle() {
    this.isRecording = !this.isRecording;
    this.playing = null;
    if (this.isRecording) {
      this.keyframes = [];
      this.began = performance.now();
      const {camera} = this.page;
      this.note(camera.pose, camera.yfov, camera.targetOf(camera.pose), true);
    } else if (this.last) {
      this.keyframes.push(this.last);
    }
    this.last = null;
    this.show();
  }

  // Called for each move of the camera.
  note(pose, yfov, target, isFirst) {
    if (!this.isRecording) return;
    const seconds = isFirst ? 0 : (performance.now() - this.began) / 1000;
    const key = {seconds, position: pose.position, target, yfov};
    const before = this.keyframes[this.keyframes.length - 1];
    if (isFirst || seconds - before.seconds >= KEYFRAME_SECONDS) {
      this.keyframes.push(key);
      this.last = null;
      this.show();
    } else {
      this.last = key;
    }
  }

  // Plays to the end, until called again or until a hand takes the camera.
  playBack() {
    if (this.keyframes.length < 2 || this.isRecording) return;
    const began = performance.now(), {keyframes, page} = this, last = keyframes.length - 1;
    const isPlayed = this.playing !== null, run = this.playing = isPlayed ? null : {};
    this.show();
    const step = () => {
      if (this.playing !== run) return;
      const at = (performance.now() - began) / 1000;
      const next = keyframes.findIndex(key => key.seconds >= at);
      const b = keyframes[next < 0 ? last : next], a = keyframes[next < 0 ? last : Math.max(0, next - 1)];
      const share = b === a ? 0 : (at - a.seconds) / (b.seconds - a.seconds);
      const between = (from, to) => plus(from, plus(to, from, -1), share);
      const isTaken = page.camera.isMoving;
      if (!isTaken) {
        page.camera.lookFrom(between(a.position, b.position), between(a.target, b.target),
                             a.yfov && b.yfov ? a.yfov + share * (b.yfov - a.yfov) : undefined);
      }
      if (next >= 0 && !isTaken) {
        requestAnimationFrame(step);
        return;
      }
      this.playing = null;
      this.show();
    };
    if (run) requestAnimationFrame(step);
  }

  show() {
    const n = this.keyframes.length;
    this.record.setAttribute('aria-pressed', this.isRecording);
    this.record.textContent = this.isRecording ? 'stop' : 'record';
    this.play.disabled = n < 2 || this.isRecording;
    setText(this.play, this.playing ? 'stop' : 'play');
    this.written.hidden = n < 2 || this.isRecording;
    setText(this.state, this.isRecording ? `recording: ${n} keyframes` : n > 1
        ? `${n} keyframes in ${quantity(this.keyframes[n - 1].seconds)} s`
        : 'record, move the camera, stop: keyframes for a suite');
    if (!this.written.hidden) this.text.value = this.toml();
  }
}

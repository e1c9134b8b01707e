// ---- viewer.js: the state of the view, what changes it, and what it tells the page ----

const SELF = 'view';
const FLIGHT_MS = 450;

class View {
  constructor(canvas, scene) {
    Object.assign(this, { canvas, scene, camera: new Camera(), shown: {}, playing: false, speed: 0, chosen: null, named: [], pickedStrand: null, label: null, fineMs: 0, pictures: 0 });
    this.timeS = scene.totalS;
    this.colour = scene.painted.length ? scene.painted[0] : null;
    this.values = new Float32Array(scene.strands.many).fill(UNKNOWN);
    this.paintedAt = null;
    scene.gridM = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5].find(x => 10 * x > this.partSize()) || 1;
    scene.thickM = scene.strands.radius.reduce((most, r) => Math.max(most, r), 0);
    this.start();
    this.readTheme();
  }

  start() {
    const gl = this.canvas.getContext('webgl2', { alpha: false, antialias: true, preserveDrawingBuffer: true, powerPreference: 'high-performance' });
    if (!gl) throw new Error('no WebGL 2');
    this.renderer = new Renderer(gl, this.scene);
    this.paintedAt = null;
  }

  // colours of the page
  readTheme() {
    const style = getComputedStyle(byId('body'));
    const get = name => { const hex = style.getPropertyValue(name).trim(); return rgb(parseInt(hex.slice(1), 16) || 0); };
    Object.assign(this, { ground: [get('--v3-sky'), get('--v3-ground')], ink: [...get('--v3-path'), 0.5], ring: get('--v3-ring') });
    this.changed();
  }

  // -- time --
  setTime(timeS, tells) {
    if (!Number.isFinite(timeS)) return;
    this.timeS = clamp(timeS, 0, this.scene.totalS);
    showTime(this);
    this.changed();
    if (tells) document.dispatchEvent(new CustomEvent('twin:time', { detail: { time_s: this.timeS, from: SELF } }));
  }

  play() {
    if (this.playing) return this.pause();
    if (this.timeS >= this.scene.totalS) this.setTime(0, true);
    this.playing = true;
    this.lastMs = null;
    showTime(this);
    this.changed();
  }

  pause() { this.playing = false; showTime(this); this.changed(); }

  step(nowMs) {
    if (this.playing) {
      const rate = this.speed || this.scene.totalS / 20;
      if (this.lastMs !== null) this.setTime(this.timeS + rate * Math.min(0.25, (nowMs - this.lastMs) / 1000), true);
      this.lastMs = nowMs;
      if (this.timeS >= this.scene.totalS) this.pause();
    }
    if (this.flight) {
      const { from, to, beganMs } = this.flight, share = clamp((nowMs - beganMs) / FLIGHT_MS, 0, 1), soft = share * share * (3 - 2 * share);
      for (const name of ['azimuth', 'elevation', 'distance']) this.camera[name] = mix(from[name], to[name], soft);
      this.camera.pivot = from.pivot.map((x, i) => mix(x, to.pivot[i], soft));
      if (share >= 1) this.flight = null;
    }
    return this.playing || this.flight;
  }

  // -- camera --
  poses() { return posesAt(this.scene.movers, this.timeS); }

  aspect() { return this.canvas.clientWidth / Math.max(1, this.canvas.clientHeight); }

  // some of the part's points in the world, enough to frame it
  partPoints() {
    const { ends, many } = this.scene.strands, pose = this.poses()[this.scene.head.part], step = Math.max(1, Math.floor(many / 400));
    const out = [];
    for (let k = 0; k < many; k += step) out.push(moved(pose, ends.subarray(6 * k, 6 * k + 3)), moved(pose, ends.subarray(6 * k + 3, 6 * k + 6)));
    if (out.length) return out;
    // nothing printed: the bed
    const bed = this.scene.bodies.find(body => body.kind === 'bed'), box = bed ? bed.box : [0, 0, 0, 1, 1, 1], on = bed ? this.poses()[bed.mover] : pose;
    return [0, 1, 2, 3].map(k => moved(on, [box[0] + (k & 1) * box[3], box[1] + (k >> 1) * box[4], box[2] + box[5]]));
  }

  partSize() { return Math.max(1e-3, norm(add(this.scene.partBox[1], this.scene.partBox[0], -1))); }

  look(name) {
    const [azimuth, elevation, flat] = VIEWS[name];
    this.fly(camera => { Object.assign(camera, { azimuth, elevation, flat }); camera.fit(this.partPoints(), this.aspect(), 1.22); });
  }

  // goes to where `change` leaves the camera
  fly(change) {
    const from = this.camera.told(), goal = Object.assign(new Camera(), this.camera);
    change(goal);
    const to = goal.told();
    this.camera.flat = to.flat;
    // the short way round
    from.azimuth += 360 * Math.round((to.azimuth - from.azimuth) / 360);
    const still = matchMedia('(prefers-reduced-motion: reduce)').matches || !this.drawn;
    if (still) Object.assign(this.camera, goal);
    this.flight = still ? null : { from, to, beganMs: performance.now() };
    this.changed();
  }

  turn(azimuth, elevation) { this.flight = null; this.camera.turn(azimuth, elevation); this.changed(); }
  shift(dx, dy) { this.flight = null; this.camera.shift(dx, dy, this.canvas.clientHeight, this.aspect()); this.changed(); }
  zoom(factor) { this.flight = null; this.camera.zoom(factor, 0.02 * this.partSize(), 20 + 20 * this.partSize()); this.changed(); }

  // the part's way since the last picture takes the camera along
  follow(poses) {
    const pose = poses[this.scene.head.part], middle = this.scene.partBox[0].map((x, i) => (x + this.scene.partBox[1][i]) / 2);
    const now = moved(pose, middle);
    if (this.shown.follow && this.partWas) {
      const way = add(now, this.partWas, -1);
      this.camera.pivot = add(this.camera.pivot, way);
      if (this.flight) for (const end of [this.flight.from, this.flight.to]) end.pivot = add(end.pivot, way);
    }
    this.partWas = now;
  }

  // -- findings --
  marks() {
    if (!this.shown.marks) return this.chosen ? [this.chosen] : [];
    const all = this.timeS >= this.scene.strands.doneS;
    return this.scene.findings.filter(f => f.at && (f === this.chosen || all || f.time_s === null || f.time_s <= this.timeS));
  }

  goToFinding(index, tells) {
    const finding = this.scene.findings.find(f => f.index === index);
    if (!finding) return false;
    this.pause();
    Object.assign(this, { chosen: finding, named: finding.bodies, pickedStrand: finding.strand, paintedAt: null });
    if (finding.time_s !== null) this.setTime(finding.time_s, true);
    if (finding.at) {
      const at = moved(this.poses()[this.scene.head.part], finding.at);
      this.follow(this.poses());
      this.fly(camera => {
        const distance = Math.max(0.35 * this.partSize(), 40 * this.scene.thickM) / HALF_VIEW * 0.5;
        Object.assign(camera, { pivot: at, distance, flat: false });
        camera.elevation = clamp(camera.elevation, 10, 60);
      });
      this.say(finding.at, finding.code, finding.words);
    } else this.label = null;
    this.changed();
    if (tells) document.dispatchEvent(new CustomEvent('twin:finding', { detail: { index, from: SELF } }));
    return true;
  }

  // words that stay at a place of the part
  say(at, code, words) {
    this.label = { at };
    byId('label').replaceChildren(element('b', '', code), ' ' + words);
  }

  nearestMark(x, y) {
    const part = this.poses()[this.scene.head.part], k = this.canvas.width / this.canvas.clientWidth;
    let [best, least] = [null, 13 * k];
    for (const finding of this.renderer.marksSeen || []) {
      const p = this.renderer.project(moved(part, finding.at));
      const off = p ? Math.hypot(p[0] - x * k, p[1] - y * k) : Infinity;
      if (off < least) [best, least] = [finding, off];
    }
    return best;
  }

  hover(x, y) { this.canvas.style.cursor = this.drawn && this.nearestMark(x, y) ? 'pointer' : ''; }

  under(x, y) { const k = this.canvas.width / this.canvas.clientWidth; return this.renderer.pick(x * k, y * k); }

  centre(x, y) {
    const at = this.under(x, y);
    if (at) this.fly(camera => { camera.pivot = at; });
  }

  // nothing is pointed at
  forget() {
    Object.assign(this, { chosen: null, named: [], pickedStrand: null, label: null, paintedAt: null });
    this.changed();
  }

  // a mark, a strand or nothing
  click(x, y) {
    const mark = this.nearestMark(x, y);
    if (mark) { this.goToFinding(mark.index, true); return; }
    this.forget();
    const at = this.under(x, y);
    if (at) this.nameStrand(unmoved(this.poses()[this.scene.head.part], at));
    this.changed();
  }

  nameStrand(at) {
    const { strands } = this.scene;
    let [best, least] = [-1, Infinity];
    for (let k = 0; k < firstAbove(strands.begins, this.timeS); k++) {
      const a = strands.ends.subarray(6 * k, 6 * k + 3), way = add(strands.ends.subarray(6 * k + 3, 6 * k + 6), a, -1), to = add(at, a, -1);
      const share = clamp(dot(way, to) / (dot(way, way) || 1), 0, 1), off = norm(add(to, way, -share)) - strands.radius[k];
      if (off < least) [best, least] = [k, off];
    }
    if (best < 0 || least > strands.radius[best]) return;
    const order = strands.order[strands.strand[best]], share = this.values[best] > 50 ? this.values[best] - 100 : this.values[best];
    const p = this.colour, span = p ? p.high - p.low : 0;
    const value = !p ? '' : share === UNKNOWN ? (p.word === 'clearance' ? 'nothing near' : 'not known') : share === BELOW ? 'below ' + plain(p.low, span) : share === ABOVE ? 'above ' + plain(p.high, span) : plain(mix(p.low, p.high, share), span);
    this.pickedStrand = order;
    const name = strands.names ? strands.names[order] : 'strand ' + (order + 1);
    this.say(at, name, p ? p.title + ' ' + value + (value && share >= 0 && share <= 1 && p.unit ? ' ' + p.unit : '') : '');
  }

  // -- colour --
  setColour(word) {
    const found = this.scene.painted.find(painted => painted.word === word);
    if (!found) return false;
    this.colour = found;
    this.paintedAt = null;
    byId('colour').value = word;
    this.changed();
    return true;
  }

  repaint() {
    const { colour, scene, values } = this;
    if (this.paintedAt !== null && (!colour || isSteady(colour) || this.paintedAt === this.timeS)) return;
    const isNew = this.paintedAt === null;
    if (colour) paint(scene, colour, this.timeS, values); else values.fill(UNKNOWN);
    if (isNew) showLegend(byId('legend'), scene, colour, values);
    if (this.pickedStrand !== null) {
      const { strand, order } = scene.strands;
      for (let k = 0; k < values.length; k++) if (order[strand[k]] === this.pickedStrand) values[k] += 100;
    }
    this.renderer.setValues(values);
    this.paintedAt = this.timeS;
  }

  // -- pictures --
  changed() {
    this.isStill = false;
    if (!this.due) this.due = requestAnimationFrame(nowMs => this.frame(nowMs));
  }

  frame(nowMs) {
    this.due = null;
    const gl = this.renderer.gl, more = this.step(nowMs);
    if (gl.isContextLost() || !this.fitCanvas()) return;
    this.repaint();
    // at rest a finer picture, where the card is quick enough
    const rest = !more && this.isStill;
    this.drawAll(rest && this.dpr < 2 && this.fineMs < 500 ? 2 : 1);
    if (more) this.changed();
    else if (!rest) {
      clearTimeout(this.restTimer);
      this.restTimer = setTimeout(() => { this.isStill = true; this.due = this.due || requestAnimationFrame(ms => this.frame(ms)); }, 120);
    }
  }

  fitCanvas() {
    const { canvas } = this, { clientWidth, clientHeight } = canvas;
    if (!clientWidth || !clientHeight) return false;
    this.dpr = Math.min(2, window.devicePixelRatio || 1);
    const [width, height] = [clientWidth, clientHeight].map(x => Math.max(1, Math.round(x * this.dpr)));
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    if (!this.drawn) this.look('hero');
    return true;
  }

  drawAll(fine) {
    const { shown, camera, scene } = this, poses = this.poses(), began = performance.now();
    this.follow(poses);
    const isArm = body => ['arm', 'tool', 'nozzle', 'other'].includes(body.kind);
    this.renderer.draw({
      camera, poses, fine, timeS: this.timeS, dpr: this.dpr, planned: shown.planned, chosen: this.chosen, marks: this.marks(), named: this.named, isPicked: this.pickedStrand !== null,
      ground: this.ground, ink: this.ink, ring: this.ring, reach: this.reach(poses),
      shows: body => (shown.arm || !isArm(body)) && (body.gone_s === null || this.timeS < body.gone_s),
      isGlass: body => shown.glass && isArm(body) && body.kind !== 'nozzle',
    });
    this.placeLabel(poses[scene.head.part]);
    if (fine > 1) { this.renderer.pick(0, 0); this.fineMs = performance.now() - began; }
    this.drawn = true;
    this.pictures++;
  }

  // how far anything lies from the pivot
  reach(poses) {
    let most = norm(add(moved(poses[this.scene.head.part], this.scene.partBox[0]), this.camera.pivot, -1)) + this.partSize();
    for (const body of this.scene.bodies) {
      const [x, y, z, dx, dy, dz] = body.box;
      most = Math.max(most, norm(add(moved(poses[body.mover], [x + dx / 2, y + dy / 2, z + dz / 2]), this.camera.pivot, -1)) + Math.hypot(dx, dy, dz) / 2);
      for (let k = 0; k < body.capsule.length; k += 7) most = Math.max(most, norm(add(moved(poses[body.mover], body.capsule.subarray(k, k + 3)), this.camera.pivot, -1)) + 1);
    }
    return 1.05 * most;
  }

  placeLabel(part) {
    const box = byId('label'), at = this.label && this.renderer.project(moved(part, this.label.at));
    box.hidden = !at;
    if (!at) return;
    const x = at[0] / this.dpr, y = at[1] / this.dpr, wide = this.canvas.clientWidth;
    box.style.transform = `translate(${clamp(x + 16, 4, Math.max(4, wide - box.offsetWidth - 4))}px, ${clamp(y - 34, 4, this.canvas.clientHeight - 30)}px)`;
  }

  state() {
    return {
      camera: this.camera.told(), time_s: this.timeS, colour: this.colour && this.colour.word, playing: this.playing,
      finding: this.chosen && this.chosen.index, moving: Boolean(this.flight), still: Boolean(this.isStill && !this.due),
      pictures: this.pictures, segments: this.scene.strands.many, shown: firstAbove(this.scene.strands.begins, this.timeS),
    };
  }
}

function say(text) {
  const box = byId('message');
  box.textContent = text;
  box.hidden = !text;
}

function open() {
  const canvas = byId('canvas'), data = byId('data');
  if (!canvas || !data) return;
  byId('body').hidden = false;
  let view;
  try {
    view = new View(canvas, readScene(unpack(data.textContent)));
  } catch (error) {
    byId('body').hidden = true;
    say('The 3-D view cannot be shown here (' + error.message.slice(0, 120) + '); the pictures of this report show the same.');
    return;
  }
  data.textContent = '';
  // a part that is carried about would leave the picture
  byId('follow').checked = !view.scene.movers.movers[view.scene.head.part].still;
  bindControls(view);
  listen(canvas, view);
  showTime(view);
  new ResizeObserver(() => view.changed()).observe(canvas);
  canvas.addEventListener('webglcontextlost', event => { event.preventDefault(); say('The graphics card took the 3-D view away; it comes back when it can.'); });
  canvas.addEventListener('webglcontextrestored', () => { say(''); view.renderer.solid = null; view.start(); view.changed(); });
  document.addEventListener('twin:time', ({ detail }) => { if (detail && detail.from !== SELF) { view.pause(); view.setTime(Number(detail.time_s)); } });
  document.addEventListener('twin:finding', ({ detail }) => { if (detail && detail.from !== SELF) view.goToFinding(Number(detail.index)); });
  document.addEventListener('twin:theme', ({ detail }) => { byId('body').parentElement.dataset.theme = detail && detail.dark ? 'dark' : 'light'; view.readTheme(); });
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => view.readTheme());
  window.twinView = {
    setTime: timeS => view.setTime(Number(timeS)), setColour: word => view.setColour(String(word)),
    goToFinding: index => view.goToFinding(Number(index)), state: () => view.state(),
  };
}

// at once where the section stands before the script, so that the page's first events are heard
if (byId('data')) open(); else document.addEventListener('DOMContentLoaded', open);

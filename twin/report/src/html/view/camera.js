// ---- camera.js: vectors, matrices (columns one after the other) and where the eye stands ----

const mix = (a, b, t) => a + (b - a) * t;
const add = (a, b, k = 1) => [a[0] + k * b[0], a[1] + k * b[1], a[2] + k * b[2]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const norm = a => Math.hypot(...a);
const clamp = (x, low, high) => Math.max(low, Math.min(high, x));

function slerp(a, b, t) {
  const size = q => Math.hypot(...q) || 1;
  a = a.map((x, _, q) => x / size(q)); b = b.map((x, _, q) => x / size(q));
  const cos = clamp(a.reduce((sum, x, i) => sum + x * b[i], 0), -1, 1), angle = Math.acos(cos), sin = Math.sin(angle);
  // so near that a straight line is as good
  const [p, q] = sin < 1e-4 ? [1 - t, t] : [Math.sin((1 - t) * angle) / sin, Math.sin(t * angle) / sin];
  const out = a.map((x, i) => p * x + q * b[i]);
  return out.map(x => x / size(out));
}

// matrix of a place and a unit quaternion x, y, z, w
function rigid(at, [x, y, z, w]) {
  return new Float32Array([
    1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w), 0,
    2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w), 0,
    2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y), 0,
    at[0], at[1], at[2], 1,
  ]);
}

function times(a, b) {
  const out = new Float32Array(16);
  for (let c = 0; c < 4; c++) for (let r = 0; r < 4; r++) {
    out[4 * c + r] = a[r] * b[4 * c] + a[4 + r] * b[4 * c + 1] + a[8 + r] * b[4 * c + 2] + a[12 + r] * b[4 * c + 3];
  }
  return out;
}

const axis = (m, k) => [m[4 * k], m[4 * k + 1], m[4 * k + 2]];
const moved = (m, p) => add(add(add(axis(m, 3), axis(m, 0), p[0]), axis(m, 1), p[1]), axis(m, 2), p[2]);
// the inverse of a rigid matrix, of a place and of a direction
const unturned = (m, v) => [dot(axis(m, 0), v), dot(axis(m, 1), v), dot(axis(m, 2), v)];
const unmoved = (m, p) => unturned(m, add(p, axis(m, 3), -1));

const HALF_VIEW = Math.tan(14 * Math.PI / 180);
// azimuth and elevation of the eye, deg; the same as in the still pictures
const VIEWS = { hero: [-50, 28, false], top: [-90, 90, true], front: [-90, 0, true], side: [0, 0, true] };

// Turns about a pivot. `flat`: parallel rays, as in the fixed views; turning goes back to perspective.
class Camera {
  constructor() { Object.assign(this, { pivot: [0, 0, 0], azimuth: -50, elevation: 28, distance: 1, flat: false }); }

  axes() {
    const [a, e] = [this.azimuth, this.elevation].map(deg => deg * Math.PI / 180);
    const forward = [-Math.cos(e) * Math.cos(a), -Math.cos(e) * Math.sin(a), -Math.sin(e)];
    const right = [-Math.sin(a), Math.cos(a), 0];
    return { forward, right, up: cross(right, forward) };
  }

  eye() { return add(this.pivot, this.axes().forward, -this.distance); }

  // matrices for a picture of this aspect; `reach`: how far things lie from the pivot at most
  matrices(aspect, reach) {
    const { forward, right, up } = this.axes(), eye = this.eye();
    const view = new Float32Array([
      right[0], up[0], -forward[0], 0, right[1], up[1], -forward[1], 0, right[2], up[2], -forward[2], 0,
      -dot(right, eye), -dot(up, eye), dot(forward, eye), 1,
    ]);
    const half = HALF_VIEW * (aspect < 1 ? 1 / aspect : 1);
    const far = this.distance + reach;
    const near = this.flat ? this.distance - reach : Math.max(this.distance - reach, 0.02 * this.distance);
    const size = this.distance * half;
    const project = this.flat
      ? [1 / (size * aspect), 0, 0, 0, 0, 1 / size, 0, 0, 0, 0, -2 / (far - near), 0, 0, 0, -(far + near) / (far - near), 1]
      : [1 / (half * aspect), 0, 0, 0, 0, 1 / half, 0, 0, 0, 0, -(far + near) / (far - near), -1, 0, 0, -2 * far * near / (far - near), 0];
    return { viewProject: times(project, view), near, far, eye, forward, right, up, half };
  }

  // so that all points are in the picture
  fit(points, aspect, margin) {
    const { forward, right, up } = this.axes();
    const range = way => { const all = points.map(p => dot(p, way)); return [Math.min(...all), Math.max(...all)]; };
    const [x, y, z] = [right, up, forward].map(range);
    this.pivot = [0, 0, 0];
    [[right, x], [up, y], [forward, z]].forEach(([way, [low, high]]) => { this.pivot = add(this.pivot, way, (low + high) / 2); });
    const half = HALF_VIEW * (aspect < 1 ? 1 / aspect : 1);
    const needs = p => {
      const off = add(p, this.pivot, -1), [x, y] = [right, up].map(way => Math.abs(dot(off, way)));
      return margin * Math.max(y / half, x / (half * aspect)) - (this.flat ? 0 : dot(off, forward));
    };
    this.distance = points.reduce((most, p) => Math.max(most, needs(p)), 1e-3);
  }

  turn(azimuth, elevation) {
    this.flat = false;
    this.azimuth = (this.azimuth + azimuth) % 360;
    this.elevation = clamp(this.elevation + elevation, -89, 89);
  }

  // by pixels of a picture so many pixels high
  shift(dx, dy, heightPx, aspect) {
    const { right, up } = this.axes();
    const perPx = 2 * this.distance * HALF_VIEW * (aspect < 1 ? 1 / aspect : 1) / heightPx;
    this.pivot = add(add(this.pivot, right, -dx * perPx), up, dy * perPx);
  }

  zoom(factor, least, most) { this.distance = clamp(this.distance * factor, least, most); }

  told() {
    return { position: this.eye(), pivot: [...this.pivot], distance: this.distance, azimuth: this.azimuth, elevation: this.elevation, flat: this.flat };
  }
}


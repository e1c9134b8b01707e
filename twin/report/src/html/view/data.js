// ---- data.js: from the packed string to arrays that can be drawn ----

const KINDS = { u8: Uint8Array, i8: Int8Array, u16: Uint16Array, i16: Int16Array, u32: Uint32Array, f32: Float32Array, f64: Float64Array };
// codes of values that are no places on their scale, as `strands.rs` writes them
const TOP = 65000, UNDER = 65533, OVER = 65534;
// the same for the shader: below, above, not known
const BELOW = -1, ABOVE = 2, UNKNOWN = -9;

function unpack(text) {
  const raw = atob(text.trim());
  const bytes = new Uint8Array(raw.length);
  for (let k = 0; k < raw.length; k++) bytes[k] = raw.charCodeAt(k);
  const length = new DataView(bytes.buffer).getUint32(0, true);
  const head = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + length)));
  head.array = name => {
    const [kind, from, many] = head.arrays[name] || ['u8', 0, 0];
    return new KINDS[kind](bytes.buffer, 4 + length + from, many);
  };
  return head;
}

// places of 16-bit codes in a box
function places(codes, box) {
  const out = new Float32Array(codes.length);
  for (let k = 0; k < codes.length; k++) out[k] = box[k % 3] + box[3 + k % 3] * codes[k] / 65535;
  return out;
}

function readScene(head) {
  const scene = { head, totalS: head.total_s || 0, findings: head.findings, painted: head.painted };
  scene.movers = readMovers(head);
  scene.bodies = readBodies(head);
  scene.strands = readStrands(head);
  scene.partBox = [head.strands.box.slice(0, 3), head.strands.box.slice(0, 3).map((x, i) => x + head.strands.box[3 + i])];
  return scene;
}

function readMovers(head) {
  const time = head.array('key_time');
  const movers = head.movers.map((mover, k) => mover.still ? mover : {
    at: places(head.array('mover_at_' + k), mover.box), turn: head.array('mover_turn_' + k),
  });
  return { time, movers };
}

// 4x4 matrices of all movers at a time, straight between keys
function posesAt({ time, movers }, at) {
  let k = firstAbove(time, at) - 1;
  k = Math.max(0, Math.min(time.length - 2, k));
  const next = Math.min(k + 1, time.length - 1);
  const span = time[next] - time[k];
  const share = span > 0 ? Math.max(0, Math.min(1, (at - time[k]) / span)) : 0;
  return movers.map(mover => {
    if (mover.still) return rigid(mover.still.slice(0, 3), mover.still.slice(3));
    const place = [0, 1, 2].map(i => mix(mover.at[3 * k + i], mover.at[3 * next + i], share));
    const turn = n => Array.from(mover.turn.subarray(4 * n, 4 * n + 4));
    return rigid(place, slerp(turn(k), turn(next), share));
  });
}

// number of entries that are at most `value` in an ascending array
function firstAbove(array, value) {
  let [low, high] = [0, array.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (array[middle] <= value) low = middle + 1; else high = middle;
  }
  return low;
}

function readBodies(head) {
  const [at, normal, triangle, capsule] = ['corner_at', 'corner_normal', 'triangle', 'capsule'].map(head.array);
  let [corner, face, round] = [0, 0, 0];
  return head.bodies.map(body => {
    const out = {
      ...body,
      at: places(at.subarray(3 * corner, 3 * (corner + body.corners)), body.box),
      normal: Float32Array.from(normal.subarray(3 * corner, 3 * (corner + body.corners)), x => x / 127),
      face: triangle.slice(3 * face, 3 * (face + body.triangles)),
      capsule: capsule.slice(7 * round, 7 * (round + body.capsules)),
    };
    corner += body.corners; face += body.triangles; round += body.capsules;
    return out;
  });
}

// Segments, sorted by when they begin: ends as printed and as planned, radius, times, strand.
function readStrands(head) {
  const get = head.array;
  const [points, order, born, span, radius, unit] =
    ['strand_points', 'strand_order', 'strand_born', 'strand_span', 'strand_radius', 'strand_way'].map(get);
  const at = places(get('point_at'), head.strands.box), when = get('point_when'), way = get('point_way');
  const planned = new Float32Array(at.length), time = new Float64Array(when.length);
  const from = [], of = [];
  let first = 0;
  for (let s = 0; s < points.length; s++) {
    for (let k = first; k < first + points[s]; k++) {
      time[k] = born[s] + span[s] * when[k] / 65535;
      for (let i = 3 * k; i < 3 * k + 3; i++) planned[i] = at[i] + way[i] * unit[s];
      if (k + 1 < first + points[s]) { from.push(k); of.push(s); }
    }
    first += points[s];
  }
  const sorted = Uint32Array.from(from.keys()).sort((a, b) => time[from[a]] - time[from[b]] || a - b);
  const many = from.length;
  const out = {
    many, order, names: head.names, ageing: get('strand_ageing'),
    ends: new Float32Array(6 * many), plannedEnds: new Float32Array(6 * many), radius: new Float32Array(many),
    when: new Float32Array(2 * many), begins: new Float64Array(many), middle: new Float64Array(many),
    strand: new Uint32Array(many), point: new Uint32Array(many),
  };
  sorted.forEach((old, k) => {
    const [p, s] = [from[old], of[old]];
    out.ends.set(at.subarray(3 * p, 3 * p + 6), 6 * k);
    out.plannedEnds.set(planned.subarray(3 * p, 3 * p + 6), 6 * k);
    out.radius[k] = radius[s];
    out.when[2 * k] = out.begins[k] = time[p];
    out.when[2 * k + 1] = time[p + 1];
    out.middle[k] = 0.5 * (time[p] + time[p + 1]);
    out.strand[k] = s; out.point[k] = p;
  });
  out.doneS = time.reduce((most, t) => Math.max(most, t), 0);
  return out;
}

// places on the scale of every segment at a time, into `out`; codes beside the scale as the shader knows them
function paint(scene, painted, timeS, out) {
  const { head, strands } = scene, { many, strand, point, middle } = strands;
  const span = painted.high - painted.low;
  const onScale = value => value < painted.low ? BELOW : value > painted.high ? ABOVE : (value - painted.low) / span;
  const ofCode = code => code <= TOP ? code / TOP : code === UNDER ? BELOW : code === OVER ? ABOVE : UNKNOWN;
  const codes = head.array(painted.word);
  const each = {
    order: k => onScale(strands.order[strand[k]] + 1),
    age: k => onScale(Math.max(0, timeS - middle[k])),
    strand: k => ofCode(codes[strand[k]]),
    segment: k => ofCode(codes[point[k]]),
    ageing: k => ageingAt(head, strands.ageing[strand[k]], codes, Math.max(0, timeS - middle[k])),
  }[painted.source];
  for (let k = 0; k < many; k++) out[k] = each(k);
}

// a table of ages: the k-th of n lies at last (k / (n - 1))²
function ageingAt(head, table, levels, ageS) {
  const ages = head.strands.ageing;
  const lastS = head.lastAges || (head.lastAges = head.array('ageing_last'));
  if (table === 65535 || (table + 1) * ages > levels.length) return UNKNOWN;
  const place = lastS[table] > 0 ? Math.min(1, Math.sqrt(ageS / lastS[table])) * (ages - 1) : ages - 1;
  const k = Math.min(Math.floor(place), ages - 2);
  const [low, high] = [levels[table * ages + k], levels[table * ages + k + 1]];
  if (low === 255 || high === 255) return UNKNOWN;
  // straight in age between the two, not in the place
  const [from, to] = [k * k, (k + 1) * (k + 1)];
  return mix(low, high, Math.max(0, Math.min(1, (place * place - from) / (to - from)))) / 250;
}

const isSteady = painted => !['age', 'ageing'].includes(painted.source);


// ---- controls.js: the page's controls and the legend ----

const byId = id => document.getElementById('view3d-' + id);
const hexOf = c => '#' + c.toString(16).padStart(6, '0');

function element(tag, kind, text) {
  const made = document.createElement(tag);
  if (kind) made.className = kind;
  if (text !== undefined) made.textContent = text;
  return made;
}

function clock(timeS) {
  const whole = Math.floor(timeS + 1e-6), two = x => String(x).padStart(2, '0');
  const [h, m, s] = [Math.floor(whole / 3600), Math.floor(whole / 60) % 60, whole % 60];
  return (h ? h + ':' + two(m) : m) + ':' + two(s) + '.' + Math.floor((timeS - whole) * 10 + 1e-6).toString().slice(0, 1).replace('-', '0');
}

function bindControls(view) {
  byId('play').addEventListener('click', () => view.play());
  byId('time').addEventListener('input', event => { const timeS = Number(event.target.value); view.pause(); view.setTime(timeS, true); });
  byId('colour').addEventListener('change', event => view.setColour(event.target.value));
  byId('speed').addEventListener('change', event => { view.speed = Number(event.target.value); });
  for (const name of ['arm', 'glass', 'planned', 'marks', 'follow']) {
    const box = byId(name);
    view.shown[name] = box.checked;
    box.addEventListener('change', () => { view.shown[name] = box.checked; view.changed(); });
  }
  document.querySelectorAll('#view3d [data-view]').forEach(button => button.addEventListener('click', () => view.look(button.dataset.view)));
}

// shows time and play state in the controls
function showTime(view) {
  const slider = byId('time'), text = clock(view.timeS) + ' / ' + clock(view.scene.totalS);
  slider.value = view.timeS;
  slider.setAttribute('aria-valuetext', clock(view.timeS));
  byId('clock').textContent = text;
  const button = byId('play'), word = view.playing ? 'pause' : 'play';
  if (button.getAttribute('aria-label') === word) return;
  button.setAttribute('aria-label', word);
  button.setAttribute('aria-pressed', String(view.playing));
  button.textContent = view.playing ? '❚❚' : '▶';
}

// a value with as many digits as a span asks for
function plain(value, span) {
  const digits = span > 0 ? clamp(2 - Math.floor(Math.log10(span)), 0, 9) : 2;
  const text = value.toFixed(digits);
  return text.includes('.') ? text.replace(/\.?0+$/, '') : text;
}

// round values from low to high, three to seven; whole ones where only these mean something
function ticks(low, high, isWhole) {
  const span = high - low, rough = isWhole ? Math.max(1, span / 3.5) : span / 3.5, ten = 10 ** Math.floor(Math.log10(rough));
  const step = [5, 2, 1].map(k => k * ten).find(x => x <= rough * (1 + 1e-9)) || 1;
  const out = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * span && out.length < 12; k++) out.push(k * step);
  return out.map(value => [value, plain(Math.abs(value) < 1e-9 * span ? 0 : value, span)]);
}

// bar of the scale with ticks, limit and ends; kinds of bodies; shapes of the marks
function showLegend(box, scene, painted, values) {
  box.replaceChildren();
  if (painted) box.append(element('p', 'v3-title', painted.title + (painted.unit ? ' [' + painted.unit + ']' : '')), scaleBar(painted, values));
  const key = element('ul', 'v3-key'), entry = (mark, style, text) => {
    const line = element('li'), sign = element('i', mark);
    sign.style.background = style;
    line.append(sign, text);
    key.append(line);
  };
  if (painted && values.includes(UNKNOWN)) entry('', hexOf(COLOURS.plain), painted.word === 'clearance' ? 'nothing near' : 'not known');
  for (const kind of Object.keys(KIND_COLOURS)) {
    if (scene.bodies.some(body => body.kind === kind)) entry('', hexOf(KIND_COLOURS[kind][0]), KIND_COLOURS[kind][1] + (kind === 'bed' ? `, lines every ${plain(1e3 * scene.gridM, 1e3)} mm` : ''));
  }
  const has = kind => scene.findings.some(finding => finding.at && finding.kind === kind);
  if (has('error')) entry('', hexOf(MARK_COLOURS.error), 'error: square');
  if (has('warning')) entry('v3-triangle', hexOf(MARK_COLOURS.warning), 'warning: triangle');
  box.append(key);
}

function scaleBar(painted, values) {
  const { low, high, limit } = painted, span = high - low;
  const out = element('div', 'v3-scale'), bar = element('div', 'v3-ramp');
  const stops = Array.from({ length: 17 }, (_, k) => `rgb(${ramp(k / 16).map(x => Math.round(255 * x)).join(' ')}) ${k * 6.25}%`);
  bar.style.background = `linear-gradient(to right, ${stops.join(', ')})`;
  const at = value => clamp((value - low) / span, 0, 1) * 100 + '%';
  for (const [beyond, kind, colour, text] of [[BELOW, 'v3-below', COLOURS.below, 'below the scale'], [ABOVE, 'v3-above', COLOURS.above, 'above the scale']]) {
    if (!values.includes(beyond)) continue;
    const end = element('i', kind);
    end.title = text;
    end.style.background = hexOf(colour);
    out.append(end);
  }
  const isShown = limit !== null && limit >= low && limit <= high;
  for (const [value, text] of ticks(low, high, painted.source === 'order')) {
    if (isShown && Math.abs(value - limit) < 0.24 * span) continue;
    const tick = element('span', 'v3-tick', text);
    tick.style.left = at(value);
    out.append(tick);
  }
  if (isShown) {
    const mark = element('span', 'v3-tick v3-limit', 'limit ' + plain(limit, span));
    mark.style.left = at(limit);
    out.append(mark);
  }
  out.append(bar);
  return out;
}


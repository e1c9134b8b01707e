// ---- pointer.js: mouse, fingers and keys on the canvas ----

function listen(canvas, view) {
  const pointers = new Map();
  let [wasMoved, lastScroll, entered] = [0, 0, 0];
  const place = event => { const box = canvas.getBoundingClientRect(); return [event.clientX - box.left, event.clientY - box.top]; };

  canvas.addEventListener('pointerdown', event => {
    canvas.focus({ preventScroll: true });
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, place(event));
    wasMoved = 0;
  });
  canvas.addEventListener('pointermove', event => {
    const last = pointers.get(event.pointerId), now = place(event);
    if (!last) { view.hover(...now); return; }
    const [dx, dy] = [now[0] - last[0], now[1] - last[1]];
    wasMoved += Math.abs(dx) + Math.abs(dy);
    if (pointers.size === 2) {
      const other = [...pointers].find(([id]) => id !== event.pointerId)[1];
      const apart = p => Math.hypot(p[0] - other[0], p[1] - other[1]) || 1;
      view.zoom(apart(last) / apart(now));
      view.shift(dx / 2, dy / 2);
    } else if (event.buttons & 6 || event.shiftKey) view.shift(dx, dy);
    else view.turn(-0.35 * dx, 0.35 * dy);
    pointers.set(event.pointerId, now);
  });
  const release = event => {
    const known = pointers.delete(event.pointerId);
    if (known && event.type === 'pointerup' && wasMoved < 5 && event.button === 0) view.click(...place(event));
  };
  canvas.addEventListener('pointerup', release);
  canvas.addEventListener('pointercancel', release);
  canvas.addEventListener('contextmenu', event => event.preventDefault());
  canvas.addEventListener('dblclick', event => view.centre(...place(event)));

  // A page that is being scrolled goes on scrolling over the view; a wheel that is turned on it zooms.
  window.addEventListener('scroll', () => { lastScroll = performance.now(); }, { passive: true });
  canvas.addEventListener('pointerenter', () => { entered = performance.now(); });
  canvas.addEventListener('wheel', event => {
    const rested = performance.now() - Math.max(lastScroll, entered) > 400;
    if (document.activeElement !== canvas && !event.ctrlKey && !rested) return;
    event.preventDefault();
    view.zoom(Math.exp(clamp(event.deltaY * (event.deltaMode ? 16 : 1), -240, 240) * 0.0016));
  }, { passive: false });

  const keys = {
    ArrowLeft: () => view.turn(-6, 0), ArrowRight: () => view.turn(6, 0), ArrowUp: () => view.turn(0, 6), ArrowDown: () => view.turn(0, -6),
    '+': () => view.zoom(0.85), '=': () => view.zoom(0.85), '-': () => view.zoom(1 / 0.85), ' ': () => view.play(), Home: () => view.look('hero'), Escape: () => view.forget(),
  };
  canvas.addEventListener('keydown', event => {
    const act = keys[event.key];
    if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    act();
  });
}


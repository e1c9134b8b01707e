// Time: one moment for the whole page. Other parts of it (the 3-D view) send and hear `twin:time` on `document`.

const data = JSON.parse(document.getElementById("twin-data").textContent);
const byId = (id) => document.getElementById(id);
const watchers = [];
let nowS = data.total;

/** h:mm:ss, with tenths while the program is short. */
function clock(timeS) {
  const tenths = data.total < 600;
  const whole = tenths ? Math.floor(timeS + 0.05) : Math.round(timeS);
  const two = (n) => String(n).padStart(2, "0");
  const text = `${Math.floor(whole / 3600)}:${two(Math.floor(whole / 60) % 60)}:${two(whole % 60)}`;
  return tenths ? `${text}.${Math.floor((timeS + 0.05 - whole) * 10) % 10}` : text;
}

/** Last index whose key is not after `value`, in ascending keys; -1: none. */
function lastNotAfter(length, key, value) {
  let low = 0, high = length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (key(middle) <= value) low = middle + 1; else high = middle;
  }
  return low - 1;
}

/** What the arm does at a time, in words. */
function doing(timeS) {
  const k = lastNotAfter(data.stretches.length, (i) => data.stretches[i][0], timeS);
  const at = data.stretches[k];
  if (timeS >= data.total) return "finished";
  if (!at || timeS > at[1] + 1e-3) return "";
  const strand = at[3] === null ? "" : ` · strand ${data.strands[at[3]] ?? at[3] + 1}`;
  return data.states[at[2]] + strand;
}

/** Shows a moment everywhere on the page and, unless it was heard, tells it to others. */
function seek(timeS, heard = false) {
  if (!Number.isFinite(timeS)) return;
  nowS = Math.min(Math.max(timeS, 0), data.total);
  watchers.forEach((watcher) => watcher(nowS));
  if (!heard) {
    document.dispatchEvent(new CustomEvent("twin:time", { detail: { time_s: nowS, from: "page" } }));
  }
}

document.addEventListener("twin:time", (event) => {
  const detail = event.detail;
  if (detail && detail.from !== "page") seek(Number(detail.time_s), true);
});

// The slider.
const slider = byId("slider");
if (slider) {
  slider.addEventListener("input", () => seek(Number(slider.value)));
  watchers.push((timeS) => {
    slider.value = String(timeS);
    slider.setAttribute("aria-valuetext", `${clock(timeS)}, ${doing(timeS)}`);
    byId("now-time").textContent = clock(timeS);
    byId("now-state").textContent = doing(timeS);
  });
}

// The timeline: a cursor over all lanes, a click goes to a time.
const lanes = byId("lanes");
if (lanes) {
  const cursor = lanes.querySelector(".cursor");
  const field = () => lanes.querySelector(".lane-field").getBoundingClientRect();
  const place = () => {
    const box = field();
    const left = box.left - lanes.getBoundingClientRect().left;
    cursor.style.transform = `translateX(${left + (box.width * nowS) / data.total}px)`;
  };
  watchers.push(place);
  addEventListener("resize", place);
  let held = false;
  const go = (event) => {
    const box = field();
    if (event.clientX < box.left - 4 || event.clientX > box.right + 4) return false;
    seek((data.total * (event.clientX - box.left)) / box.width);
    return true;
  };
  lanes.addEventListener("pointerdown", (event) => {
    const mark = event.target.closest("[data-finding]");
    if (mark) choose(Number(mark.dataset.finding), true);
    else held = event.button === 0 && go(event);
  });
  addEventListener("pointermove", (event) => { if (held) go(event); });
  addEventListener("pointerup", () => { held = false; });
}

// The film strip: the picture of the moment is marked; a click goes to its time.
const frames = [...document.querySelectorAll(".strip > li")];
frames.forEach((frame) => frame.addEventListener("click", () => seek(Number(frame.dataset.time))));
watchers.push((timeS) => {
  const k = lastNotAfter(frames.length, (i) => Number(frames[i].dataset.time), timeS + 1e-6 * data.total);
  frames.forEach((frame, i) => frame.classList.toggle("at", i === Math.max(k, 0)));
});


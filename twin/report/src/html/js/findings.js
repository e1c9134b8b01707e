// Findings: filter, order, keys j and k, deep links. A chosen finding is told by `twin:finding` on `document`.

const rowBox = byId("rows");
const rows = rowBox ? [...rowBox.querySelectorAll("details.finding")] : [];
const rowOf = new Map(rows.map((row) => [Number(row.dataset.index), row]));
let chosen = null;

/** Marks and tells a finding and goes to its time; `open`: its row is opened and scrolled to. */
function choose(index, open, heard = false) {
  const row = rowOf.get(index);
  if (!row) return;
  if (chosen) chosen.classList.remove("chosen");
  chosen = row;
  row.classList.add("chosen");
  if (open) {
    row.hidden = false;
    row.open = true;
    row.scrollIntoView({ block: "nearest" });
    row.querySelector("summary").focus({ preventScroll: true });
  }
  if (heard) return;
  document.dispatchEvent(new CustomEvent("twin:finding", { detail: { index, from: "page" } }));
  if (row.dataset.time) seek(Number(row.dataset.time));
}

document.addEventListener("twin:finding", (event) => {
  const detail = event.detail;
  if (detail && detail.from !== "page") choose(Number(detail.index), true, true);
});

/** The page of the code in place, and the picture in the row: both are in the page once and shown twice. */
function fill(row) {
  const place = row.querySelector(".why");
  const page = place && byId(`why-${row.dataset.code}`);
  if (page && !place.dataset.filled) {
    place.dataset.filled = "yes";
    const copy = document.createElement("div");
    copy.className = "copied";
    copy.append(...[...page.childNodes].map((node) => node.cloneNode(true)));
    place.after(copy);
  }
}

rows.forEach((row) => {
  const picture = row.querySelector(".more > img");
  if (picture) {
    const thumb = new Image();
    thumb.src = picture.src;
    thumb.alt = "";
    thumb.className = "thumb";
    row.querySelector(".what").prepend(thumb);
  }
  row.addEventListener("toggle", () => { if (row.open) fill(row); });
  row.querySelector("summary").addEventListener("click", () => {
    // before the click takes effect
    if (!row.open) choose(Number(row.dataset.index), false);
  });
});

// Filter and order.
if (rows.length > 0) {
  const [family, severity, order, text] = ["by-family", "by-severity", "by-order", "by-text"].map(byId);
  const words = new Map(rows.map((row) => [row, row.textContent.toLowerCase()]));
  const apply = () => {
    const wanted = text.value.trim().toLowerCase();
    let n = 0;
    rows.forEach((row) => {
      const fits = (!family.value || row.dataset.family === family.value)
        && (!severity.value || row.dataset.severity === severity.value)
        && words.get(row).includes(wanted);
      row.hidden = !fits;
      n += fits ? 1 : 0;
    });
    byId("n-shown").textContent = n === rows.length ? `${n} shown` : `${n} of ${rows.length} shown`;
  };
  const keys = {
    index: (row) => Number(row.dataset.index),
    time: (row) => (row.dataset.time ? Number(row.dataset.time) : Infinity),
    code: (row) => row.dataset.code,
  };
  const sort = () => {
    const key = keys[order.value];
    const sorted = [...rows].sort((a, b) => {
      const [x, y] = [key(a), key(b)];
      return x < y ? -1 : x > y ? 1 : keys.index(a) - keys.index(b);
    });
    rowBox.append(...sorted);
  };
  [family, severity].forEach((choice) => choice.addEventListener("change", apply));
  text.addEventListener("input", apply);
  order.addEventListener("change", sort);
}

// j and k: the next row and the one before, as shown.
document.addEventListener("keydown", (event) => {
  const way = { j: 1, k: -1 }[event.key];
  const typing = event.target.closest?.("input, select, textarea, canvas, [contenteditable]");
  if (!way || typing || event.ctrlKey || event.metaKey || event.altKey || rows.length === 0) return;
  const shown = [...rowBox.querySelectorAll("details.finding:not([hidden])")];
  const at = shown.indexOf(chosen);
  const next = shown[at < 0 ? 0 : at + way];
  if (!next) return;
  event.preventDefault();
  if (chosen && chosen !== next) chosen.open = false;
  choose(Number(next.dataset.index), true);
});


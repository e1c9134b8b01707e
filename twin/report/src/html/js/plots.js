// Plots: a cursor that all share, and the values under it.

/** Value of a line at a time; null in a gap or outside. */
function valueAt(line, timeS) {
  const k = lastNotAfter(line.t.length, (i) => line.t[i], timeS);
  if (k < 0) return null;
  const [from, to] = [line.v[k], line.v[k + 1]];
  if (k + 1 >= line.t.length) return timeS <= line.t[k] + 1e-3 * data.total ? from : null;
  if (from === null || to === null) return null;
  const span = line.t[k + 1] - line.t[k];
  return span > 0 ? from + ((to - from) * (timeS - line.t[k])) / span : to;
}

/** Three digits that count. */
function short(value) {
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-3 || size >= 1e5)) return value.toExponential(1);
  return size >= 99.95 ? value.toFixed(0) : size >= 9.995 ? value.toFixed(1) : size >= 0.0995 || size === 0 ? value.toFixed(2) : value.toFixed(3);
}

/** Values of a plot at a time, the first three lines of it. */
function reading(plot, timeS) {
  const unit = plot.unit ? ` ${plot.unit}` : "";
  const told = plot.lines.slice(0, 3).map((line) => {
    const value = valueAt(line, timeS);
    const text = value === null ? "–" : short(value) + unit;
    return plot.lines.length > 1 ? `${line.name} ${text}` : text;
  });
  return `${clock(timeS)}  ${told.join(", ")}`;
}

const [LEFT, RIGHT, TOP, BOTTOM, WIDTH] = data.field;
document.querySelectorAll("figure[data-plot]").forEach((figure) => {
  const plot = data.plots[Number(figure.dataset.plot)];
  const svg = figure.querySelector("svg[role=img]");
  const told = figure.querySelector(".reading");
  const cursor = document.createElementNS(svg.namespaceURI, "path");
  cursor.setAttribute("class", "cursor-line");
  svg.append(cursor);
  const bottom = svg.viewBox.baseVal.height - BOTTOM;
  const length = WIDTH - LEFT - RIGHT;
  watchers.push((timeS) => {
    const x = LEFT + (length * timeS) / data.total;
    cursor.setAttribute("d", `M${x.toFixed(1)} ${TOP}V${bottom}`);
    told.textContent = reading(plot, timeS);
  });

  const timeOf = (event) => {
    const box = svg.getBoundingClientRect();
    const x = ((event.clientX - box.left) / box.width) * WIDTH;
    return (data.total * Math.min(Math.max(x - LEFT, 0), length)) / length;
  };
  svg.addEventListener("pointermove", (event) => { if (event.pointerType === "mouse") seek(timeOf(event)); });
  svg.addEventListener("pointerdown", (event) => seek(timeOf(event)));

  figure.tabIndex = 0;
  figure.setAttribute("aria-label", `${figure.querySelector("h3").textContent}; arrow keys move the time`);
  figure.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: -0.005, ArrowRight: 0.005, PageUp: -0.05, PageDown: 0.05 }[event.key];
    const end = { Home: 0, End: data.total }[event.key];
    if (step === undefined && end === undefined) return;
    event.preventDefault();
    seek(end ?? nowS + step * data.total);
    told.setAttribute("aria-live", "polite");
  });
  figure.addEventListener("blur", () => told.setAttribute("aria-live", "off"));
});


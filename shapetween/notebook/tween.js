// Two drawings in matched hues with pins, and the movement under a slider.

const NS = "http://www.w3.org/2000/svg";
const STRETCHES = 24, REACH = 14;

const node = (name, attributes, parent) => {
  const made = document.createElementNS(NS, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (parent) parent.append(made);
  return made;
};

function nearest(points, [x, y]) {
  let best = { place: 0, point: points[0], distance: Infinity };
  points.forEach(([ax, ay], i) => {
    const [bx, by] = points[(i + 1) % points.length], dx = bx - ax, dy = by - ay;
    const square = dx * dx + dy * dy;
    const t = square ? Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / square)) : 0;
    const point = [ax + t * dx, ay + t * dy], distance = Math.hypot(point[0] - x, point[1] - y);
    if (distance < best.distance) best = { place: i + t, point, distance };
  });
  return best;
}

function at(points, place) {
  const i = Math.floor(place) % points.length, t = place - Math.floor(place);
  const [ax, ay] = points[i], [bx, by] = points[(i + 1) % points.length];
  return [ax + t * (bx - ax), ay + t * (by - ay)];
}

function harmless(text) {
  const parsed = new DOMParser().parseFromString(text.replace(/<style>[\s\S]*?<\/style>/g, ""), "image/svg+xml");
  const root = document.importNode(parsed.documentElement, true);
  for (const child of [root, ...root.querySelectorAll("*")]) {
    if (/^(script|foreignobject|a)$/i.test(child.localName)) child.remove();
    for (const { name, value } of [...child.attributes]) {
      if (/^on/i.test(name) || (/href$/i.test(name) && !/^(#|data:image\/)/i.test(value))) child.removeAttribute(name);
    }
  }
  return root;
}

function render({ model, el }) {
  const root = el.attachShadow ? el.attachShadow({ mode: "open" }) : el;
  const style = document.createElement("style");
  style.textContent = `
    .row { display: grid; grid-template-columns: repeat(3, minmax(0, 1fr)); gap: 10px; font: 13px system-ui, sans-serif; }
    .row > div { background: #fff; border: 1px solid #ccc; border-radius: 8px; overflow: hidden; aspect-ratio: 1; }
    svg { display: block; width: 100%; height: 100%; touch-action: none; }
    .art { opacity: .3; pointer-events: none; } .hue { fill: none; stroke-width: 4; vector-effect: non-scaling-stroke; pointer-events: none; }
    .pin { cursor: grab; outline: none; } .pin circle { fill: #1d1d22; stroke: #fff; stroke-width: 2.5; vector-effect: non-scaling-stroke; }
    .pin:focus circle { stroke: #4b3fd1; } .pin text { fill: #fff; font-weight: 700; text-anchor: middle; dominant-baseline: central; pointer-events: none; }
    input { width: 100%; box-sizing: border-box; accent-color: #4b3fd1; margin: 8px 0 0; } ul { margin: 4px 0 0; padding-left: 18px; font: 12px system-ui, sans-serif; color: #8a4b00; }`;
  const row = document.createElement("div"), slider = document.createElement("input"), said = document.createElement("ul");
  row.className = "row";
  Object.assign(slider, { type: "range", min: 0, max: 1, step: 0.001 });
  slider.setAttribute("aria-label", "Time");
  root.append(style, row, slider, said);
  const panes = ["a", "b", "stage"].map(() => row.appendChild(document.createElement("div")));
  const views = ["a", "b"].map((side, k) => {
    const svg = node("svg", { "aria-label": k ? "Second drawing" : "First drawing" }, panes[k]);
    return { side, k, svg, art: node("g", { class: "art" }, svg), hues: node("g", {}, svg), pins: node("g", {}, svg) };
  });
  let drag = null, moving = null, url = [];

  const view = () => model.get("_view");
  // Pins are in each drawing's own units; both drawings are shown in the first one's frame.
  const shown = (k, [x, y]) => { const [s, dx, dy] = k ? view().back : [1, 0, 0]; return [s * x + dx, s * y + dy]; };
  const own = (k, [x, y]) => { const [s, dx, dy] = k ? view().back : [1, 0, 0]; return [(x - dx) / s, (y - dy) / s]; };
  const end = (pin, k) => shown(k, pin.slice(2 * k, 2 * k + 2));
  const round = (v) => Number(v.toPrecision(6));
  const rings = (k) => view().rings.map((ring) => ring[k ? "b" : "a"].map((p) => shown(k, p)));
  const pixel = (svg) => { const m = svg.getScreenCTM(); return m ? 1 / m.a : 1; };
  const pointer = (svg, e) => { const p = new DOMPoint(e.clientX, e.clientY).matrixTransform(svg.getScreenCTM().inverse()); return [p.x, p.y]; };

  function closest(k, point) {
    let best = null;
    rings(k).forEach((points, ring) => { const f = nearest(points, point); if (!best || f.distance < best.distance) best = { ...f, ring }; });
    return best;
  }

  function setPins(pins) { model.set("pins", pins); model.save_changes(); }

  function put(index, k, point) {
    const p = own(k, point).map(round);
    setPins(model.get("pins").map((pin, i) => (i === index ? (k ? [...pin.slice(0, 2), ...p] : [...p, ...pin.slice(2)]) : pin)));
  }

  function draw() {
    const { box: [x, y, w, h], ends } = view(), m = 0.06 * Math.max(w, h);
    url.forEach((u) => URL.revokeObjectURL(u));
    url = ends.map((text) => URL.createObjectURL(new Blob([text], { type: "image/svg+xml" })));
    for (const v of views) {
      v.svg.setAttribute("viewBox", `${x - m} ${y - m} ${w + 2 * m} ${h + 2 * m}`);
      v.art.replaceChildren();
      node("image", { href: url[v.k], x, y, width: w, height: h }, v.art);
      v.hues.replaceChildren();
      rings(v.k).forEach((points, r) => {
        for (let s = 0; s < STRETCHES; s++) {
          const from = Math.floor((s * points.length) / STRETCHES), to = Math.floor(((s + 1) * points.length) / STRETCHES);
          const d = points.slice(from, to + 1).concat(to === points.length ? [points[0]] : []).map((p) => p.join(" ")).join("L");
          const share = (s + 0.5) / STRETCHES, light = 0.48 + 0.11 * (1 - Math.cos(4 * Math.PI * share));
          node("path", { class: "hue", d: `M${d}`, stroke: `oklch(${light} 0.17 ${(360 * (share + r * 0.382)) % 360})` }, v.hues);
        }
      });
    }
    moving = harmless(view().svg);
    moving.style.width = moving.style.height = "100%";
    panes[2].replaceChildren(moving);
    moving.pauseAnimations();
    seek();
    drawPins();
    said.replaceChildren(...model.get("warnings").map((line) => Object.assign(document.createElement("li"), { textContent: line })));
  }

  function drawPins() {
    for (const v of views) {
      const pins = model.get("pins"), px = pixel(v.svg);
      while (v.pins.children.length > pins.length) v.pins.lastChild.remove();
      pins.forEach((pin, i) => {
        const g = v.pins.children[i] || handle(v, i), [x, y] = end(pin, v.k);
        g.setAttribute("transform", `translate(${x} ${y})`);
        g.firstChild.setAttribute("r", 9 * px);
        g.lastChild.setAttribute("font-size", 11 * px);
        g.setAttribute("aria-valuetext", pin.slice(2 * v.k, 2 * v.k + 2).join(", "));
      });
    }
  }

  function handle(v, i) {
    const g = node("g", { class: "pin", tabindex: 0, role: "slider", "aria-label": `Pin ${i + 1}`, "aria-valuenow": 0 }, v.pins);
    node("circle", {}, g);
    node("text", {}, g).textContent = i + 1;
    g.addEventListener("keydown", (e) => {
      const step = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[e.key];
      if (step) {
        e.preventDefault();
        const found = closest(v.k, end(model.get("pins")[i], v.k)), points = rings(v.k)[found.ring];
        put(i, v.k, at(points, (found.place + (e.shiftKey ? 8 : 1) * step + points.length) % points.length));
      } else if (e.key === "Delete" || e.key === "Backspace") { e.preventDefault(); setPins(model.get("pins").filter((_, j) => j !== i)); }
      e.stopPropagation(); // a notebook has keys of its own
    });
    return g;
  }

  function seek() { if (moving) moving.setCurrentTime(Math.min(model.get("t"), 0.9999)); slider.value = model.get("t"); }

  for (const v of views) {
    v.svg.addEventListener("pointerdown", (e) => {
      const point = pointer(v.svg, e), px = pixel(v.svg), pins = model.get("pins");
      let index = pins.findIndex((pin) => Math.hypot(end(pin, v.k)[0] - point[0], end(pin, v.k)[1] - point[1]) < REACH * px);
      if (index < 0) {
        const found = closest(v.k, point);
        if (!found || found.distance > REACH * px) return;
        const ends = [0, 1].flatMap((k) => own(k, at(rings(k)[found.ring], found.place)).map(round));
        index = pins.length;
        setPins([...pins, ends]);
      }
      e.preventDefault();
      v.svg.setPointerCapture(e.pointerId);
      drag = { k: v.k, index, points: rings(v.k)[closest(v.k, point).ring], from: [e.clientX, e.clientY] };
    });
    v.svg.addEventListener("pointermove", (e) => {
      if (!drag || drag.k !== v.k || Math.hypot(e.clientX - drag.from[0], e.clientY - drag.from[1]) < 4) return;
      drag.from = [-1e9, -1e9];
      put(drag.index, v.k, nearest(drag.points, pointer(v.svg, e)).point);
    });
    for (const name of ["pointerup", "pointercancel"]) v.svg.addEventListener(name, () => { drag = null; });
  }
  slider.addEventListener("input", () => { model.set("t", Number(slider.value)); model.save_changes(); seek(); });
  model.on("change:_view", draw);
  model.on("change:pins", drawPins);
  model.on("change:t", seek);
  const watch = new ResizeObserver(drawPins);
  watch.observe(row);
  draw();
  return () => { watch.disconnect(); url.forEach((u) => URL.revokeObjectURL(u)); };
}

export default { render };

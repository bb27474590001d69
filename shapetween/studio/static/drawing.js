// One drawing beside its partner: the art, pale, and over it the outline in hues that say what
// becomes what: the same hue is the same place.

import { at } from "./geometry.js";

const NS = "http://www.w3.org/2000/svg";
const STRETCHES = 24, MARGIN = 0.06;

export function element(name, attributes = {}, parent = null) {
  const made = document.createElementNS(NS, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (parent) parent.append(made);
  return made;
}

/** Hue around the circle, lightness up and down twice, so that eyes that see few hues see it too. */
export function hue(share, dark = false, offset = 0) {
  const angle = 360 * (((share + offset) % 1) + 1) % 360;
  const wave = 0.5 - 0.5 * Math.cos(4 * Math.PI * share);
  const light = (dark ? 0.62 : 0.48) + 0.22 * wave;
  return `oklch(${light.toFixed(3)} 0.17 ${angle.toFixed(0)})`;
}

export class DrawingView {
  constructor(svg, side) {
    this.svg = svg;
    this.side = side;
    this.art = element("g", { class: "art" }, svg);
    this.hues = element("g", { "aria-hidden": "true" }, svg);
    this.parts = element("g", {}, svg);
    this.pins = element("g", {}, svg);
    this.ghost = element("circle", { class: "ghost", visibility: "hidden" }, svg);
    this.url = null;
    this.box = [0, 0, 1, 1];
    this.name = null;
  }

  /** Show another drawing. */
  show(view) {
    if (this.name === view.name) return;
    this.name = view.name;
    const [x, y, w, h] = (this.box = view.box);
    const margin = MARGIN * Math.max(w, h);
    this.svg.setAttribute("viewBox", `${x - margin} ${y - margin} ${w + 2 * margin} ${h + 2 * margin}`);
    if (this.url) URL.revokeObjectURL(this.url);
    this.url = URL.createObjectURL(new Blob([view.svg], { type: "image/svg+xml" }));
    this.art.replaceChildren();
    element("image", { href: this.url, x, y, width: w, height: h }, this.art);
    this.hues.replaceChildren();
    this.hide();
  }

  /** Colour the outlines. */
  colour(rings, dark) {
    const made = [];
    rings.forEach((ring, index) => {
      const points = ring[this.side], n = points.length, offset = index * 0.381966;
      for (let k = 0; k < STRETCHES; k++) {
        const from = (k * n) / STRETCHES, to = ((k + 1) * n) / STRETCHES;
        const inner = [];
        for (let i = Math.ceil(from + 1e-9); i < to; i++) inner.push(points[i]);
        const ends = [at(points, ring.closed, from), at(points, ring.closed, to)];
        const d = [ends[0], ...inner, ends[1]].map((p) => p.join(" ")).join("L");
        made.push(element("path", { class: ring.hole ? "hue hole" : "hue", d: `M${d}`, stroke: hue((k + 0.5) / STRETCHES, dark, offset) }));
      }
    });
    this.hues.replaceChildren(...made);
  }

  /** Where on the drawing the pointer is. */
  point(event) {
    const p = new DOMPoint(event.clientX, event.clientY).matrixTransform(this.svg.getScreenCTM().inverse());
    return [p.x, p.y];
  }

  /** So many user units are one pixel. */
  get pixel() {
    const matrix = this.svg.getScreenCTM();
    return matrix ? 1 / matrix.a : 1;
  }

  /** A dot that says: this is what the other dot becomes. */
  pointOut([x, y]) {
    this.ghost.setAttribute("cx", x);
    this.ghost.setAttribute("cy", y);
    this.ghost.setAttribute("r", 5.5 * this.pixel);
    this.ghost.setAttribute("visibility", "visible");
  }

  hide() { this.ghost.setAttribute("visibility", "hidden"); }
}

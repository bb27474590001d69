// Pins: a place of one outline and the place of the other that it becomes. A click sets both ends
// where the matching has them already, so nothing moves until one end is dragged.

import { apart, at, nearest, nearestOfAll, ringOf, rounded } from "./geometry.js";
import { element } from "./drawing.js";
import * as state from "./state.js";

const REACH = 16, SLIP = 4, FAR = 0.15, RADIUS = 9;

export class Pins {
  /**
   * views      {a, b}: DrawingView
   * rings      () => the matched rings of the leg
   * moving     told while an end is dragged
   * enabled    () => whether clicks are for pins
   */
  constructor(views, rings, moving, enabled, say) {
    Object.assign(this, { views, rings, moving, enabled, say });
    this.drag = null;
    for (const side of ["a", "b"]) {
      const svg = views[side].svg;
      svg.addEventListener("pointerdown", (e) => this.down(e, side));
      svg.addEventListener("pointermove", (e) => this.move(e, side));
      svg.addEventListener("pointerup", (e) => this.up(e, side));
      svg.addEventListener("pointercancel", (e) => this.up(e, side));
      svg.addEventListener("pointerleave", () => this.unpoint());
    }
  }

  other(side) { return side === "a" ? "b" : "a"; }

  end(pin, side) { return side === "a" ? pin.slice(0, 2) : pin.slice(2); }

  withEnd(pin, side, point) { return side === "a" ? [...point, ...pin.slice(2)] : [...pin.slice(0, 2), ...point]; }

  /** The pin at the pointer, or -1. */
  hit(side, point) {
    const view = this.views[side];
    let best = -1, least = REACH * view.pixel;
    state.leg().pins.forEach((pin, k) => {
      const [x, y] = this.end(pin, side), d = Math.hypot(x - point[0], y - point[1]);
      if (d < least) { least = d; best = k; }
    });
    return best;
  }

  /** A pin for a place, as the matching has it now. */
  born(found) {
    const ring = this.rings()[found.ring], points = {};
    for (const side of ["a", "b"]) points[side] = rounded(at(ring[side], ring.closed, found.place), this.views[side].box);
    return [...points.a, ...points.b];
  }

  /** One more pin. Where another than the best matching was taken, three more hold it. */
  append(made, merge = null) {
    state.changeLeg((l) => {
      if (l.matching === 1) return { pins: [...l.pins, made] };
      const index = ringOf(this.rings(), made), ring = this.rings()[index], n = ring.a.length;
      const { place } = nearest(ring.a, ring.closed, made.slice(0, 2));
      const holding = [1, 2, 3].map((k) => this.born({ ring: index, place: place + (k * n) / 4 }));
      return { pins: [...l.pins, made, ...holding], matching: 1 };
    }, merge);
  }

  down(event, side) {
    if (!this.enabled() || event.button !== 0 || !this.rings().length) return;
    const view = this.views[side], point = view.point(event);
    let pin = this.hit(side, point), fresh = false, made = null;
    if (pin < 0) {
      const found = nearestOfAll(this.rings(), side, point);
      if (!found || found.distance > REACH * view.pixel) return;
      made = this.born(found);
      pin = state.leg().pins.length;
      fresh = true;
    }
    event.preventDefault();
    view.svg.setPointerCapture(event.pointerId); // not the pin, which is drawn anew on the way
    const rings = this.rings(), value = made || state.leg().pins[pin];
    this.drag = { side, pin, fresh, made, ring: rings[ringOf(rings, value)], at: [event.clientX, event.clientY], moved: false, key: `drag ${Date.now()}` };
    state.settle();
    if (fresh) this.append(made, this.drag.key);
    this.unpoint();
    this.focus(side, pin);
  }

  move(event, side) {
    const drag = this.drag;
    if (!drag) { this.hover(event, side); return; }
    if (drag.side !== side) return;
    const far = Math.hypot(event.clientX - drag.at[0], event.clientY - drag.at[1]);
    if (!drag.moved && far < SLIP) return;
    drag.moved = true;
    const view = this.views[side], points = drag.ring[side];
    const found = nearest(points, drag.ring.closed, view.point(event));
    this.put(drag.pin, side, found.point, drag.key);
    this.moving(true);
  }

  up(event, side) {
    const drag = this.drag;
    if (!drag || drag.side !== side) return;
    this.drag = null;
    state.settle();
    this.moving(false);
    if (drag.fresh && !drag.moved) this.say("A pin, where the matching has it. Drag either end to move it.");
  }

  put(pin, side, point, merge) {
    const place = rounded(point, this.views[side].box);
    state.changeLeg((l) => ({ pins: l.pins.map((p, k) => (k === pin ? this.withEnd(p, side, place) : p)) }), merge);
  }

  remove(pin) {
    state.settle();
    state.changeLeg((l) => ({ pins: l.pins.filter((_, k) => k !== pin) }));
  }

  /** A pin at the middle of the longest stretch without one. */
  add() {
    const rings = this.rings();
    if (!rings.length || !this.enabled()) return;
    const ring = rings[0], n = ring.a.length;
    const taken = state.leg().pins.filter((p) => rings[ringOf(rings, p)] === ring);
    const places = taken.map((p) => nearest(ring.a, ring.closed, p.slice(0, 2)).place).sort((x, y) => x - y);
    let place = 0, most = -1;
    places.forEach((p, k) => {
      const next = k + 1 < places.length ? places[k + 1] : places[0] + n;
      if (next - p > most) { most = next - p; place = (p + next) / 2; }
    });
    const made = this.born({ ring: 0, place });
    state.settle();
    this.append(made);
    this.focus("a", state.leg().pins.length - 1);
  }

  /** One step along the outline, by the keyboard. */
  step(pin, side, steps) {
    const rings = this.rings(), value = state.leg().pins[pin], ring = rings[ringOf(rings, value)];
    if (!ring) return;
    const found = nearest(ring[side], ring.closed, this.end(value, side));
    this.put(pin, side, at(ring[side], ring.closed, found.place + steps), `step ${pin} ${side}`);
    this.moving(true);
  }

  hover(event, side) {
    if (!this.enabled() || !this.rings().length) return;
    const view = this.views[side], point = view.point(event);
    const found = nearestOfAll(this.rings(), side, point);
    if (!found || found.distance > REACH * view.pixel || this.hit(side, point) >= 0) { this.unpoint(); return; }
    const ring = this.rings()[found.ring];
    for (const s of ["a", "b"]) this.views[s].pointOut(at(ring[s], ring.closed, found.place));
  }

  unpoint() { for (const side of ["a", "b"]) this.views[side].hide(); }

  focus(side, pin) {
    const node = this.views[side].pins.children[pin];
    if (node) node.focus({ preventScroll: true });
  }

  /** What is to be said of a pin: that it lies far from where the matching without it goes, or across another one. */
  warnings(free) {
    const pins = state.leg().pins, said = pins.map(() => "");
    if (!free.length) return said;
    const placed = pins.map((pin) => {
      const index = ringOf(free, pin), ring = free[index];
      const a = nearest(ring.a, ring.closed, pin.slice(0, 2)).place, b = nearest(ring.b, ring.closed, pin.slice(2)).place;
      return { index, ring, a, b };
    });
    placed.forEach((p, k) => {
      if (apart(p.ring, p.a, p.b) > FAR) said[k] = "far from where it would go by itself";
    });
    for (let i = 0; i < placed.length; i++) {
      for (let j = 0; j < i; j++) {
        const p = placed[i], q = placed[j], n = p.ring.a.length;
        if (p.index !== q.index) continue;
        const turn = (x) => { const r = (((x % n) + n) % n) / n; return r > 0.5 ? r - 1 : r; };
        const one = turn(p.a - q.a), other = turn(p.b - q.b);
        const near = Math.max(Math.abs(one), Math.abs(other)) < 0.5 - FAR;
        if (near && one * other < 0) said[i] = said[i] || `in another order than pin ${j + 1}`;
      }
    }
    return said;
  }

  /** Draw both ends of every pin. */
  draw(said) {
    const pins = state.leg().pins;
    for (const side of ["a", "b"]) {
      const view = this.views[side], px = view.pixel, group = view.pins;
      while (group.children.length > pins.length) group.lastChild.remove();
      pins.forEach((pin, k) => {
        const [x, y] = this.end(pin, side);
        const node = group.children[k] || this.node(view, side, k);
        node.setAttribute("transform", `translate(${x} ${y})`);
        node.setAttribute("class", said[k] ? "pin far" : "pin");
        node.classList.toggle("held", Boolean(this.drag && this.drag.pin === k));
        node.setAttribute("aria-valuetext", `${x}, ${y}${said[k] ? `, ${said[k]}` : ""}`);
        node.setAttribute("aria-valuenow", this.percent(pin, side));
        node.firstChild.setAttribute("r", RADIUS * px);
        node.lastChild.setAttribute("font-size", 11 * px);
        node.lastChild.textContent = k + 1;
      });
    }
  }

  percent(pin, side) {
    const rings = this.rings(), ring = rings[ringOf(rings, pin)];
    if (!ring) return 0;
    return Math.round((100 * nearest(ring[side], ring.closed, this.end(pin, side)).place) / ring[side].length);
  }

  node(view, side, k) {
    const which = side === "a" ? "first" : "second";
    const node = element("g", { tabindex: 0, role: "slider", "aria-label": `Pin ${k + 1} on the ${which} drawing`, "aria-valuemin": 0, "aria-valuemax": 100 }, view.pins);
    element("circle", {}, node);
    element("text", { "aria-hidden": "true" }, node);
    node.addEventListener("keydown", (event) => {
      const steps = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: 8, PageDown: -8 }[event.key];
      if (steps && !event.ctrlKey && !event.metaKey) {
        event.preventDefault();
        this.step(k, side, event.shiftKey ? 8 * steps : steps);
      } else if (event.key === "Delete" || event.key === "Backspace") {
        event.preventDefault();
        this.remove(k);
        this.focus(side, Math.max(0, k - 1));
      }
    });
    node.addEventListener("keyup", () => this.moving(false));
    return node;
  }
}

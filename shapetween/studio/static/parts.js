// Parts: which shape becomes which. A click on a shape of A and then on one of B makes them a pair;
// with Shift several; Delete says that it becomes nothing.

import { element, hue } from "./drawing.js";
import * as state from "./state.js";

const sides = (match) => match.split(":").map((side) => side.split(",").filter(Boolean));
const other = (side) => (side === "a" ? "b" : "a");

export class Parts {
  /** pairs() gives the pairs of the leg: numbers of shapes of A and B, 0 for none. */
  constructor(views, shapes, pairs, list, say) {
    Object.assign(this, { views, shapes, pairs, list, say });
    this.chosen = null; // {side, key}
    this.on = false;
  }

  show(on) {
    this.on = on;
    this.chosen = null;
    this.list.hidden = !on;
    for (const side of ["a", "b"]) {
      this.views[side].parts.replaceChildren();
      this.views[side].pins.setAttribute("display", on ? "none" : "inline");
      this.views[side].hues.setAttribute("display", on ? "none" : "inline");
    }
    if (on) this.draw();
  }

  /** Shapes of the other drawing that a shape becomes. */
  partners(side, number) {
    return this.pairs().filter((p) => p[side] === number && p[other(side)]).map((p) => p[other(side)]);
  }

  draw() {
    if (!this.on) return;
    const held = document.activeElement && document.activeElement.getAttribute && document.activeElement.getAttribute("data-part");
    for (const side of ["a", "b"]) {
      const made = this.shapes(side).map((shape, k) => this.part(side, shape, k + 1));
      this.views[side].parts.replaceChildren(...made);
    }
    if (held) { const node = document.querySelector(`[data-part="${held}"]`); if (node) node.focus({ preventScroll: true }); }
    this.listed();
  }

  part(side, shape, number) {
    const becomes = this.partners(side, number);
    const text = becomes.length ? `becomes ${becomes.map((n) => `#${n}`).join(" and ")}` : "becomes nothing";
    const node = element("path", { class: "part", d: shape.d, tabindex: 0, role: "button", "data-part": `${side}${number}`, "aria-label": `Part #${number}${shape.key.startsWith("#") ? "" : `, ${shape.key}`}, ${text}` });
    const colour = this.colour(side, number);
    if (colour) { node.setAttribute("fill", colour); node.setAttribute("stroke", colour); }
    if (!shape.d.includes("Z")) node.classList.add("open");
    if (this.chosen && this.chosen.side === side && this.chosen.number === number) { node.classList.add("chosen"); node.setAttribute("aria-pressed", "true"); }
    const near = (yes) => {
      for (const n of becomes) {
        const partner = this.views[other(side)].parts.children[n - 1];
        if (partner) partner.classList.toggle("near", yes);
      }
    };
    node.addEventListener("pointerenter", () => near(true));
    node.addEventListener("pointerleave", () => near(false));
    node.addEventListener("focus", () => near(true));
    node.addEventListener("blur", () => near(false));
    node.addEventListener("click", (event) => this.click(side, number, event.shiftKey));
    node.addEventListener("keydown", (event) => {
      if (event.key === "Enter" || event.key === " ") { event.preventDefault(); event.stopPropagation(); this.click(side, number, event.shiftKey); }
      else if (event.key === "Delete" || event.key === "Backspace") { event.preventDefault(); this.alone(side, number); }
      else if (event.key === "Escape") { this.chosen = null; this.draw(); }
    });
    return node;
  }

  /** The same for shapes that become each other; none for what comes or goes alone. */
  colour(side, number) {
    const known = this.pairs().filter((p) => p.a && p.b), k = known.findIndex((p) => p[side] === number);
    if (k < 0) return null;
    const first = known.findIndex((p) => p.a === known[k].a || p.b === known[k].b);
    return hue(first * 0.381966 % 1, document.body.dataset.paper === "dark");
  }

  click(side, number, more) {
    const chosen = this.chosen;
    if (!chosen || chosen.side === side) {
      this.chosen = chosen && chosen.number === number && chosen.side === side ? null : { side, number };
      if (this.chosen) this.say(`Now click what #${number} ${side === "a" ? "becomes" : "comes from"}. With Shift several; Delete for nothing.`);
      this.draw();
      return;
    }
    const pair = { [chosen.side]: `#${chosen.number}`, [side]: `#${number}` };
    this.match(pair, chosen.side, more);
    if (!more) this.chosen = null;
    this.draw();
  }

  match(pair, held, more) {
    state.settle();
    state.changeLeg((leg) => {
      const kept = [];
      let mine = { a: [pair.a], b: [pair.b] };
      for (const match of leg.matches) {
        const [a, b] = sides(match);
        const same = (held === "a" ? a : b).includes(pair[held]);
        if (more && same) mine = { a: [...new Set([...a, pair.a])], b: [...new Set([...b, pair.b])] };
        else if (!a.includes(pair.a) && !b.includes(pair.b)) kept.push(match);
      }
      return { matches: [...kept, `${mine.a.join(",")}:${mine.b.join(",")}`], matching: 1 };
    });
  }

  /** It becomes nothing, or comes from nothing. */
  alone(side, number) {
    const key = `#${number}`;
    state.settle();
    state.changeLeg((leg) => ({
      matches: [...leg.matches.filter((m) => !sides(m)[side === "a" ? 0 : 1].includes(key)), side === "a" ? `${key}:` : `:${key}`],
      matching: 1,
    }));
    this.chosen = null;
  }

  /** What has been settled, with a way to take it back. */
  listed() {
    const { matches } = state.leg();
    this.list.replaceChildren();
    if (!matches.length) return;
    const table = document.createElement("table");
    table.innerHTML = "<thead><tr><th>Of A</th><th>Of B</th><th></th></tr></thead><tbody></tbody>";
    matches.forEach((match, k) => {
      const row = table.tBodies[0].insertRow();
      const [a, b] = sides(match);
      row.insertCell().textContent = a.join(", ") || "nothing";
      row.insertCell().textContent = b.join(", ") || "nothing";
      const remove = Object.assign(document.createElement("button"), { className: "plain", textContent: "Remove" });
      remove.setAttribute("aria-label", `Remove pair ${k + 1}`);
      remove.addEventListener("click", () => {
        state.settle();
        state.changeLeg((leg) => ({ matches: leg.matches.filter((_, i) => i !== k) }));
      });
      row.insertCell().append(remove);
    });
    this.list.append(table);
  }
}

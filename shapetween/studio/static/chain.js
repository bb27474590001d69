// The strip of drawings: each moves to the next. Drag them, or use the arrow keys, to reorder.

import * as state from "./state.js";

export class Chain {
  /** view(name) gives a drawing as the server told of it; `add` asks for files. */
  constructor(nav, view, add) {
    Object.assign(this, { nav, view, add, urls: new Map(), dragged: -1 });
  }

  url(name) {
    if (!this.urls.has(name)) this.urls.set(name, URL.createObjectURL(new Blob([this.view(name).svg], { type: "image/svg+xml" })));
    return this.urls.get(name);
  }

  draw() {
    const { drawings, leg, legs } = state.current();
    const held = document.activeElement && document.activeElement.id;
    this.nav.replaceChildren();
    if (!drawings.length) return;
    drawings.forEach((name, k) => {
      this.nav.append(this.item(name, k));
      if (k < legs.length) this.nav.append(this.leg(k, k === leg, legs.length));
    });
    const closed = drawings.length > 2 && drawings[0] === drawings.at(-1);
    this.nav.append(button("Add…", "Add drawings to the end", this.add, "chain-add"));
    if (drawings.length > 2 && !closed) this.nav.append(button("Close the round", "Come back to the first drawing", () => this.set([...drawings, drawings[0]]), "chain-close"));
    if (drawings.length === 2) this.nav.append(button("Swap", "Exchange the two drawings", () => this.swap(), "chain-swap"));
    if (held && document.getElementById(held)) document.getElementById(held).focus();
  }

  item(name, k) {
    const box = document.createElement("div"), image = document.createElement("img"), text = document.createElement("span");
    box.className = "item";
    box.draggable = true;
    image.src = this.url(name);
    image.alt = "";
    text.textContent = name;
    box.title = name;
    box.append(image, text);
    if (k > 0) box.append(button("‹", `Move ${name} forward`, () => this.move(k, k - 1), `chain-move-${k}`, "plain"));
    box.append(button("×", `Remove ${name}`, () => this.set(state.current().drawings.filter((_, i) => i !== k)), `chain-remove-${k}`, "plain"));
    box.addEventListener("dragstart", (e) => { this.dragged = k; e.dataTransfer.effectAllowed = "move"; e.dataTransfer.setData("text/x-drawing", String(k)); });
    box.addEventListener("dragover", (e) => { if (this.dragged >= 0) { e.preventDefault(); box.classList.add("over"); } });
    box.addEventListener("dragleave", () => box.classList.remove("over"));
    box.addEventListener("drop", (e) => { if (this.dragged >= 0) { e.preventDefault(); e.stopPropagation(); this.move(this.dragged, k); this.dragged = -1; } });
    box.addEventListener("dragend", () => { this.dragged = -1; });
    return box;
  }

  leg(k, pressed, count) {
    const { drawings, legs } = state.current(), { pins, matches, matching } = legs[k];
    const counted = (n, what) => (n ? [`${n} ${what}${n > 1 ? "s" : ""}`] : []);
    const settled = [...counted(pins.length, "pin"), ...counted(matches.length, "pair"), ...(matching > 1 ? [`no. ${matching}`] : [])];
    const text = ["→", settled.join(", ")].filter(Boolean).join(" ");
    const title = `Look at leg ${k + 1}: ${drawings[k]} to ${drawings[k + 1]}`;
    const made = button(text, title, () => {
      state.settle();
      state.change((s) => ({ ...s, leg: k }));
    }, `chain-leg-${k}`, "leg");
    made.setAttribute("aria-label", `${text} ${title}`);
    if (count > 1) made.setAttribute("aria-pressed", pressed);
    return made;
  }

  move(from, to) {
    const drawings = [...state.current().drawings];
    drawings.splice(to, 0, ...drawings.splice(from, 1));
    this.set(drawings);
  }

  /** Two drawings the other way round, and their pins with them. */
  swap() {
    state.settle();
    state.change((s) => ({
      ...s,
      drawings: [...s.drawings].reverse(),
      legs: s.legs.map((l) => ({ ...l, matching: 1, pins: l.pins.map(([ax, ay, bx, by]) => [bx, by, ax, ay]), matches: l.matches.map((m) => m.split(":").reverse().join(":")) })),
    }));
  }

  set(drawings) {
    state.settle();
    state.change((s) => state.withDrawings(s, drawings));
  }
}

function button(text, title, action, id, kind = "") {
  const made = document.createElement("button");
  Object.assign(made, { textContent: text, title, id, className: kind });
  if (text.length < 3) made.setAttribute("aria-label", title);
  made.addEventListener("click", action);
  return made;
}

// The page: the parts, and what happens between them.

import * as api from "./api.js";
import * as state from "./state.js";
import { Alternatives } from "./alternatives.js";
import { Chain } from "./chain.js";
import { DrawingView } from "./drawing.js";
import { Exporter, download } from "./exports.js";
import { listen } from "./keys.js";
import { Panel } from "./panel.js";
import { Parts } from "./parts.js";
import { Pins } from "./pins.js";
import { Stage } from "./stage.js";

const REST = 150; // milliseconds without a change before the full result is asked for
const WORK = "shapetween-work"; // in this tab's storage: a reload loses nothing

const ids = new Proxy({}, { get: (_, id) => document.getElementById(id) });
const drawings = new Map(); // name -> what the server told of it
const views = { a: new DrawingView(ids.a, "a"), b: new DrawingView(ids.b, "b") };
const stage = new Stage({ stage: ids.stage, time: ids.time, clock: ids.clock, play: ids.play, again: ids.again });
let rings = [], free = [], pairs = [], mode = "pins", answer = null, timer = null, started = false, seen = null;

const say = (text, error = false) => {
  ids.status.textContent = text;
  ids.status.classList.toggle("error", error);
};
const failed = (error) => { if (error.status !== 409) say(error.message, true); };

const pins = new Pins(views, () => rings, (dragging) => moved(dragging), () => mode === "pins", say);
const shapes = (side) => {
  const s = state.current(), view = drawings.get(s.drawings[s.leg + (side === "b" ? 1 : 0)]);
  return view ? view.shapes : [];
};
const parts = new Parts(views, shapes, () => pairs, ids["part-list"], say);
const chain = new Chain(ids.chain, (name) => drawings.get(name), () => ids.files.click());
const alternatives = new Alternatives(ids.choices, ids.alternatives, say);
let panel, exporter;

// What is shown while something is dragged: quick, one leg, and never older than what is there.
const preview = api.latestOnly(
  (job) => api.live(job),
  (got) => { if (timer !== null || pins.drag) { stage.show(got.svg, got.seconds); setRings(got.legs[0].rings); draw(); } },
  (error) => { if (error.status !== 409) say(error.message, true); },
);
const commandLine = api.latestOnly((job) => api.command(job), (got, _, late) => { if (!late) ids.command.textContent = got.line; }, failed);

async function result() {
  timer = null;
  const asked = state.current();
  ids.state.textContent = "working…";
  ids.stage.classList.add("busy");
  try {
    const got = await api.full(state.job(asked));
    if (key(state.current()) !== key(asked)) return;
    answer = got;
    seen = key(asked);
    stage.show(got.svg, got.seconds);
    look();
    say("");
    ids.state.textContent = "";
    alternatives.refresh(state.legJob());
    if (!started) { started = true; if (!stage.still) stage.play(); }
  } catch (error) {
    if (error.status === 409) return;
    ids.state.textContent = "";
    say(error.message, true);
  } finally {
    ids.stage.classList.remove("busy");
  }
}

const key = (s) => JSON.stringify(state.job(s));

/** Show the leg that is looked at, of the result that there is. */
function look() {
  const leg = answer && answer.legs[state.current().leg];
  if (!leg) return;
  pairs = leg.pairs;
  setRings(leg.rings);
  notices(answer.warnings);
  draw();
}

function setRings(found) {
  rings = found;
  if (!state.leg().pins.length) free = found;
  const dark = document.body.dataset.paper === "dark";
  for (const side of ["a", "b"]) views[side].colour(rings, dark);
}

/** Warnings; one that names options of the command line is said as the page has it. */
function notices(lines) {
  const here = lines.map((line) => (/matched with little certainty/.test(line) ? "Matched with little certainty: look at the other matchings, or set a pin." : line));
  ids.notices.replaceChildren(...here.map((line) => Object.assign(document.createElement("li"), { textContent: line })));
}

function moved(dragging) {
  if (dragging) { preview(state.legJob()); draw(); }
  else preview.drop();
}

/** Everything of the page that depends on the work. */
function draw() {
  const s = state.current(), pair = s.drawings.slice(s.leg, s.leg + 2).map((name) => drawings.get(name));
  const ready = s.drawings.length > 1;
  for (const part of ["match", "movement", "panel"]) ids[part].hidden = !ready;
  ids.welcome.hidden = ready;
  ids["welcome-title"].textContent = s.drawings.length ? "Now the second drawing" : "Drop two drawings here";
  ids.undo.disabled = !state.canUndo();
  ids.redo.disabled = !state.canRedo();
  ids.save.disabled = ids.export.disabled = !ready;
  if (!ready) return;
  pair.forEach((view, k) => {
    views["ab"[k]].show(view);
    ids[`name-${"ab"[k]}`].textContent = `${"AB"[k]}: ${view.name}`;
  });
  const said = pins.warnings(free);
  pins.draw(said);
  table(said);
  parts.draw();
  ids["pin-list"].hidden = mode !== "pins";
  if (mode === "parts") { ids.hint.textContent = "Click a part of A and then what it becomes in B. Shift for several, Delete for nothing."; return; }
  ids.hint.textContent = s.legs[s.leg].pins.length
    ? "Drag either end of a pin along the outline. The same colour is the same place."
    : "The same colour is the same place. Click an outline to set a pin; drag it to say what becomes what.";
}

/** What clicks are for: pins or parts. */
function choose(which) {
  mode = which;
  for (const name of ["pins", "parts"]) ids[`mode-${name}`].setAttribute("aria-pressed", name === which);
  parts.show(which === "parts");
  draw();
}

/** The pins as numbers, to be read and typed. */
function table(said) {
  const list = state.leg().pins, host = ids["pin-list"];
  if (!list.length) { host.replaceChildren(); return; }
  let rows = host.querySelector("tbody");
  if (!rows || rows.children.length !== list.length) {
    const made = document.createElement("table");
    made.innerHTML = "<thead><tr><th>Pin</th><th colspan='2'>On A</th><th colspan='2'>On B</th><th></th><th></th></tr></thead><tbody></tbody>";
    rows = made.tBodies[0];
    list.forEach((_, k) => rows.append(row(k)));
    host.replaceChildren(made);
  }
  list.forEach((pin, k) => {
    const cells = rows.children[k].querySelectorAll("input");
    pin.forEach((value, i) => { if (document.activeElement !== cells[i]) cells[i].value = value; });
    rows.children[k].querySelector(".says").textContent = said[k];
  });
}

function row(k) {
  const made = document.createElement("tr");
  made.append(Object.assign(document.createElement("td"), { textContent: k + 1 }));
  ["A, x", "A, y", "B, x", "B, y"].forEach((name, i) => {
    const cell = document.createElement("td"), input = document.createElement("input");
    Object.assign(input, { type: "number", step: "any" });
    input.setAttribute("aria-label", `Pin ${k + 1} on ${name}`);
    input.addEventListener("change", () => {
      const value = Number(input.value);
      if (input.value === "" || !Number.isFinite(value)) { draw(); return; }
      state.settle();
      state.changeLeg((l) => ({ pins: l.pins.map((p, n) => (n === k ? p.map((x, m) => (m === i ? value : x)) : p)) }));
    });
    cell.append(input);
    made.append(cell);
  });
  const remove = Object.assign(document.createElement("button"), { className: "plain", textContent: "Remove" });
  remove.setAttribute("aria-label", `Remove pin ${k + 1}`);
  remove.addEventListener("click", () => pins.remove(k));
  const cell = document.createElement("td");
  cell.append(remove);
  made.append(Object.assign(document.createElement("td"), { className: "says" }), cell);
  return made;
}

state.listen((now, before) => {
  if (now.drawings.join("\n") !== before.drawings.join("\n") || now.leg !== before.leg) {
    rings = free = [];
    for (const side of ["a", "b"]) views[side].hues.replaceChildren();
  }
  if (panel) panel.show(now.options);
  chain.draw();
  draw();
  keep(now);
  if (now.drawings.length < 2) { clearTimeout(timer); timer = null; return; }
  commandLine(state.job(now));
  if (seen === key(now)) { look(); stage.show(answer.svg, answer.seconds); alternatives.refresh(state.legJob()); return; }
  clearTimeout(timer);
  timer = setTimeout(result, REST);
});

/** Remember the work in this tab, for a reload; the drawings are with the server. */
function keep(now) {
  try { sessionStorage.setItem(WORK, JSON.stringify({ ...state.job(now), leg: now.leg })); } catch { /* full or forbidden: then it is not kept */ }
}

async function take(files) {
  const list = [...files];
  const project = list.find((file) => /\.json$/i.test(file.name));
  say("Reading…");
  try {
    if (project) {
      const got = await api.open(project);
      for (const [name, view] of Object.entries(got.drawings)) drawings.set(name, view);
      begin(got.last);
      say(`Opened ${project.name}.`);
      return;
    }
    const names = [];
    for (const file of list) {
      const view = await api.drawing(file);
      drawings.set(view.name, view);
      names.push(view.name);
    }
    say("");
    state.settle();
    state.change((s) => state.withDrawings(s, [...s.drawings, ...names]));
  } catch (error) { failed(error); }
}

function begin(last) {
  const legs = (last.legs || []).map((l) => ({ ...state.LEG, ...l }));
  const names = last.drawings || [];
  state.begin({ drawings: names, legs: legs.length ? legs : names.slice(1).map(() => state.LEG), options: last.options || {}, leg: last.leg || 0 });
}

async function save() {
  try {
    const text = await api.save(state.job());
    const name = `${state.current().drawings.map((n) => n.replace(/\.svg$/i, "")).join("-to-").slice(0, 100)}.json`;
    download(name, new Blob([text], { type: "application/json" }));
    say(`Saved ${name}, with the drawings in it.`);
  } catch (error) { failed(error); }
}

for (const name of ["pins", "parts"]) ids[`mode-${name}`].addEventListener("click", () => choose(name));
const chooseFiles = () => { ids.files.value = ""; ids.files.click(); };
ids.files.addEventListener("change", () => take(ids.files.files));
for (const id of ["open", "choose"]) ids[id].addEventListener("click", chooseFiles);
ids.save.addEventListener("click", save);
ids.export.addEventListener("click", () => exporter.open());
ids.undo.addEventListener("click", state.undo);
ids.redo.addEventListener("click", state.redo);
ids.help.addEventListener("click", () => ids.keys.showModal());
ids.copy.addEventListener("click", async () => {
  try { await navigator.clipboard.writeText(ids.command.textContent); say("Copied."); }
  catch { getSelection().selectAllChildren(ids.command); say("Press Ctrl+C to copy."); }
});

for (const [id, apply] of Object.entries({
  paper: (value) => { document.body.dataset.paper = value; if (rings.length) { setRings(rings); draw(); } },
  look: (value) => { document.documentElement.dataset.look = value; },
})) {
  ids[id].value = localStorage.getItem(`shapetween-${id}`) || ids[id].value;
  apply(ids[id].value);
  ids[id].addEventListener("change", () => { localStorage.setItem(`shapetween-${id}`, ids[id].value); apply(ids[id].value); });
}

for (const name of ["dragover", "dragenter"]) {
  document.addEventListener(name, (event) => {
    if (![...event.dataTransfer.types].includes("Files")) return;
    event.preventDefault();
    document.body.classList.add("dropping");
  });
}
document.addEventListener("dragleave", (event) => { if (!event.relatedTarget) document.body.classList.remove("dropping"); });
document.addEventListener("drop", (event) => {
  document.body.classList.remove("dropping");
  if (!event.dataTransfer.files.length) return;
  event.preventDefault();
  take(event.dataTransfer.files);
});
new ResizeObserver(() => draw()).observe(ids.pair);

listen({
  " ": () => stage.toggle(),
  ",": () => stage.step(-1),
  ".": () => stage.step(1),
  Home: () => stage.seek(0),
  End: () => stage.seek(stage.seconds),
  n: () => pins.add(),
  "?": () => ids.keys.showModal(),
  "Ctrl+z": state.undo,
  "Ctrl+Shift+z": state.redo,
  "Ctrl+y": state.redo,
  "Ctrl+o": chooseFiles,
  "Ctrl+s": () => { if (!ids.save.disabled) save(); },
  "Ctrl+e": () => { if (!ids.export.disabled) exporter.open(); },
  ...Object.fromEntries([1, 2, 3, 4, 5, 6, 7, 8, 9].map((n) => [String(n), () => alternatives.take(n)])),
});

try {
  const told = await api.state();
  panel = new Panel(ids.settings, told.settings);
  exporter = new Exporter(ids.exporting, { fields: ids["export-fields"], status: ids["export-state"], go: ids["export-go"] }, told.forms);
  for (const [name, view] of Object.entries(told.drawings)) drawings.set(name, view);
  let work = null;
  try { work = JSON.parse(sessionStorage.getItem(WORK)); } catch { /* nothing kept */ }
  begin(work && work.drawings.length && work.drawings.every((name) => drawings.has(name)) ? work : told.last);
  panel.show(state.current().options);
} catch (error) { failed(error); }

"use strict";
// One clock for all panels: every animation is held, and told its time.
const panels = [...document.querySelectorAll(".panel[data-key]")];
const moving = panels.flatMap((panel) => [...panel.querySelectorAll(".paper > svg")]);
const data = JSON.parse(document.getElementById("data").textContent);
const time = document.getElementById("time");
const clock = document.getElementById("clock");
const play = document.getElementById("play");
const speed = document.getElementById("speed");
const mesh = document.getElementById("mesh");
const cursors = [...document.querySelectorAll(".plot")].map((plot) => ({
  line: plot.querySelector(".cursor"),
  width: plot.dataset.right - plot.dataset.left,
}));

const SECONDS = 2.5; // one way, at speed 1
const REST = 0.5; // at either end, likewise
let now = 0, way = 1, resting = 0, last = null;

function show(t) {
  now = Math.min(1, Math.max(0, t));
  for (const svg of moving) svg.setCurrentTime(now);
  time.value = now;
  clock.textContent = now.toFixed(2);
  for (const { line, width } of cursors) line.setAttribute("transform", `translate(${now * width})`);
  for (const panel of panels) {
    const of = data[panel.dataset.key];
    if (!of) continue;
    const k = Math.round(now * (of.area.length - 1));
    const percent = (x) => `${(100 * x).toFixed(0)} %`;
    panel.querySelector(".now").textContent =
      `area ${percent(of.area[k])} · perimeter ${percent(of.perimeter[k])}`;
    panel.classList.toggle("crossing", of.crossing[k] === 1);
  }
}

function tick(stamp) {
  if (last === null) return;
  const passed = ((stamp - last) / 1000) * speed.value;
  last = stamp;
  if (resting > 0) resting -= passed;
  else {
    show(now + (way * passed) / SECONDS);
    if (now === (way > 0 ? 1 : 0)) {
      way = -way;
      resting = REST;
    }
  }
  requestAnimationFrame(tick);
}

function run(on) {
  const runs = last !== null;
  if (on === runs) return;
  last = on ? performance.now() : null;
  resting = 0;
  if (on) requestAnimationFrame(tick);
  play.classList.toggle("on", on);
  play.setAttribute("aria-label", on ? "Pause" : "Play");
}

function seek(t) {
  run(false);
  show(t);
}

play.addEventListener("click", () => run(last === null));
time.addEventListener("input", () => seek(Number(time.value)));
mesh.addEventListener("change", () => document.body.classList.toggle("meshed", mesh.checked));

for (const plot of document.querySelectorAll(".plot")) {
  const go = (event) => {
    const at = plot.getScreenCTM().inverse();
    const x = new DOMPoint(event.clientX, event.clientY).matrixTransform(at).x;
    seek((x - plot.dataset.left) / (plot.dataset.right - plot.dataset.left));
  };
  plot.addEventListener("pointerdown", (event) => {
    plot.setPointerCapture(event.pointerId);
    go(event);
  });
  plot.addEventListener("pointermove", (event) => event.buttons && go(event));
}

document.getElementById("theme").addEventListener("click", () => {
  const root = document.documentElement;
  const dark = root.dataset.theme
    ? root.dataset.theme === "dark"
    : matchMedia("(prefers-color-scheme: dark)").matches;
  root.dataset.theme = dark ? "light" : "dark";
});

const STEP = 1 / 60;
const KEYS = {
  " ": () => run(last === null),
  k: () => run(last === null),
  ArrowLeft: (far) => seek(now - (far ? 6 : 1) * STEP),
  ArrowRight: (far) => seek(now + (far ? 6 : 1) * STEP),
  Home: () => seek(0),
  End: () => seek(1),
  m: () => mesh.click(),
  "<": () => (speed.selectedIndex = Math.max(0, speed.selectedIndex - 1)),
  ">": () => (speed.selectedIndex = Math.min(speed.length - 1, speed.selectedIndex + 1)),
};
document.addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  // Controls keep the keys that they know themselves; the slider's steps are ours.
  const held = event.target.closest("button, select, summary, .scroll, input[type=checkbox]");
  if (held && !"kmKM<>".includes(event.key)) return;
  const act = KEYS[event.key] ?? KEYS[event.key.toLowerCase()];
  if (!act) return;
  event.preventDefault();
  act(event.shiftKey);
});

for (const svg of moving) svg.pauseAnimations();
show(0);
if (!matchMedia("(prefers-reduced-motion: reduce)").matches) run(true);

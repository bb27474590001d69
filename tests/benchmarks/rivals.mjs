// Times flubber and GSAP's MorphSVG on pairs of drawings: node rivals.mjs FOLDER < pairs.json
//
// FOLDER is one where "npm install flubber gsap jsdom" was run. pairs.json: [[rings, rings], ...],
// each a list of path data, the largest first. Out comes, for each pair, {tool: [set-up, frame]} in
// seconds of processor time, each the median of several runs after some to warm up.
import { createRequire } from 'node:module';
import { readFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';
import { resolve } from 'node:path';

const WARM = 3, RUNS = 7, FRAMES = 60, SLOW = 0.5;
const require = createRequire(resolve(process.argv[2], 'package.json'));
const seconds = () => { const u = process.cpuUsage(); return (u.user + u.system) / 1e6; };
const median = (values) => values.sort((a, b) => a - b)[values.length >> 1];

const flubber = require('flubber');
function byFlubber(a, b) {
  const one = { maxSegmentLength: 10 }, many = { ...one, single: true };
  if (a.length === 1 && b.length === 1) return flubber.interpolate(a[0], b[0], one);
  if (a.length === b.length) return flubber.interpolateAll(a, b, many);
  if (a.length === 1) return flubber.separate(a[0], b, many);
  if (b.length === 1) return flubber.combine(a, b[0], many);
  // Those by which one has more than the other come of the last one, or go into it.
  const k = Math.min(a.length, b.length) - 1;
  const head = flubber.interpolateAll(a.slice(0, k), b.slice(0, k), many);
  const tail = a.length < b.length
    ? flubber.separate(a[k], b.slice(k), many) : flubber.combine(a.slice(k), b[k], many);
  return (t) => head(t) + tail(t);
}

function timed(tool, [a, b]) {
  const setups = [], frames = [];
  for (let run = 0; run < WARM + RUNS; run++) {
    const start = seconds();
    const shape = tool(a, b);
    const ready = seconds();
    for (let k = 0; k < FRAMES; k++) shape(k / (FRAMES - 1));
    if (run >= WARM || ready - start > SLOW) {
      setups.push(ready - start);
      frames.push((seconds() - ready) / FRAMES);
    }
    if (ready - start > SLOW) break;
  }
  return [median(setups), median(frames)];
}

function timedBy(name, tool) {
  pairs.forEach((pair, k) => {
    try { found[k][name] = timed(tool, pair); } catch { /* it cannot do this pair */ }
  });
}

const pairs = JSON.parse(readFileSync(0, 'utf8'));
const found = pairs.map(() => ({}));
timedBy('flubber', byFlubber);

// Only now, for with a document flubber would measure paths by it.
const { window } = new (require('jsdom').JSDOM)('<!doctype html><svg></svg>', { pretendToBeVisual: true });
Object.assign(globalThis, { window, document: window.document });
const load = (name) => import(pathToFileURL(require.resolve(name)).href);
const { gsap } = (await load('gsap')).default;
const { MorphSVGPlugin } = (await load('gsap/MorphSVGPlugin')).default;
gsap.registerPlugin(MorphSVGPlugin);
gsap.ticker.sleep();
function byGsap(a, b) {
  const target = { d: a.join('') };
  const morphSVG = { shape: b.join(''), prop: 'd', precision: 4 };
  const options = { duration: 1, ease: 'none', paused: true, lazy: false };
  const tween = gsap.to(target, { morphSVG, ...options });
  tween.progress(0.5); // nothing is prepared before it moves
  return (t) => { tween.progress(t); return target.d; };
}

timedBy('GSAP', byGsap);
console.log(JSON.stringify(found));
process.exit(0);

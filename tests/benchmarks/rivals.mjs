// Times flubber on pairs of outlines: node rivals.mjs FOLDER < pairs.json > times.json
//
// FOLDER is one where "npm install flubber" was run. pairs.json: [[d, d], ...]. Out come seconds of
// processor time, [[set-up, frame], ...], each the median of several runs after some to warm up.
import { createRequire } from 'node:module';
import { readFileSync } from 'node:fs';
import { resolve } from 'node:path';

const WARM = 3, RUNS = 7, FRAMES = 60;
const { interpolate } = createRequire(resolve(process.argv[2], 'package.json'))('flubber');
const seconds = () => { const u = process.cpuUsage(); return (u.user + u.system) / 1e6; };
const median = (values) => values.sort((a, b) => a - b)[values.length >> 1];

function timed([a, b]) {
  const setups = [], frames = [];
  for (let run = 0; run < WARM + RUNS; run++) {
    const start = seconds();
    const shape = interpolate(a, b, { maxSegmentLength: 10 });
    const ready = seconds();
    for (let k = 0; k < FRAMES; k++) shape(k / (FRAMES - 1));
    if (run >= WARM) {
      setups.push(ready - start);
      frames.push((seconds() - ready) / FRAMES);
    }
  }
  return [median(setups), median(frames)];
}

console.log(JSON.stringify(JSON.parse(readFileSync(0, 'utf8')).map(timed)));

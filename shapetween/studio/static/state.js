// The work: one value that is never changed but replaced, and all values it has had.
//
//   drawings  names, in their order; the first one again at the end closes the round
//   legs      of each drawing and the next: pins [[ax, ay, bx, by]], matches ["a:b"], matching 1...
//   options   what differs from the defaults, by name
//   leg       the one that is looked at

export const EMPTY = { drawings: [], legs: [], options: {}, leg: 0 };
export const LEG = { pins: [], matches: [], matching: 1 };

const listeners = [];
let past = [EMPTY], place = 0, merging = null;

export const current = () => past[place];
export const leg = () => current().legs[current().leg] || LEG;
export const canUndo = () => place > 0;
export const canRedo = () => place < past.length - 1;
export const listen = (listener) => listeners.push(listener);

/** Replace the value. Changes in a row with the same `merge`, as of one drag, are one to undo. */
export function change(make, merge = null) {
  const before = current(), next = make(before);
  if (next === before) return;
  past = past.slice(0, place + 1);
  if (merge !== null && merge === merging && place > 0) past[place] = next;
  else { past.push(next); place += 1; }
  merging = merge;
  tell(before);
}

/** What comes next is a change of its own. */
export const settle = () => { merging = null; };

export function changeLeg(make, merge = null) {
  change((s) => ({ ...s, legs: s.legs.map((l, k) => (k === s.leg ? { ...l, ...make(l) } : l)) }), merge);
}

export function undo() { if (canUndo()) { const before = current(); place -= 1; merging = null; tell(before); } }
export function redo() { if (canRedo()) { const before = current(); place += 1; merging = null; tell(before); } }

/** Begin anew with a value, with nothing to undo. */
export function begin(value) {
  const before = current();
  past = [{ ...EMPTY, ...value }];
  place = 0;
  merging = null;
  tell(before);
}

function tell(before) { for (const listener of listeners) listener(current(), before); }

/** What the server is asked for: all of it, or the leg that is looked at. */
export function job(state = current()) {
  return { drawings: state.drawings, legs: state.legs, options: state.options };
}

export function legJob(state = current()) {
  return {
    drawings: state.drawings.slice(state.leg, state.leg + 2),
    legs: [state.legs[state.leg]],
    options: state.options,
  };
}

/** With other drawings; legs between drawings that were neighbours before are kept. */
export function withDrawings(state, drawings) {
  const known = new Map();
  state.legs.forEach((l, k) => known.set(`${state.drawings[k]}\n${state.drawings[k + 1]}`, l));
  const legs = drawings.slice(1).map((name, k) => known.get(`${drawings[k]}\n${name}`) || LEG);
  return { ...state, drawings, legs, leg: Math.max(0, Math.min(state.leg, legs.length - 1)) };
}

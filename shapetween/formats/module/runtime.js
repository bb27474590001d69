// The code of a module, in blocks of which the writer puts down those that are needed, after the
// constants that they read. Comments, indentation and needless spaces are left out.

//: always
const digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";

// Whole numbers, five bits a letter.
const numbers = text => {
  const found = [];
  let value = 0, place = 1;
  for (const letter of text) {
    const digit = digits.indexOf(letter);
    value += digit % 32 * place;
    place *= 32;
    if (digit < 32) {
      found.push(value % 2 ? (value + 1) / -2 : value / 2);
      value = 0;
      place = 1;
    }
  }
  return found;
};

// A part's marks (what is written before each point, and which point) and its fields of points.
const load = ([text, scales]) => {
  const all = numbers(text), marks = [];
  let at = 0, points = 0, curve = 0;
  const next = count => all.slice(at, at += count);
  const rings = next(next(1)[0]);
  const lines = next(next(1)[0]).flatMap((count, k) => Array(count).fill(k % 2));
  for (const ring of rings) {
    const first = points, closed = ring % 2;
    marks.push(["M", points++]);
    for (let left = ring >> 1; left--; curve++) {
      const home = closed && !left, line = lines[curve];
      line || marks.push(["C", points++], [" ", points++]);
      line && home || marks.push([line ? "L" : " ", home ? first : points++]);
    }
    closed && marks.push(["Z"]);
  }
  const field = () => next(2 * points).map((value, k, own) => own[k] = value + (own[k - 2] ?? 0));
  const start = field();
  if (at == all.length) return { marks, start };
  const [knots] = next(1), way = field();
  return { marks, start, way, knots, terms: scales.map(scale => [scale, field(), next(knots)]) };
};

const clamp = (value, most) => Math.min(Math.max(value, 0), most);

// A Catmull-Rom spline through even knots, straight on beyond its ends.
const spline = (knots, k, s) => {
  const b = knots[k], c = knots[k + 1], a = knots[k - 1] ?? 2 * b - c, d = knots[k + 2] ?? 2 * c - b;
  return b + s * (s < 0 || s > 1 ? c - b : (c - a + s * (2 * a - 5 * b + 4 * c - d + s * (3 * (b - c) + d - a))) / 2);
};

const path = (part, t) => {
  const { marks, start, way, terms, knots } = part.loaded ??= load(part);
  let points = start;
  if (way) {
    const place = t * (knots - 1), k = clamp(Math.floor(place), knots - 2);
    const shares = t == 0 || t == 1 ? [] : terms.map(([scale, field, own]) => [scale * spline(own, k, place - k), field]);
    points = start.map((value, k) => {
      value += t * way[k];
      for (const [share, field] of shares) value += share * field[k];
      return value;
    });
  }
  const number = k => Math.round((points[k] * unit + origin[k % 2]) * 10 ** decimals) / 10 ** decimals;
  return marks.map(([mark, k]) => k + 1 ? mark + number(2 * k) + " " + number(2 * k + 1) : mark).join("");
};

// The movement that a time falls into, and the time in it.
const find = t => {
  t *= legs.length;
  const leg = clamp(Math.ceil(t) - 1, legs.length - 1);
  return [leg, t - leg];
};

const at = (leg, own, part = 0) => {
  const here = legs[leg][part];
  return here ? path(here, own) : "";
};

// Path data at a time from 0 to 1, of one part of the drawing.
export default function d(t, part = 0) {
  return at(...find(t), part);
}

const element = target => target.style ? target : document.querySelector(target);
const add = (parent, name, attributes) => {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const key in attributes) made.setAttribute(key, attributes[key]);
  return parent.appendChild(made);
};

//: still paint
// Attributes of a part: paint, widths, opacity.
export function style(t, part = 0) {
  return { ...legs[find(t)[0]][part]?.[2] };
}

const draw = (group, part) => {
  const made = add(group, "path", part[2]);
  return t => made.hasAttribute("d") && !part.loaded.way || made.setAttribute("d", path(part, t));
};

//: moving paint
// An attribute at a time: numbers between two moments, put into a form; without one, a word.
const valueAt = ([form, times, values], t) => {
  const after = times.findIndex(time => time > t), k = after < 0 ? times.length : after;
  if (!form) return values[Math.max(k - 1, 0)];
  const b = clamp(k, times.length - 1) || 1, a = b - 1, s = clamp((t - times[a]) / (times[b] - times[a]), 1);
  let n = 0;
  return form.replace(/\$/g, () => +((1 - s) * values[a][n] + s * values[b][n++]).toFixed(4));
};

const trackAt = (part, t) => part.findLast((track, k) => k > 1 && track[0] <= t) ?? part[2];

// Attributes of a part at a time: paint, widths, opacity.
export function style(t, part = 0) {
  const [leg, own] = find(t), here = legs[leg][part], found = {};
  if (!here) return found;
  const [, fixed, moving] = trackAt(here, own)[1];
  for (const key in moving) found[key] = valueAt(moving[key], own);
  return { ...fixed, ...found };
}

let ids = 0;
const fresh = () => {
  const id = "shapetween-" + ids++;
  return document.getElementById(id) ? fresh() : id;
};

// An element with what it uses, which is defined before it; and what sets both to a time.
const assemble = (parent, [node, ...used]) => {
  const moves = [], names = used.map(fresh);
  const build = (parent, [name, fixed, moving, inner = []]) => {
    const made = add(parent, name);
    const set = (key, value) => {
      if (/^url/.test(value)) value = "url(#" + names[value.slice(5, -1)] + ")";
      made.getAttribute(key) == value || made.setAttribute(key, value);
    };
    for (const key in fixed) set(key, fixed[key]);
    for (const key in moving) moves.push(t => set(key, valueAt(moving[key], t)));
    inner.map(child => build(made, child));
    return made;
  };
  used.map((each, k) => build(parent, each).id = names[k]);
  return [build(parent, node), t => moves.map(move => move(t))];
};

// One path for each kind of paint that a part has in its time, with the gradients it uses.
const draw = (group, part) => {
  const draws = part.slice(2).map(track => {
    const [made, move] = assemble(group, track.slice(1));
    return t => {
      const own = trackAt(part, t) == track;
      made.style.display = own ? "" : "none";
      if (!own) return;
      move(t);
      made.hasAttribute("d") && !part.loaded.way || made.setAttribute("d", path(part, t));
    };
  });
  return t => draws.map(draw => draw(t));
};

//: groups
// What each part of a leg goes into, opened as they are painted; and what sets it to a time.
const nest = (root, leg) => {
  const [groups, members] = nests[leg], moves = [], inside = [];
  const open = k => {
    if (k < 0) return root;
    if (!inside[k]) {
      const [around, ...nodes] = groups[k];
      let [made, move] = assemble(open(around), nodes);
      moves.push(move);
      while (made.lastElementChild) made = made.lastElementChild;
      inside[k] = made;
    }
    return inside[k];
  };
  return [k => open(members[k] ?? -1), t => moves.map(move => move(t))];
};

//: always
// Draw into an <svg>, a <g>, or an element that is given an <svg>; what shows any time of a leg,
// also past its ends, where an easing overshoots.
const stage = target => {
  let root = element(target);
  if (root.namespaceURI.endsWith("xhtml")) root = add(root, "svg");
  if (root.localName == "svg" && !root.hasAttribute("viewBox")) root.setAttribute("viewBox", viewBox);
//: no groups
  const groups = legs.map(parts => {
    const group = add(root, "g");
    return [group, parts.map(part => draw(group, part))];
  });
//: groups
  const groups = legs.map((parts, leg) => {
    const group = add(root, "g"), [into, move] = nest(group, leg);
    return [group, [...parts.map((part, k) => draw(into(k), part)), move]];
  });
//: always
  return (leg, own) => groups.map(([group, draws], k) => {
    group.style.display = k == leg ? "" : "none";
    k == leg && draws.map(draw => draw(own));
  });
};

// The same for any time of the whole.
export function mount(target) {
  const show = stage(target);
  return t => { show(...find(t)); };
}

// Play in an element; a native Animation.
export function play(target, options = {}) {
  const { duration, easing, loop, hold, part, timeline, ...others } = { ...timing, ...options };
  const root = element(target), count = legs.length, swing = loop == "alternate", step = duration + hold;
  const show = root.localName == "path" ? (leg, own) => root.setAttribute("d", at(leg, own, part)) : stage(root);
  // What is taken out of the page is drawn no more.
  const drawn = root.lastElementChild ?? root;
  // Rests before, between and after the movements; there and back, half of each turn is before.
  const before = swing ? hold / 2 : hold, after = swing ? hold / 2 : loop == "repeat" && !closed ? hold : 0;
  const whole = before + count * step - hold + after;
  const clock = timeline ? { duration: "auto" } : {
    duration: whole, delay: swing ? hold / 2 : 0,
    iterations: loop == "once" ? 1 : Infinity, direction: swing ? "alternate" : "normal",
  };
  const effect = new KeyframeEffect(root, null, { fill: "both", ...clock, ...others });
  const animation = new Animation(effect, timeline);
  const eased = new KeyframeEffect(null, null, { duration: 1, fill: "both", easing }), ease = new Animation(eased);
  ease.pause();
  let last, seen;
  const tick = () => {
    const now = animation.currentTime + "";
    if (now != last) {
      const passed = effect.getComputedTiming().progress * whole - before;
//: even
      const leg = clamp(Math.floor(passed / step), count - 1);
      ease.currentTime = clamp((passed - leg * step) / duration, 1);
//: uneven
      let leg = 0, own = passed;
      while (leg < count - 1 && own >= duration * ways[leg] + hold) own -= duration * ways[leg++] + hold;
      ease.currentTime = clamp(own / (duration * ways[leg]), 1);
//: always
      show(leg, eased.getComputedTiming().progress);
    }
    last = now;
    seen ||= drawn.isConnected;
    if (drawn.isConnected || !seen) requestAnimationFrame(tick);
  };
  tick();
  if (!timeline && matchMedia("(prefers-reduced-motion:reduce)").matches) loop == "once" ? animation.finish() : animation.pause();
  else timeline ? animation.play() : begin(animation, root);
  return animation;
}

//: start load
const begin = animation => animation.play();

//: start click
// The next click goes back.
const begin = (animation, root) => {
  animation.pause();
  let forth = false;
  root.addEventListener("click", () => turn(animation, forth = !forth));
};

//: start hover
const begin = (animation, root) => {
  animation.pause();
  root.addEventListener("mouseenter", () => turn(animation, true));
  root.addEventListener("mouseleave", () => turn(animation, false));
};

//: start click, start hover
const turn = (animation, forth) => {
  if (!forth && !(animation.currentTime > 0)) return;
  animation.playbackRate = (forth ? 1 : -1) * Math.abs(animation.playbackRate);
  animation.play();
};

//: start seen
const begin = (animation, root) => {
  animation.pause();
  new IntersectionObserver(([entry]) => entry.isIntersecting ? animation.play() : animation.pause(), { threshold: 0.5 }).observe(root);
};

//: start drag, start scroll
// Once, by hand.
const byHand = animation => {
  animation.pause();
  animation.effect.updateTiming({ iterations: 1, direction: "normal", delay: 0 });
  return share => animation.currentTime = clamp(share, 1) * animation.effect.getComputedTiming().duration;
};

//: start drag
const begin = (animation, root) => {
  const reach = byHand(animation);
  root.style.touchAction = "pan-y";
  root.style.userSelect = "none";
  const follow = event => {
    const box = root.getBoundingClientRect();
    reach((event.clientX - box.left) / box.width);
  };
  root.addEventListener("pointerdown", event => {
    follow(event);
    addEventListener("pointermove", follow);
    for (const end of ["pointerup", "pointercancel"]) addEventListener(end, () => removeEventListener("pointermove", follow));
  });
};

//: start scroll
// From coming in at the bottom to going out at the top.
const begin = (animation, root) => {
  const reach = byHand(animation);
  const follow = () => {
    const box = root.getBoundingClientRect();
    reach((innerHeight - box.top) / (innerHeight + box.height));
  };
  addEventListener("scroll", follow, { passive: true, capture: true });
  addEventListener("resize", follow);
  follow();
};

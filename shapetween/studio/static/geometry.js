// Points on outlines that are given as many matched points: ring.a[i] becomes ring.b[i].

/** The place on a polyline nearest to a point: segment + parameter, the point, and how far it is. */
export function nearest(points, closed, [x, y]) {
  let best = { place: 0, point: points[0], distance: Infinity };
  const count = closed ? points.length : points.length - 1;
  for (let i = 0; i < count; i++) {
    const [ax, ay] = points[i], [bx, by] = points[(i + 1) % points.length];
    const dx = bx - ax, dy = by - ay, square = dx * dx + dy * dy;
    const t = square ? Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / square)) : 0;
    const px = ax + t * dx, py = ay + t * dy, distance = Math.hypot(px - x, py - y);
    if (distance < best.distance) best = { place: i + t, point: [px, py], distance };
  }
  return best;
}

/** The point at a place, which may be of any turn where the outline is closed. */
export function at(points, closed, place) {
  const n = points.length;
  const p = closed ? ((place % n) + n) % n : Math.min(n - 1, Math.max(0, place));
  const i = Math.floor(p) % n, t = p - Math.floor(p);
  const [ax, ay] = points[i], [bx, by] = points[closed ? (i + 1) % n : Math.min(i + 1, n - 1)];
  return [ax + t * (bx - ax), ay + t * (by - ay)];
}

/** Of all rings the place nearest to a point of one side, "a" or "b". */
export function nearestOfAll(rings, side, point) {
  let best = null;
  rings.forEach((ring, index) => {
    const found = nearest(ring[side], ring.closed, point);
    if (!best || found.distance < best.distance) best = { ...found, ring: index };
  });
  return best;
}

/** The ring that a pin belongs to: the one that both its ends are nearest to. */
export function ringOf(rings, [ax, ay, bx, by]) {
  let best = -1, least = Infinity;
  rings.forEach((ring, index) => {
    const a = nearest(ring.a, ring.closed, [ax, ay]).distance / size(ring.a);
    const b = nearest(ring.b, ring.closed, [bx, by]).distance / size(ring.b);
    if (a + b < least) { least = a + b; best = index; }
  });
  return best;
}

/** How far, as a share of the outline, two places are apart. */
export function apart(ring, one, other) {
  const gap = Math.abs(one - other) / ring.a.length;
  return ring.closed ? Math.min(gap, 1 - gap) : gap;
}

/** Rounded for a box of a size, so that command lines are short: a 20,000th of it. */
export function rounded(point, box) {
  const digits = Math.max(0, Math.ceil(Math.log10(20000 / Math.max(box[2], box[3]))));
  return point.map((x) => Number(x.toFixed(Math.min(digits, 12))));
}

function size(points) {
  const xs = points.map((p) => p[0]), ys = points.map((p) => p[1]);
  return Math.max(Math.max(...xs) - Math.min(...xs), Math.max(...ys) - Math.min(...ys)) || 1;
}

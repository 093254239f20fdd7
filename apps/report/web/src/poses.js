// Where bodies and lines are at any time between frames. Lengths in m, times in s, axes of the scene: z up.
import { numbers } from './data.js';

/** The frame before a time and the share of the way to the next one. */
export function frameAt(time, t) {
  let low = 0,
    high = time.length - 1;
  if (t <= time[0] || high === 0) return [0, 0];
  if (t >= time[high]) return [high - 1, 1];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (time[middle] <= t) low = middle;
    else high = middle;
  }
  return [low, (t - time[low]) / (time[low + 1] - time[low])];
}

/**
 * Position and unit quaternion (x, y, z, w) of a body, by straight lines between frames; the quaternion is normalised.
 * @returns {{origin: number[], q: number[]}}
 */
export function poseAt(body, frame, share) {
  const poses = numbers(body.poses),
    a = 7 * frame,
    b = Math.min(a + 7, poses.length - 7);
  const mix = (i, sign = 1) => poses[a + i] * (1 - share) + sign * poses[b + i] * share;
  const same =
    poses[a + 3] * poses[b + 3] +
      poses[a + 4] * poses[b + 4] +
      poses[a + 5] * poses[b + 5] +
      poses[a + 6] * poses[b + 6] >=
    0
      ? 1
      : -1;
  const q = [3, 4, 5, 6].map((i) => mix(i, same));
  const size = Math.hypot(...q);
  return { origin: [0, 1, 2].map((i) => mix(i)), q: q.map((v) => v / size) };
}

/** A point of a body, given from its origin in its axes, in those of the scene: v + 2 r × (r × v + w v). */
export function placed({ origin, q }, v) {
  const [x, y, z, w] = q;
  const c = [y * v[2] - z * v[1] + w * v[0], z * v[0] - x * v[2] + w * v[1], x * v[1] - y * v[0] + w * v[2]];
  return [
    origin[0] + v[0] + 2 * (y * c[2] - z * c[1]),
    origin[1] + v[1] + 2 * (z * c[0] - x * c[2]),
    origin[2] + v[2] + 2 * (x * c[1] - y * c[0]),
  ];
}

/** Points of a line one after the other, 3 numbers each; NaN where the result does not know. */
export function lineAt(line, frame, share, out = new Float32Array(3 * line.points)) {
  const places = numbers(line.places),
    n = 3 * line.points;
  const at = Math.min((frame + share) / line.stride, places.length / n - 1);
  const a = Math.floor(at),
    b = Math.min(a + 1, places.length / n - 1),
    part = at - a;
  for (let i = 0; i < n; ++i) out[i] = places[n * a + i] * (1 - part) + places[n * b + i] * part;
  return out;
}

/** The box that holds all that is drawn at the first frame, with room for lines that hang deep: [low, high]. */
export function extentAtRest(view) {
  const low = [Infinity, Infinity, Infinity],
    high = [-Infinity, -Infinity, -Infinity];
  const add = (p) =>
    p.forEach((v, i) => {
      if (Number.isFinite(v)) {
        low[i] = Math.min(low[i], v);
        high[i] = Math.max(high[i], v);
      }
    });
  for (const body of view.bodies)
    for (const shape of body.shapes) for (const p of cornersOf(shape)) add(placed(poseAt(body, 0, 0), p));
  for (const line of view.lines) {
    const at = lineAt(line, 0, 0);
    for (let i = 0; i < at.length; i += 3) add([at[i], at[i + 1], at[i + 2]]);
  }
  if (!Number.isFinite(low[0]))
    return [
      [-10, -10, -5],
      [10, 10, 5],
    ];
  return [low, high];
}

/** Points that a shape does not reach beyond, in axes of its body. */
export function cornersOf(shape) {
  if (shape.kind === 'box')
    return [0, 1, 2, 3, 4, 5, 6, 7].map((i) => [0, 1, 2].map((k) => ((i >> k) & 1 ? shape.high : shape.low)[k]));
  if (shape.kind === 'sphere') return [-1, 1].map((s) => shape.centre.map((v) => v + s * shape.radius));
  if (shape.kind === 'cylinder') {
    const axis = shape.to.map((v, i) => v - shape.from[i]),
      length = Math.hypot(...axis) || 1;
    const across = axis.map((a) => shape.radius * Math.sqrt(Math.max(0, 1 - (a / length) ** 2)));
    return [shape.from, shape.to].flatMap((end) => [-1, 1].map((s) => end.map((v, i) => v + s * across[i])));
  }
  const v = numbers(shape.vertices),
    out = [];
  for (let i = 0; i < v.length; i += 3) out.push([v[i], v[i + 1], v[i + 2]]);
  return out;
}

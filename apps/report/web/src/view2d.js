// The side view (x along, z up) on a plain canvas, where the browser has no WebGL.
import { colour, styled } from './colours.js';
import { h } from './dom.js';
import { cornersOf, extentAtRest, lineAt, placed, poseAt } from './poses.js';
import { surfaceOf } from './water.js';

/** @param {HTMLElement} place @param {object} view */
export function view2d(place, view) {
  const canvas = h('canvas', {
    class: 'plane',
    role: 'img',
    'aria-label': 'Bodies, lines and waves seen from the side: x to the right, z up',
  });
  place.append(canvas);
  const pen = canvas.getContext('2d'),
    surface = surfaceOf(view.surface);
  const [low, high] = extentAtRest(view);
  const room = 0.12 * (high[0] - low[0]) + 2;
  let last = [0, 0, 0],
    at = null;

  function resize() {
    const ratio = devicePixelRatio || 1,
      width = place.clientWidth || 600;
    const x = [low[0] - room, high[0] + room],
      z = [low[2] - room / 2, Math.max(high[2], surface.hs) + room / 2];
    const scale = Math.min(width / (x[1] - x[0]), 420 / (z[1] - z[0]));
    const height = Math.max(180, scale * (z[1] - z[0])),
      left = (width - scale * (x[1] - x[0])) / 2;
    canvas.width = width * ratio;
    canvas.height = height * ratio;
    canvas.style.width = `${width}px`;
    canvas.style.height = `${height}px`;
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    at = {
      x: (v) => left + (v - x[0]) * scale,
      z: (v) => (z[1] - v) * scale,
      width,
      height,
      back: (px) => x[0] + (px - left) / scale,
    };
    draw(...last);
  }

  function draw(t, frame, share) {
    last = [t, frame, share];
    if (!at) return;
    pen.clearRect(0, 0, at.width, at.height);
    view.bodies.forEach((body, i) => paintBody(body, i, poseAt(body, frame, share)));
    pen.strokeStyle = styled('--rope');
    pen.lineWidth = 1.6;
    for (const line of view.lines) {
      const p = lineAt(line, frame, share);
      pen.beginPath();
      for (let k = 0, on = false; k < p.length; k += 3) {
        if (!Number.isFinite(p[k])) {
          on = false;
          continue;
        }
        if (on) pen.lineTo(at.x(p[k]), at.z(p[k + 2]));
        else pen.moveTo(at.x(p[k]), at.z(p[k + 2]));
        on = true;
      }
      pen.stroke();
    }
    paintWater(t);
  }

  /** The outline of what is seen of each shape: the convex hull of its corners. */
  function paintBody(body, i, pose) {
    pen.globalAlpha = body.moves ? 0.85 : 0.3;
    pen.fillStyle = colour(i);
    pen.strokeStyle = styled('--ink');
    pen.lineWidth = 1;
    for (const shape of body.shapes) {
      const outline = hull(
        sidesOf(shape)
          .map((p) => placed(pose, p))
          .map((p) => [at.x(p[0]), at.z(p[2])]),
      );
      pen.beginPath();
      outline.forEach(([x, y]) => pen.lineTo(x, y));
      pen.closePath();
      pen.fill();
      pen.stroke();
    }
    pen.globalAlpha = 1;
  }

  function paintWater(t) {
    surface.prepare(t, Math.max(Math.abs(at.back(0)), Math.abs(at.back(at.width))));
    pen.fillStyle = '#2f8fc455';
    pen.beginPath();
    for (let px = 0; px <= at.width; px += 3) pen.lineTo(px, at.z(surface.at(at.back(px), 0)));
    pen.lineTo(at.width, at.height);
    pen.lineTo(0, at.height);
    pen.fill();
  }

  new ResizeObserver(resize).observe(place);
  return { canvas, show: draw, reset: () => draw(...last), repaint: () => draw(...last) };
}

/** Points on a shape that its outline goes through: of round ones those of circles. */
function sidesOf(shape) {
  const round = [...Array(24).keys()].map((k) => (2 * Math.PI * k) / 24);
  if (shape.kind === 'sphere')
    return round.map((a) => [
      shape.centre[0] + shape.radius * Math.cos(a),
      shape.centre[1],
      shape.centre[2] + shape.radius * Math.sin(a),
    ]);
  if (shape.kind !== 'cylinder') return cornersOf(shape);
  const axis = shape.to.map((v, i) => v - shape.from[i]),
    n = Math.hypot(...axis) || 1,
    d = axis.map((v) => v / n);
  const u = Math.abs(d[2]) < 0.9 ? [d[1], -d[0], 0] : [0, d[2], -d[1]],
    m = Math.hypot(...u),
    e = u.map((v) => v / m);
  const f = [d[1] * e[2] - d[2] * e[1], d[2] * e[0] - d[0] * e[2], d[0] * e[1] - d[1] * e[0]];
  return [shape.from, shape.to].flatMap((end) =>
    round.map((a) => end.map((v, i) => v + shape.radius * (Math.cos(a) * e[i] + Math.sin(a) * f[i]))),
  );
}

/** Andrew's monotone chain. */
export function hull(points) {
  const p = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const half = (all) => {
    const out = [];
    for (const q of all) {
      while (out.length > 1) {
        const [a, b] = out.slice(-2);
        if ((b[0] - a[0]) * (q[1] - a[1]) - (b[1] - a[1]) * (q[0] - a[0]) > 0) break;
        out.pop();
      }
      out.push(q);
    }
    return out.slice(0, -1);
  };
  return [...half(p), ...half(p.reverse())];
}

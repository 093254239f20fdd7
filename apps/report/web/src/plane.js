// A plane with two scales on a canvas: phase plots, trajectories, measured against fitted, maps.
import { styled } from './colours.js';
import { h } from './dom.js';
import { format } from './units.js';

const MARGIN = { left: 64, right: 14, top: 10, bottom: 44 }; // px

/** Round values between two, about `wanted` of them. */
export function ticksOf(low, high, wanted = 6) {
  const raw = (high - low) / wanted;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= raw * 0.999);
  const out = [];
  for (let v = Math.ceil(low / step - 1e-9) * step; v <= high + 1e-9 * step; v += step)
    out.push(Math.abs(v) < step * 1e-6 ? 0 : v);
  return out;
}

/** The least and the largest finite value of several lists, with room about them. */
export function extentOf(lists, room = 0.05) {
  let low = Infinity,
    high = -Infinity;
  for (const list of lists)
    for (const v of list)
      if (Number.isFinite(v)) {
        if (v < low) low = v;
        if (v > high) high = v;
      }
  if (!(low <= high)) return [0, 1];
  const more = low === high ? Math.abs(low) * 0.1 || 1 : (high - low) * room;
  return [low - more, high + more];
}

/**
 * @param {HTMLElement} place
 * @param {{height?: number | ((width: number) => number), equal?: boolean,
 *          read: () => {x: {label: string, range: number[]}, y: {label: string, range: number[]}},
 *          paint: (pen: CanvasRenderingContext2D, at: {x: (v: number) => number, y: (v: number) => number}) => void,
 *          tell?: (x: number, y: number) => string}} what `paint` draws in the plane, `tell` says what is at a point
 */
export function plane(place, what) {
  const canvas = h('canvas', { class: 'plane', tabindex: '0', role: 'img' });
  const said = h('div', { class: 'readout', 'aria-live': 'off' });
  place.replaceChildren(canvas, said);
  let zoom = null,
    scale = null,
    from = null;

  function size() {
    const ratio = devicePixelRatio || 1,
      width = place.clientWidth || 500,
      height = typeof what.height === 'function' ? what.height(width) : (what.height ?? 320);
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    canvas.style.width = `${width}px`;
    canvas.style.height = `${height}px`;
    return { ratio, width, height };
  }

  function ranges(width, height, axes) {
    const xr = zoom?.x ?? axes.x.range,
      yr = zoom?.y ?? axes.y.range;
    if (!what.equal) return [xr, yr];
    const per = Math.max((xr[1] - xr[0]) / width, (yr[1] - yr[0]) / height);
    const about = (r, n) => [(r[0] + r[1] - per * n) / 2, (r[0] + r[1] + per * n) / 2];
    return [about(xr, width), about(yr, height)];
  }

  function draw() {
    const { ratio, width, height } = size();
    const axes = what.read(),
      pen = canvas.getContext('2d');
    const w = width - MARGIN.left - MARGIN.right,
      ht = height - MARGIN.top - MARGIN.bottom;
    const [xr, yr] = ranges(w, ht, axes);
    scale = {
      x: (v) => MARGIN.left + ((v - xr[0]) / (xr[1] - xr[0])) * w,
      y: (v) => MARGIN.top + ht - ((v - yr[0]) / (yr[1] - yr[0])) * ht,
      ofX: (px) => xr[0] + ((px - MARGIN.left) / w) * (xr[1] - xr[0]),
      ofY: (py) => yr[0] + ((MARGIN.top + ht - py) / ht) * (yr[1] - yr[0]),
    };
    canvas.setAttribute('aria-label', `${axes.y.label} over ${axes.x.label}`);
    place.dataset.x = axes.x.label;
    place.dataset.y = axes.y.label;
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, width, height);
    frame(pen, axes, xr, yr, w, ht);
    pen.save();
    pen.beginPath();
    pen.rect(MARGIN.left, MARGIN.top, w, ht);
    pen.clip();
    what.paint(pen, scale);
    pen.restore();
  }

  function frame(pen, axes, xr, yr, w, ht) {
    pen.font = '12px system-ui, sans-serif';
    pen.lineWidth = 1;
    pen.strokeStyle = styled('--grid');
    pen.fillStyle = styled('--ink');
    pen.textAlign = 'center';
    for (const v of ticksOf(...xr, w / 90)) {
      line(pen, scale.x(v), MARGIN.top, scale.x(v), MARGIN.top + ht);
      pen.fillText(format(v, 4), scale.x(v), MARGIN.top + ht + 16);
    }
    pen.textAlign = 'right';
    for (const v of ticksOf(...yr, ht / 50)) {
      line(pen, MARGIN.left, scale.y(v), MARGIN.left + w, scale.y(v));
      pen.fillText(format(v, 3), MARGIN.left - 6, scale.y(v) + 4);
    }
    pen.textAlign = 'center';
    pen.fillText(axes.x.label, MARGIN.left + w / 2, MARGIN.top + ht + 36);
    pen.save();
    pen.translate(13, MARGIN.top + ht / 2);
    pen.rotate(-Math.PI / 2);
    pen.fillText(axes.y.label, 0, 0);
    pen.restore();
  }

  const at = (event) => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const reset = () => {
    zoom = null;
    draw();
  };
  canvas.addEventListener('pointerdown', (event) => {
    from = at(event);
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener('pointermove', (event) => {
    const [x, y] = at(event);
    if (from) {
      draw();
      const pen = canvas.getContext('2d');
      pen.fillStyle = `${styled('--accent')}33`;
      pen.fillRect(from[0], from[1], x - from[0], y - from[1]);
    } else if (scale) {
      said.textContent = what.tell?.(scale.ofX(x), scale.ofY(y)) ?? `${format(scale.ofX(x))}, ${format(scale.ofY(y))}`;
    }
  });
  canvas.addEventListener('pointerup', (event) => {
    const [x, y] = at(event),
      begin = from;
    from = null;
    if (begin && Math.abs(x - begin[0]) > 6 && Math.abs(y - begin[1]) > 6) {
      const sorted = (a, b) => [Math.min(a, b), Math.max(a, b)];
      zoom = { x: sorted(scale.ofX(begin[0]), scale.ofX(x)), y: sorted(scale.ofY(begin[1]), scale.ofY(y)) };
    }
    draw();
  });
  canvas.addEventListener('pointerleave', () => {
    said.textContent = '';
  });
  canvas.addEventListener('dblclick', reset);
  new ResizeObserver(draw).observe(place);
  return { draw, reset, canvas };
}

export function line(pen, x0, y0, x1, y1) {
  pen.beginPath();
  pen.moveTo(x0, y0);
  pen.lineTo(x1, y1);
  pen.stroke();
}

/** A curve through points; what is not finite breaks it. */
export function path(pen, at, xs, ys) {
  pen.beginPath();
  let on = false;
  for (let i = 0; i < xs.length; ++i) {
    if (!Number.isFinite(xs[i]) || !Number.isFinite(ys[i])) {
      on = false;
      continue;
    }
    if (on) pen.lineTo(at.x(xs[i]), at.y(ys[i]));
    else pen.moveTo(at.x(xs[i]), at.y(ys[i]));
    on = true;
  }
  pen.stroke();
}

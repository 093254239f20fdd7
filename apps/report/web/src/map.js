// Values over a plane as colours, with a bar that tells them: maps of sweeps and of the free surface.
import { onScale } from './colours.js';
import { h } from './dom.js';
import { figure, whenNear } from './figure.js';
import { plane, ticksOf } from './plane.js';
import { onChange } from './settings.js';
import { format, labelled } from './units.js';

const SHADES = 256;

/** Borders between values: halfway, and as far outside; a value by itself has half of one on each side. */
export function bordersOf(values) {
  if (values.length === 1) return [values[0] - 0.5, values[0] + 0.5];
  const middle = values.slice(1).map((v, i) => (v + values[i]) / 2);
  return [
    values[0] - (middle[0] - values[0]),
    ...middle,
    values[values.length - 1] + (values[values.length - 1] - middle[middle.length - 1]),
  ];
}

const nearest = (all, v) =>
  all.reduce((best, one, i) => (Math.abs(one - v) < Math.abs(all[best] - v) ? i : best), 0);

/**
 * @param {{title: string, note?: string, equal?: boolean, height?: number | ((width: number) => number),
 *          scale?: (share: number) => string, csv: () => string, player?: HTMLElement,
 *          read: () => {x: {label: string, values: number[]}, y: {label: string, values: number[]},
 *                       value: (i: number, j: number) => number, low: number, high: number,
 *                       name: string, unit: string},
 *          over?: (pen: CanvasRenderingContext2D, at: {x: (v: number) => number, y: (v: number) => number}) => void,
 *          tell: (i: number, j: number) => string}} of
 *        `read` is asked whenever the map is drawn, `value` is that of column i and row j, `over` draws upon the
 *        colours
 * @returns {{element: HTMLElement, draw: () => void}} `draw` draws anew what has been drawn
 */
export function mapFigure(of) {
  const scale = of.scale ?? onScale;
  const shades = Array.from({ length: SHADES }, (_, i) => scale(i / (SHADES - 1)));
  let drawn = null,
    now = of.read();
  const shell = figure({
    title: of.title,
    names: [],
    note: of.note,
    draw: () => {},
    canvas: () => drawn.canvas,
    reset: () => drawn.reset(),
    csv: of.csv,
  });
  const bar = h('div', { class: 'scalebar' });
  if (of.player) shell.element.append(of.player);
  shell.element.append(bar);

  function paint(pen, at) {
    const { low, high, value } = now;
    // Cells end at whole pixels of the canvas: what lies between two of them would be half transparent.
    const ratio = devicePixelRatio || 1;
    const whole = (px) => Math.round(px * ratio) / ratio;
    const xs = bordersOf(now.x.values).map((v) => whole(at.x(v))),
      ys = bordersOf(now.y.values).map((v) => whole(at.y(v)));
    for (let j = 0; j + 1 < ys.length; ++j)
      for (let i = 0; i + 1 < xs.length; ++i) {
        const v = value(i, j);
        if (!Number.isFinite(v)) continue;
        const share = high > low ? Math.min(Math.max((v - low) / (high - low), 0), 1) : 0.5;
        pen.fillStyle = shades[Math.round(share * (SHADES - 1))];
        pen.fillRect(xs[i], ys[j + 1], xs[i + 1] - xs[i], ys[j] - ys[j + 1]);
      }
    of.over?.(pen, at);
  }

  function begin() {
    drawn = plane(shell.place, {
      equal: of.equal,
      height: of.height ?? 380,
      read: () => {
        now = of.read();
        bar.replaceChildren(...marked(now, shades));
        const ends = (values) => {
          const all = bordersOf(values);
          return [all[0], all[all.length - 1]];
        };
        return {
          x: { label: now.x.label, range: ends(now.x.values) },
          y: { label: now.y.label, range: ends(now.y.values) },
        };
      },
      paint,
      tell: (px, py) => of.tell(nearest(now.x.values, px), nearest(now.y.values, py)),
    });
    drawn.draw();
  }
  whenNear(shell.place, begin);
  onChange(() => drawn?.draw());
  return { element: shell.element, draw: () => drawn?.draw() };
}

/** The colours from low to high, and what they stand for. */
function marked({ low, high, name, unit }, shades) {
  const stops = shades.filter((_, i) => i % 17 === 0).join(',');
  const told = high > low ? [low, ...ticksOf(low, high, 3).filter((v) => v > low && v < high), high] : [low];
  return [
    h('div', {}, labelled(name, unit)),
    h('span', { class: 'ramp', style: `background:linear-gradient(to right,${stops})` }),
    h(
      'div',
      { class: 'marks' },
      told.map((v) => h('span', {}, format(v, 3))),
    ),
  ];
}

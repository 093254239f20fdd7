// Curves and marks in a plane whose abscissa need not rise.
import { colour, dash, inked } from './colours.js';
import { csvOf, figure, whenNear } from './figure.js';
import { extentOf, path, plane } from './plane.js';
import { onChange } from './settings.js';

/**
 * @param {{title: string, note?: string, equal?: boolean, height?: number,
 *          read: () => {x: string, y: string, xlog?: boolean, ylog?: boolean,
 *                       curves: {name: string, x: ArrayLike<number>, y: ArrayLike<number>, line?: boolean,
 *                                marks?: boolean}[],
 *                       bands?: {name: string, x: ArrayLike<number>, low: ArrayLike<number>,
 *                                high: ArrayLike<number>}[]}}} of
 */
export function xyFigure(of) {
  let data = of.read(),
    drawn = null;
  const shell = figure({
    title: of.title,
    note: of.note,
    names: data.curves.map((c) => c.name),
    always: data.curves.some((c) => c.name),
    draw: () => draw(),
    canvas: () => drawn.canvas,
    reset: () => drawn.reset(),
    curves: () => shown().map((c, i) => [c.name, colour(i)]),
    csv: () =>
      shown()
        .map((c) =>
          csvOf([
            { name: `${c.name} ${data.x}`, values: c.x },
            { name: `${c.name} ${data.y}`, values: c.y },
          ]),
        )
        .join('\n'),
  });
  const shown = () => data.curves.filter((c) => shell.chosen.has(c.name));
  const lg = (on) => (values) => (on ? Array.from(values, (v) => (v > 0 ? Math.log10(v) : NaN)) : values);

  function draw() {
    const fx = lg(data.xlog),
      fy = lg(data.ylog);
    const curves = shown().map((c) => ({ ...c, x: fx(c.x), y: fy(c.y) }));
    const bands = (data.bands ?? []).map((b) => ({ x: fx(b.x), low: fy(b.low), high: fy(b.high) }));
    const what = {
      equal: of.equal,
      height: of.height,
      read: () => ({
        x: {
          label: data.xlog ? `log₁₀ ${data.x}` : data.x,
          range: extentOf(
            curves.map((c) => c.x),
            0.03,
          ),
        },
        y: {
          label: data.ylog ? `log₁₀ ${data.y}` : data.y,
          range: extentOf([...curves.map((c) => c.y), ...bands.flatMap((b) => [b.low, b.high])]),
        },
      }),
      paint: (pen, at) => {
        bands.forEach((b) => paintBand(pen, at, b));
        curves.forEach((c, i) => paintCurve(pen, at, c, i));
      },
    };
    drawn = plane(shell.place, what);
    drawn.draw();
    shell.setColours((name) => {
      const i = shown().findIndex((c) => c.name === name);
      return inked(i, dashOf(shown()[i], i));
    });
  }

  onChange((settings) => {
    data = of.read(settings);
    if (drawn) draw();
  });
  whenNear(shell.place, draw);
  return shell.element;
}

/** Marks alone have no dashes; what is dashed in the fit's own plot is dashed here. */
const dashOf = (c, i) => (c.line === false ? [] : dash(c.dashed ? 1 : i));

function paintCurve(pen, at, c, i) {
  pen.strokeStyle = pen.fillStyle = colour(i);
  pen.lineWidth = 1.5;
  pen.setLineDash(dashOf(c, i));
  if (c.line !== false) path(pen, at, c.x, c.y);
  pen.setLineDash([]);
  if (c.marks)
    for (let k = 0; k < c.x.length; ++k) {
      if (!Number.isFinite(c.x[k]) || !Number.isFinite(c.y[k])) continue;
      pen.beginPath();
      pen.arc(at.x(c.x[k]), at.y(c.y[k]), c.x.length > 400 ? 1.2 : 2.6, 0, 7);
      pen.fill();
    }
}

function paintBand(pen, at, { x, low, high }) {
  pen.fillStyle = `${colour(0)}33`;
  pen.beginPath();
  for (let k = 0; k < x.length; ++k) pen.lineTo(at.x(x[k]), at.y(low[k]));
  for (let k = x.length - 1; k >= 0; --k) pen.lineTo(at.x(x[k]), at.y(high[k]));
  pen.fill();
}

// Curves over a common abscissa, by uPlot: zoom by dragging, a cursor that tells values, axes that move together.
import uPlot from 'uplot';
import { colour, dash, inked, styled } from './colours.js';
import { csvOf, figure, whenNear } from './figure.js';
import { format } from './units.js';
import { onChange } from './settings.js';

const HEIGHT = 260; // px
const groups = new Map(); // of figures whose abscissae move together

/** A range for all figures of a group, or null for all that there is. */
function moveTogether(group, range, except) {
  for (const other of groups.get(group) ?? []) if (other !== except) other.setRange(range);
}

/**
 * @param {{title: string, group: string, note?: string, log?: boolean,
 *          read: () => {x: {label: string, values: ArrayLike<number>}, y: {label: string},
 *                       curves: {name: string, values: ArrayLike<number>, low?: ArrayLike<number>,
 *                                high?: ArrayLike<number>, turn?: number}[],
 *                       first?: number[]}}} of
 *        `read` is asked anew when units change; x rises; `first` is the range that is shown before any zoom; values
 *        of a curve with a `turn` are angles, whose jumps by more than half a turn are no line
 */
export function curveFigure(of) {
  let data = of.read(),
    plot = null,
    range = null,
    isLog = false,
    seen = false,
    isWhole = false;
  const shell = figure({
    title: of.title,
    names: data.curves.map((c) => c.name),
    note: of.note,
    draw: () => draw(),
    canvas: () => plot.ctx.canvas,
    reset: () => showAll(),
    always: true,
    curves: () => chosenCurves().map((c) => [c.name, strokeOf(c.name)]),
    log:
      of.log === false
        ? undefined
        : (on) => {
            isLog = on;
            draw();
          },
    csv: () =>
      csvOf([
        { name: data.x.label, values: data.x.values },
        ...chosenCurves().map((c) => ({
          name: `${c.name} ${/\[.*\]/.exec(data.y.label)?.[0] ?? ''}`.trim(),
          values: c.values,
        })),
      ]),
  });
  const self = {
    setRange: (r) => {
      range = r;
      if (plot) applyRange();
    },
  };
  if (!groups.has(of.group)) groups.set(of.group, new Set());
  groups.get(of.group).add(self);

  const chosenCurves = () => data.curves.filter((c) => shell.chosen.has(c.name));
  const place = (name) => [...shell.chosen].indexOf(name);
  const strokeOf = (name) => colour(place(name));
  const dashOf = (name) => (data.x.values.length > 500 ? [] : dash(place(name))); // of many points dashes are noise

  function showAll() {
    range = null;
    isWhole = true;
    applyRange();
    moveTogether(of.group, null, self);
  }

  function applyRange() {
    const all = data.x.values;
    const [min, max] = range ?? (isWhole ? null : data.x.first) ?? [all[0], all[all.length - 1]];
    plot.setScale('x', { min, max });
    shell.place.dataset.x = `${min} ${max}`;
  }

  function seriesOf(curve, i) {
    return {
      label: curve.name,
      stroke: strokeOf(curve.name),
      width: 1.6,
      dash: dashOf(curve.name),
      points: { show: curve.values.length < 3 },
      gaps: (of_, index, from, to, gaps) =>
        curve.turn ? gaps.concat(turnsOf(of_, index, from, to, curve.turn)).sort((a, b) => a[0] - b[0]) : gaps,
      value: (_, v) => (v === null ? '–' : format(v)),
      scale: 'y',
      index: i,
    };
  }

  function draw() {
    plot?.destroy();
    shell.place.dataset.y = data.y.label;
    const curves = chosenCurves();
    const positive = (v) => (isLog && !(v > 0) ? null : Number.isFinite(v) ? v : null);
    const columns = [data.x.values],
      series = [{ label: data.x.label, value: (_, v) => (v === null ? '–' : format(v, 5)) }],
      bands = [];
    for (const [i, c] of curves.entries()) {
      series.push(seriesOf(c, i));
      columns.push(Array.from(c.values, positive));
    }
    for (const c of curves.filter((one) => one.low)) {
      for (const edge of [c.high, c.low]) {
        series.push({ label: '', stroke: 'transparent', width: 0, points: { show: false }, class: 'edge' });
        columns.push(Array.from(edge, positive));
      }
      bands.push({ series: [series.length - 2, series.length - 1], fill: `${strokeOf(c.name)}2e` });
    }
    const pen = {
      stroke: styled('--ink'),
      grid: { stroke: styled('--grid'), width: 1 },
      ticks: { stroke: styled('--grid'), width: 1 },
    };
    plot = new uPlot(
      {
        width: shell.place.clientWidth || 600,
        height: HEIGHT,
        series,
        bands,
        scales: { x: { time: false, range: (_, min, max) => [min, max] }, y: { distr: isLog ? 3 : 1 } },
        axes: [
          {
            ...pen,
            label: data.x.label,
            labelSize: 22,
            size: 36,
            values: (_, ticks) => ticks.map((v) => format(v, 6)),
          },
          {
            ...pen,
            label: data.y.label,
            labelSize: 22,
            size: (_, texts) => Math.max(62, 16 + 7 * Math.max(0, ...(texts ?? []).map((text) => text.length))),
            values: (_, ticks) => ticks.map((v) => (v === null ? '' : format(v, 3))),
          },
        ],
        cursor: { sync: { key: of.group }, drag: { x: true, y: false }, points: { size: 6 } },
        legend: { live: true, markers: { show: true } },
        hooks: {
          setSelect: [
            (u) => {
              if (u.select.width < 4) return;
              range = [u.posToVal(u.select.left, 'x'), u.posToVal(u.select.left + u.select.width, 'x')];
              shell.place.dataset.x = range.join(' ');
              moveTogether(of.group, range, self);
            },
          ],
        },
      },
      columns,
      shell.place,
    );
    plot.over.addEventListener('dblclick', showAll);
    shell.setColours((name) => inked(place(name), dashOf(name)));
    applyRange();
  }

  whenNear(shell.place, () => {
    seen = true;
    draw();
    new ResizeObserver(() => plot.setSize({ width: shell.place.clientWidth, height: HEIGHT })).observe(shell.place);
  });
  onChange((settings) => {
    const before = data.x.label;
    data = of.read(settings);
    if (data.x.label !== before) ((range = null), (isWhole = false)); // other abscissae
    if (seen) draw();
  });
  return shell.element;
}

/** Where an angle passes from one end of its range to the other: pairs of pixels between which no line is drawn. */
function turnsOf(plot, index, from, to, turn) {
  const [x, y] = [plot.data[0], plot.data[index]];
  const out = [];
  for (let i = from; i < to; ++i)
    if (y[i] !== null && y[i + 1] !== null && Math.abs(y[i + 1] - y[i]) > turn / 2)
      out.push([i, i + 1].map((k) => plot.valToPos(x[k], 'x', true)));
  return out;
}

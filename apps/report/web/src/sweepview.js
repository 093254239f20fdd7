// A sweep: curves along one axis, maps over two, and its cases.
import { h, select, table } from './dom.js';
import { csvOf } from './figure.js';
import { mapFigure } from './map.js';
import { format, labelled } from './units.js';
import { xyFigure } from './xyfigure.js';

const distinct = (values) =>
  [...new Set(values.filter((v) => v !== null))].sort((a, b) =>
    typeof a === 'number' ? a - b : String(a).localeCompare(b),
  );
const isNumeric = (axis) => axis.values.every((v) => v === null || typeof v === 'number');

/** Means of an output over the cases at each value of x, and of y if there is one; NaN where none is done. */
export function gridOf(sweep, of, x, y) {
  const xs = distinct(x.values),
    ys = y ? distinct(y.values) : [null];
  const sums = ys.map(() => xs.map(() => [0, 0]));
  of.values.forEach((v, i) => {
    if (v === null) return;
    const cell = sums[y ? ys.indexOf(y.values[i]) : 0]?.[xs.indexOf(x.values[i])];
    if (cell) {
      cell[0] += v;
      cell[1] += 1;
    }
  });
  return {
    xs,
    ys,
    means: sums.map((row) => row.map(([sum, n]) => (n ? sum / n : NaN))),
    most: Math.max(...sums.flat().map(([, n]) => n)),
  };
}

/** Choices of output and axes, and what comes of them. */
export function sweepFigures(sweep) {
  const axes = sweep.axes.filter((a) => distinct(a.values).length > 1);
  if (!axes.length || !sweep.outputs.length)
    return [h('p', { class: 'note' }, 'There is nothing to draw: no axis takes two values, or no case is done yet.')];
  const asked = sweep.pictures[0] ?? {};
  const by = (all, name, other) => all.find((a) => a.name === name) ?? other;
  let of = by(sweep.outputs, asked.of, sweep.outputs[0]),
    x = by(axes, asked.x, axes[0]);
  let y = by(axes, asked.y ?? asked.by, axes.find((a) => a !== x) ?? null),
    isMap = asked.y !== undefined || !asked.by;
  const place = h('div', {});
  const names = (all) => all.map((a) => [a.name, labelled(a.name, a.unit)]);
  const draw = () => {
    if (y === x) y = axes.find((a) => a !== x) ?? null;
    const canMap = y && isNumeric(x) && isNumeric(y);
    place.replaceChildren(isMap && canMap ? sweepMap(sweep, of, x, y) : curvesFigure(sweep, of, x, y));
  };
  const choices = h(
    'div',
    { class: 'choices' },
    select('Output', names(sweep.outputs), of.name, (v) => {
      of = by(sweep.outputs, v);
      draw();
    }),
    select('Along', names(axes), x.name, (v) => {
      x = by(axes, v);
      draw();
    }),
    axes.length > 1
      ? select('By', names(axes), y.name, (v) => {
          y = by(axes, v);
          draw();
        })
      : null,
    axes.length > 1
      ? select(
          'As',
          [
            ['map', 'map'],
            ['curves', 'curves'],
          ],
          isMap ? 'map' : 'curves',
          (v) => {
            isMap = v === 'map';
            draw();
          },
        )
      : null,
  );
  draw();
  return [choices, place];
}

const meansNote = (grid) =>
  grid.most > 1 ? `Means of up to ${grid.most} cases at one point: further axes vary.` : undefined;

function curvesFigure(sweep, of, x, y) {
  const grid = gridOf(sweep, of, x, y),
    words = !isNumeric(x);
  const xs = words ? grid.xs.map((_, i) => i + 1) : grid.xs;
  return xyFigure({
    title: labelled(of.name, of.unit),
    note:
      [words ? `Along ${x.name}: ${grid.xs.map((v, i) => `${i + 1} ${v}`).join(', ')}.` : '', meansNote(grid) ?? '']
        .join(' ')
        .trim() || undefined,
    read: () => ({
      x: labelled(x.name, words ? '' : x.unit),
      y: labelled(of.name, of.unit),
      curves: grid.ys.map((v, i) => ({
        name: y ? `${y.name} ${typeof v === 'number' ? format(v) : v} ${y.unit}`.trim() : of.name,
        x: xs,
        y: grid.means[i],
        marks: true,
      })),
    }),
  });
}

function sweepMap(sweep, of, x, y) {
  const grid = gridOf(sweep, of, x, y),
    finite = grid.means.flat().filter(Number.isFinite);
  const told = (axis, value) => `${axis.name} ${format(value)} ${axis.unit}`;
  return mapFigure({
    title: labelled(of.name, of.unit),
    note: [meansNote(grid), 'Fields without a colour have no case that is done.'].filter(Boolean).join(' '),
    read: () => ({
      x: { label: labelled(x.name, x.unit), values: grid.xs },
      y: { label: labelled(y.name, y.unit), values: grid.ys },
      value: (i, j) => grid.means[j][i],
      low: Math.min(...finite),
      high: Math.max(...finite),
      name: of.name,
      unit: of.unit,
    }),
    csv: () =>
      csvOf([
        { name: labelled(x.name, x.unit), values: grid.xs },
        ...grid.ys.map((v, i) => ({
          name: `${labelled(of.name, of.unit)} at ${y.name} ${v} ${y.unit}`,
          values: grid.means[i],
        })),
      ]),
    tell: (i, j) => `${told(x, grid.xs[i])}, ${told(y, grid.ys[j])}: ${format(grid.means[j][i])} ${of.unit}`,
  }).element;
}

const MOST_ROWS = 500;

/** Every case with its axes and outputs. */
export function casesTable(sweep) {
  const head = [
    'Case',
    ...sweep.axes.map((a) => labelled(a.name, a.unit)),
    'State',
    ...sweep.outputs.map((o) => labelled(o.name, o.unit)),
  ];
  const rows = sweep.number
    .slice(0, MOST_ROWS)
    .map((n, i) => [
      String(n),
      ...sweep.axes.map((a) => (typeof a.values[i] === 'number' ? format(a.values[i]) : (a.values[i] ?? ''))),
      sweep.state[i],
      ...sweep.outputs.map((o) => format(o.values[i])),
    ]);
  return h(
    'div',
    {},
    table(head, rows, 'Cases'),
    sweep.number.length > MOST_ROWS
      ? h(
          'p',
          { class: 'note' },
          `The first ${MOST_ROWS} of ${sweep.number.length} cases; table.csv of the sweep has all.`,
        )
      : null,
  );
}

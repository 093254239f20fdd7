// The free surface about bodies in one regular wave: its amplitude, the surface while the wave goes by, and the means.
import { onSigned, styled } from './colours.js';
import { numbers } from './data.js';
import { h, select, table } from './dom.js';
import { csvOf } from './figure.js';
import { mapFigure } from './map.js';
import { line } from './plane.js';
import { player } from './player.js';
import { onChange } from './settings.js';
import { following } from './tables.js';
import { format, labelled, printed, shown } from './units.js';

/** Below this share of the drift force there is rounding only. */
const NOTHING = 1e-8;
const BLANK = 'Points in bodies, and where nothing is known, have no colour.';

const sizesOf = (part) => {
  const im = numbers(part.im);
  return Array.from(numbers(part.re), (re, p) => Math.hypot(re, im[p]));
};
const largestOf = (values) => values.reduce((most, v) => (v > most ? v : most), 0);

/** A grid in the reader's unit of length. */
function gridOf(field) {
  const { factor, unit } = shown('m');
  const along = (name) => ({
    label: labelled(name, unit),
    values: Array.from(numbers(field[name]), (v) => v * factor),
  });
  return { x: along('x'), y: along('y'), factor, unit };
}

/** What bodies look like from above, with light beside the ink so that it is seen on any colour. */
function paintOutlines(pen, at, outlines, factor) {
  const trace = (segments) => {
    const s = numbers(segments);
    for (let i = 0; i + 3 < s.length; i += 4)
      line(pen, at.x(s[i] * factor), at.y(s[i + 1] * factor), at.x(s[i + 2] * factor), at.y(s[i + 3] * factor));
  };
  pen.lineCap = 'round';
  for (const [stroke, width] of [
    [styled('--paper'), 3.5],
    [styled('--ink'), 1.5],
  ]) {
    pen.strokeStyle = stroke;
    pen.lineWidth = width;
    for (const one of outlines) trace(one.pierced);
    if (stroke === styled('--ink')) pen.setLineDash([4, 4]);
    for (const one of outlines) trace(one.submerged);
    pen.setLineDash([]);
  }
}

/** As high as the grid is at this width of a plane, within what a window can show. */
const heightOf = (grid) => (width) => {
  const length = (values) => values[values.length - 1] - values[0];
  const ratio = length(grid.y.values) / length(grid.x.values);
  return Math.round(Math.min(Math.max((width - 78) * ratio + 54, 220), 640));
};

/** Amplitude, and the surface over one period: both of the part that is chosen. */
export function fieldFigures(field) {
  const period = (2 * Math.PI) / field.omega,
    outlines = Array.isArray(field.outlines) ? field.outlines : [];
  let part = field.parts[0],
    sizes = sizesOf(part),
    t = 0;
  const columns = numbers(field.x).length;
  const value = (values) => (i, j) => values[j * columns + i];
  const at = (i, j) => {
    const grid = gridOf(field);
    return `x ${format(grid.x.values[i])} ${grid.unit}, y ${format(grid.y.values[j])} ${grid.unit}`;
  };
  const csv = () => {
    const points = [...sizes.keys()];
    const [x, y] = [numbers(field.x), numbers(field.y)];
    const [re, im] = [numbers(part.re), numbers(part.im)];
    return csvOf([
      { name: 'x [m]', values: points.map((p) => x[p % columns]) },
      { name: 'y [m]', values: points.map((p) => y[Math.floor(p / columns)]) },
      { name: 'amplitude [m/m]', values: sizes },
      { name: 'phase [rad]', values: points.map((p) => Math.atan2(im[p], re[p])) },
    ]);
  };
  const over = (pen, place) => paintOutlines(pen, place, outlines, gridOf(field).factor);
  const common = { equal: true, height: heightOf(gridOf(field)), over, csv };

  const amplitude = mapFigure({
    ...common,
    title: 'Amplitude per metre of wave amplitude',
    note: BLANK,
    read: () => ({
      ...gridOf(field),
      value: value(sizes),
      low: sizes.reduce((least, v) => (v < least ? v : least), Infinity),
      high: largestOf(sizes),
      name: `amplitude of ${part.name}`,
      unit: printed(shown(part.unit).unit),
    }),
    tell: (i, j) => `${at(i, j)}: amplitude of ${part.name} ${format(value(sizes)(i, j))} ${part.unit}`,
  });
  // η(t) = Re(η e^{iωt})
  const elevation = () => {
    const [c, s] = [Math.cos(field.omega * t), Math.sin(field.omega * t)];
    const [re, im] = [numbers(part.re), numbers(part.im)];
    return (i, j) => re[j * columns + i] * c - im[j * columns + i] * s;
  };
  const clock = player([0, period], (now) => {
    t = now;
    surface?.draw();
  });
  let surface = null;
  surface = mapFigure({
    ...common,
    title: 'Surface while the wave goes by',
    note: `At t = 0 the wave that comes has its crest at the origin. ${BLANK}`,
    scale: onSigned,
    player: clock.element,
    read: () => ({
      ...gridOf(field),
      value: elevation(),
      low: -largestOf(sizes),
      high: largestOf(sizes),
      name: `${part.name} at t = ${t.toFixed(1)} s`,
      unit: printed(shown(part.unit).unit),
    }),
    tell: (i, j) => `${at(i, j)}: ${format(elevation()(i, j))} ${part.unit}`,
  });
  clock.goTo(0);
  onChange(() => clock.stop());

  const choice = h(
    'div',
    { class: 'choices' },
    select(
      'Part',
      field.parts.map((p) => [p.name, `${p.name}: ${p.long_name.replace(/ per metre of wave amplitude$/, '')}`]),
      part.name,
      (name) => {
        part = field.parts.find((p) => p.name === name);
        sizes = sizesOf(part);
        amplitude.draw();
        surface.draw();
      },
    ),
  );
  const missing = field.outlines.missing ? h('p', { class: 'note' }, field.outlines.missing) : null;
  return [choice, h('div', { class: 'figures' }, amplitude.element, surface.element), missing];
}

/** The highest and the lowest amplitude of the free surface, and where. */
export function extremesTable(field) {
  return following(() => {
    const sizes = sizesOf(field.parts[0]);
    const grid = gridOf(field),
      columns = grid.x.values.length;
    const known = [...sizes.keys()].filter((p) => Number.isFinite(sizes[p]));
    const best = (better) => known.reduce((b, p) => (better(sizes[p], sizes[b]) ? p : b), known[0]);
    const row = (word, p) => [
      word,
      `${format(sizes[p])} ${field.parts[0].unit}`,
      `${format(grid.x.values[p % columns])} ${grid.unit}`,
      `${format(grid.y.values[Math.floor(p / columns)])} ${grid.unit}`,
    ];
    if (!known.length) return h('p', { class: 'note' }, 'Nothing is known at any point of the grid.');
    return table(
      ['Free surface', 'Amplitude', 'x', 'y'],
      [row('highest', best((a, b) => a > b)), row('lowest', best((a, b) => a < b))],
      'Extremes on the grid',
    );
  });
}

/** Mean drift of each body by itself, where it was asked for. */
function bodyDrift(bodies, told) {
  if (!bodies.length) return [];
  const largest = (name) => Math.max(...bodies.map((one) => Math.abs(one[name].value)));
  const force = Math.max(largest('body_drift_x'), largest('body_drift_y')),
    moment = largest('body_drift_moment');
  return [
    table(
      ['Body', 'Force along x', 'Force along y', 'Moment about the vertical'],
      bodies.map((one) => [
        one.body,
        told(one.body_drift_x, force),
        told(one.body_drift_y, force),
        told(one.body_drift_moment, moment),
      ]),
      'Mean drift of each body by itself, moments through its origin, per square metre of wave amplitude',
    ),
  ];
}

/** Mean drift and power, per square metre of wave amplitude. */
export function meansTable(field) {
  return following(() => {
    const { drift_x, drift_y, power_taken, power_sent_out } = field.means;
    const force = Math.hypot(drift_x.value, drift_y.value),
      angle = shown('rad');
    const isNothing = (v) => v !== 0 && Math.abs(v) < NOTHING * force;
    const told = ({ value, unit }, largest = Math.abs(value)) => {
      const by = shown(unit, largest);
      return isNothing(value) ? '0 (rounding)' : `${format(value * by.factor)} ${by.unit}`;
    };
    const along = (v) => (isNothing(v) ? 0 : v);
    return h(
      'div',
      {},
      table(
        ['Of all bodies together', 'Value'],
        [
          ['mean drift force along x', told(drift_x, force)],
          ['mean drift force along y', told(drift_y, force)],
          ['mean drift force', told({ value: force, unit: drift_x.unit })],
          [
            'its direction, from x towards y',
            force > 0
              ? `${format(Math.atan2(along(drift_y.value), along(drift_x.value)) * angle.factor)} ${angle.unit}`
              : '–',
          ],
          ['mean power that the bodies take from the waves', told(power_taken)],
          ['mean power of scattered and radiated waves', told(power_sent_out)],
        ],
        'Mean drift and power per square metre of wave amplitude',
      ),
      ...bodyDrift(field.body_drift, told),
      h(
        'p',
        { class: 'note' },
        'To second order, by what waves carry far away. Vertical forces are not known, and forces of single bodies ' +
          'only where body_drift of the scene asks for them. ' +
          (field.bodies === 'held still'
            ? 'Bodies that are held still take no power: what they seem to take is the error of these numbers.'
            : ''),
      ),
    );
  });
}

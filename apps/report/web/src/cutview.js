// Loads at sections of hulls: along the hull in waves and at rest, and as a table.
import { numbers, grouped } from './data.js';
import { table } from './dom.js';
import { titleOf } from './quantity.js';
import { labelled, format, shown } from './units.js';
import { xyFigure } from './xyfigure.js';

const COMPONENTS = ['force_x', 'force_y', 'force_z', 'moment_x', 'moment_y', 'moment_z'];
const DEGREE = Math.PI / 180;

const bodyOf = (section) => section.name.slice(0, section.name.lastIndexOf('.'));
const along = (section) => section.at_rest.at_x.value;

/** The largest amplitude of a signal in waves of heading number k, and its frequency. */
function peakOf(rao, signal, k) {
  const n = numbers(rao.omega).length,
    re = numbers(signal.re),
    im = numbers(signal.im);
  let best = k * n;
  const size = (i) => Math.hypot(re[i], im[i]);
  for (let i = k * n; i < (k + 1) * n; ++i) if (size(i) > size(best)) best = i;
  return { size: size(best), omega: numbers(rao.omega)[best - k * n] };
}

const signalOf = (rao, section, component) => rao.signals.find((s) => s.name === `${section.name}.${component}`);

/** Sections of one body across its length in one direction, from stern to bow, where there are two at least. */
function rowsOf(rao) {
  const key = (s) => [bodyOf(s), ...['x', 'y', 'z'].map((axis) => s.at_rest[`normal_${axis}`].value)].join(' ');
  return [...grouped(rao.sections ?? [], key).values()]
    .filter((row) => row.length > 1 && Math.abs(row[0].at_rest.normal_x.value) > 0.99)
    .map((row) => row.sort((a, b) => along(a) - along(b)));
}

function figureAlong(title, row, curves, unit, word) {
  return xyFigure({
    title,
    read: () => {
      const { factor, unit: told } = shown(unit, Math.max(...curves.flatMap((c) => c.values.map(Math.abs))));
      const metres = shown('m');
      return {
        x: labelled('x from the origin of the body', metres.unit),
        y: labelled(word, told),
        curves: curves.map((c) => ({
          name: c.name,
          x: row.map((s) => along(s) * metres.factor),
          y: c.values.map((v) => v * factor),
          marks: true,
        })),
      };
    },
  });
}

function amplitudesAlong(rao, row, component) {
  const signals = row.map((s) => signalOf(rao, s, component));
  if (signals.some((s) => !s)) return null;
  const several = rao.heading.length > 1;
  const curves = rao.heading.map((heading, k) => ({
    name: several ? `${format(heading / DEGREE, 3)}°` : 'largest of all periods',
    values: signals.map((s) => peakOf(rao, s, k).size),
  }));
  const title = `${bodyOf(row[0])}: ${titleOf(component).toLowerCase()} along the hull, largest amplitude`;
  return figureAlong(title, row, curves, signals[0].unit, 'amplitude');
}

function restAlong(row, component) {
  const values = row.map((s) => s.at_rest[component].value);
  const title = `${bodyOf(row[0])}: ${titleOf(component).toLowerCase()} along the hull at rest`;
  return figureAlong(title, row, [{ name: 'at rest', values }], row[0].at_rest[component].unit, 'at rest');
}

/** Of each row of sections one figure in waves and one at rest for each component that is asked for. */
export function sectionFigures(rao) {
  return rowsOf(rao).flatMap((row) =>
    COMPONENTS.flatMap((component) => {
      const inWaves = amplitudesAlong(rao, row, component);
      return inWaves ? [inWaves, restAlong(row, component)] : [];
    }),
  );
}

function rowOf(rao, section, signal, component) {
  const rest = section.at_rest[component];
  const peaks = rao.heading.map((_, k) => peakOf(rao, signal, k));
  const k = peaks.reduce((best, p, i) => (p.size > peaks[best].size ? i : best), 0);
  const still = shown(rest.unit, Math.abs(rest.value)),
    wave = shown(signal.unit, peaks[k].size),
    metres = shown('m');
  return [
    section.name,
    component.replace('_', ' '),
    `${format(along(section) * metres.factor)} ${metres.unit}`,
    `${format(rest.value * still.factor)} ${still.unit}`,
    `${format(peaks[k].size * wave.factor)} ${wave.unit}`,
    `${format((2 * Math.PI) / peaks[k].omega)} s`,
    `${format(rao.heading[k] / DEGREE, 3)}°`,
    signal.error === undefined ? '–' : `${format(100 * signal.error, 2)} %`,
  ];
}

/** What each section carries at rest, and in waves at most. */
export function sectionTable(rao) {
  const rows = rao.sections.flatMap((section) =>
    COMPONENTS.flatMap((component) => {
      const signal = signalOf(rao, section, component);
      return signal ? [rowOf(rao, section, signal, component)] : [];
    }),
  );
  return table(
    ['Section', 'Load', 'at x', 'at rest', 'Largest amplitude', 'at period', 'in waves towards', 'Estimated error of the peak'],
    rows,
    'Loads at sections, on the part that each describes',
  );
}

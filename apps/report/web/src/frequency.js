// Response amplitude operators, free motions, and tables along a frequency.
import { curveFigure } from './curves.js';
import { grouped, numbers } from './data.js';
import { h, table } from './dom.js';
import { quantityOf, sortedQuantities, split, titleOf } from './quantity.js';
import { settings } from './settings.js';
import { ABSCISSAE, format, labelled, shown } from './units.js';

const DEGREE = Math.PI / 180;

/** Every response of these results as a curve: one a heading. */
function curvesOf(results) {
  return results.flatMap((rao) => {
    const omega = numbers(rao.omega),
      several = rao.heading.length > 1;
    return rao.signals.flatMap((s) =>
      rao.heading.map((heading, k) => {
        const part = (list) => numbers(list).slice(k * omega.length, (k + 1) * omega.length);
        const owner = split(s.name)[0] || s.name;
        const words = [owner, several ? `${format(heading / DEGREE, 3)}°` : '', results.length > 1 ? rao.label : ''];
        return {
          name: s.name,
          unit: s.unit,
          label: words.filter(Boolean).join(', '),
          omega,
          re: part(s.re),
          im: part(s.im),
        };
      }),
    );
  });
}

const TURN = 2 * Math.PI;
/** Of a size below this share of the largest one of a figure there is rounding only, which has no phase. */
const NOTHING = 1e-8;
const NO_PHASE = 'Where a response is below 1e-8 of the largest one it is rounding, whose phase is not drawn.';

/** Points of a curve on the frequencies of all curves of its figure, by straight lines; phases by the shorter way. */
function onto(omega, curve, values, turns) {
  if (omega === curve.omega) return Array.from(values);
  let k = 0;
  const w = curve.omega;
  return Array.from(omega, (at) => {
    if (at < w[0] || at > w[w.length - 1]) return NaN;
    while (k + 2 < w.length && w[k + 1] < at) ++k;
    const step = values[k + 1] - values[k];
    const value =
      values[k] + ((at - w[k]) / (w[k + 1] - w[k])) * (turns ? step - TURN * Math.round(step / TURN) : step);
    return turns ? value - TURN * Math.round(value / TURN) : value;
  });
}

function raoFigure(title, all, group, part) {
  const same = all.every(
    (c) => c.omega.length === all[0].omega.length && c.omega.every((w, i) => w === all[0].omega[i]),
  );
  const omega = same ? all[0].omega : Float64Array.from(new Set(all.flatMap((c) => [...c.omega]))).sort();
  const nothing = NOTHING * Math.max(...all.map((c) => Math.max(...sizes(c))));
  return curveFigure({
    title: `${title}: ${part.word}`,
    group,
    log: part.log,
    note: part.turns && all.some((c) => part.of(c, nothing).some(Number.isNaN)) ? NO_PHASE : undefined,
    read: () => {
      const order = [...omega.keys()];
      if (settings.abscissa === 'T') order.reverse();
      const lists = all.map((c) => onto(same ? c.omega : omega, c, part.of(c, nothing), part.turns));
      const largest = Math.max(...lists.map((l) => Math.max(...l.filter(Number.isFinite))));
      const { factor, unit } = part.unit(all[0].unit, largest);
      return {
        x: {
          label: ABSCISSAE[settings.abscissa].label,
          values: order.map((i) => ABSCISSAE[settings.abscissa].of(omega[i])),
        },
        y: { label: labelled(part.word, unit) },
        curves: all.map((c, i) => ({
          name: c.label,
          values: order.map((k) => lists[i][k] * factor),
          turn: part.turns ? TURN * factor : undefined,
        })),
      };
    },
  });
}

const sizes = (c) => Array.from(c.re, (re, i) => Math.hypot(re, c.im[i]));
const AMPLITUDE = { word: 'amplitude', of: sizes, unit: shown };
const PHASE = {
  word: 'phase',
  log: false,
  turns: true,
  of: (c, nothing) => sizes(c).map((size, i) => (size > nothing ? Math.atan2(c.im[i], c.re[i]) : NaN)),
  unit: () => (settings.angle === 'deg' ? { factor: 1 / DEGREE, unit: 'deg' } : { factor: 1, unit: 'rad' }),
};

/** Amplitude and phase, one pair of figures a quantity; several results lie over each other. */
export function raoFigures(results, group) {
  return sortedQuantities(grouped(curvesOf(results), quantityOf)).flatMap(([key, all]) => [
    raoFigure(titleOf(key), all, group, AMPLITUDE),
    raoFigure(titleOf(key), all, group, PHASE),
  ]);
}

/** The peak of every response. */
export function peaksTable(rao) {
  const rows = curvesOf([rao]).map((c) => {
    const size = sizes(c);
    const i = size.indexOf(Math.max(...size));
    const { factor, unit } = shown(c.unit, size[i]);
    return [
      `${c.name}${c.label.includes('°') ? ` ${c.label.split(', ')[1]}` : ''}`,
      `${format(size[i] * factor)} ${unit}`,
      `${format((2 * Math.PI) / c.omega[i])} s`,
    ];
  });
  return table(['Response', 'Largest amplitude', 'at period'], rows, 'The largest of every response');
}

/** Periods, damping and the motions that matter in each free motion. */
export function modesTable(modes) {
  const n = modes.motions.length;
  const rows = modes.period.map((period, i) => {
    const shape = modes.shape.slice ? numbers(modes.shape).slice(i * n, (i + 1) * n) : [];
    const largest = Math.max(...shape.map(Math.abs)) || 1;
    const told = [...shape.keys()]
      .sort((a, b) => Math.abs(shape[b]) - Math.abs(shape[a]))
      .slice(0, 4)
      .filter((k) => Math.abs(shape[k]) > 0.05 * largest)
      .map((k) => `${modes.motions[k]} ${format(shape[k] / largest, 2)}`);
    const damping = modes.damping[i];
    return [
      String(i + 1),
      `${format(period)} s`,
      `${format(modes.omega[i])} rad/s`,
      damping === null ? 'it creeps' : `${format(100 * damping, 3)} %`,
      told.join(', '),
    ];
  });
  return table(['Mode', 'Undamped period', 'ω', 'Damping ratio', 'Largest motions (m and rad)'], rows, 'Free motions');
}

/** Columns of a table along the first; `x_low` and `x_high` are the interval of `x`. */
export function tableFigures(result, group) {
  const [first, ...others] = result.columns;
  const byName = new Map(others.map((c) => [c.name, c]));
  const curves = others.filter((c) => !/_(low|high)$/.test(c.name) || !byName.has(c.name.replace(/_(low|high)$/, '')));
  const isFrequency = first.name === 'frequency' || first.unit === 'rad/s';
  const x = numbers(first.values),
    omega = x.map((v) => (first.unit === 'rad/s' ? v : 2 * Math.PI * v));
  return [...grouped(curves, (c) => c.unit)].map(([unit, all]) =>
    curveFigure({
      title:
        all
          .map((c) => c.name)
          .slice(0, 3)
          .join(', ') + (all.length > 3 ? ', …' : ''),
      group,
      note: result.piece > 1 ? `Of each ${result.piece} rows the lowest and the highest value are drawn.` : undefined,
      read: () => {
        const abscissa = ABSCISSAE[settings.abscissa];
        const order = [...x.keys()].filter((i) => !isFrequency || settings.abscissa !== 'T' || x[i] > 0);
        if (isFrequency && settings.abscissa === 'T') order.reverse();
        const along = (c) => order.map((i) => numbers(c.values)[i]);
        return {
          x: isFrequency
            ? { label: abscissa.label, values: order.map((i) => abscissa.of(omega[i])) }
            : { label: labelled(first.name, first.unit), values: order.map((i) => x[i]) },
          y: { label: labelled('', unit).trim() || 'value' },
          curves: all.map((c) => ({
            name: c.name,
            values: along(c),
            ...(byName.has(`${c.name}_low`)
              ? { low: along(byName.get(`${c.name}_low`)), high: along(byName.get(`${c.name}_high`)) }
              : {}),
          })),
        };
      },
    }),
  );
}

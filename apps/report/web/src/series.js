// Series, spectra, phase plots and trajectories of runs, of one or of several over each other.
import { curveFigure } from './curves.js';
import { grouped, numbers } from './data.js';
import { h } from './dom.js';
import { MODES, isEnergy, isLoad, quantityOf, sortedQuantities, split, titleOf } from './quantity.js';
import { settings } from './settings.js';
import { ABSCISSAE, densityUnit, format, labelled, shown } from './units.js';
import { xyFigure } from './xyfigure.js';

/** "Heave", and "Load in heave" where it is a force or a moment. */
const headed = (key, all) =>
  isLoad(all[0]) && MODES.includes(key.split('\n')[0]) ? `Load in ${key.split('\n')[0]}` : titleOf(key);

const scaled = (values, factor) => (factor === 1 ? values : Array.from(values, (v) => v * factor));
const largestOf = (lists) =>
  lists.reduce((most, list) => list.reduce((m, v) => Math.max(m, Math.abs(v) || 0), most), 0);

/** What is said of a figure whose series are thinned. */
export function thinned(run) {
  const { piece, samples, shown: points } = run.record;
  return piece > 1
    ? `Drawn in ${points} of ${samples} points: of each ${piece} samples the lowest and the highest value.`
    : undefined;
}

/** One figure a quantity. @param {object} run @param {string} group of abscissae that move together */
export function seriesFigures(run, group) {
  const time = numbers(run.time);
  const signals = run.signals.filter((s) => !isEnergy(s));
  return sortedQuantities(grouped(signals, quantityOf)).map(([key, all]) =>
    curveFigure({
      title: headed(key, all),
      group,
      note: thinned(run),
      log: false,
      read: () => {
        const lists = all.map((s) => numbers(s.values));
        const { factor, unit } = shown(all[0].unit, largestOf(lists));
        return {
          x: { label: 'time t [s]', values: time },
          y: { label: labelled(split(all[0].name)[1].replaceAll('_', ' '), unit) },
          curves: all.map((s, i) => ({ name: split(s.name)[0] || s.name, values: scaled(lists[i], factor) })),
        };
      },
    }),
  );
}

/** Densities over period, ω or f, with their interval where one curve is drawn. */
export function spectrumFigures(run, group) {
  const { spectra } = run;
  if (!spectra || spectra.missing) return [h('p', { class: 'note' }, spectra?.missing ?? 'There are no spectra.')];
  const frequency = numbers(spectra.frequency);
  const begin = frequency[0] === 0 ? 1 : 0; // a mean has no period
  const signals = run.signals.filter((s) => s.name in spectra.signals);
  const note =
    `Welch's method: segments of ${spectra.segment.toPrecision(4)} s that overlap by half, resolution ` +
    `${spectra.resolution.toPrecision(3)} Hz, ${spectra.dof.toPrecision(3)} degrees of freedom; ` +
    `with ${100 * spectra.confidence} % the density is ` +
    `between ${spectra.low.toPrecision(3)} and ${spectra.high.toPrecision(3)} times the curve ` +
    '(shaded for the first one). Made before the series were thinned.';
  return sortedQuantities(grouped(signals, quantityOf)).map(([key, all], number) =>
    curveFigure({
      title: `${headed(key, all)}: spectral density`,
      group,
      note: [number ? '' : note, unresolved(all, spectra)].filter(Boolean).join(' ') || undefined,
      read: () => {
        const order = [...frequency.keys()].slice(begin);
        const abscissa = ABSCISSAE[settings.abscissa];
        if (settings.abscissa === 'T') order.reverse();
        const lists = all.map((s) => numbers(spectra.signals[s.name]));
        const { factor, unit } = densityUnit(all[0].unit, settings.abscissa, Math.sqrt(largestOf(lists)));
        const along = (list, times) => order.map((i) => list[i] * times);
        return {
          x: {
            label: abscissa.label,
            values: order.map((i) => abscissa.of(2 * Math.PI * frequency[i])),
            first: settings.abscissa === 'T' ? mostOf(frequency, lists) : undefined,
          },
          y: { label: labelled('S', unit) },
          curves: all.map((s, i) => ({
            name: split(s.name)[0] || s.name,
            values: along(lists[i], factor),
            ...(i === 0
              ? { low: along(lists[i], factor * spectra.low), high: along(lists[i], factor * spectra.high) }
              : {}),
          })),
        };
      },
    }),
  );
}

/** What the segments are too short for. */
function unresolved(all, spectra) {
  const names = all.filter((s) => spectra.unresolved.includes(s.name)).map((s) => split(s.name)[0] || s.name);
  return names.length
    ? `Not resolved: more than a fifth of the variance of ${names.join(', ')} lies at periods above ` +
        `${format(spectra.segment / 1.5, 3)} s, for which the record is too short.`
    : '';
}

/** Periods from the shortest to that beyond which a thousandth of the variance of each lies. */
function mostOf(frequency, lists) {
  let lowest = frequency.length - 1;
  for (const list of lists) {
    const sum = list.reduce((all, v) => all + v, 0);
    let i = 1,
      below = 0;
    while (i < lowest && (below += list[i]) < 1e-3 * sum) ++i;
    lowest = Math.min(lowest, i);
  }
  return [1 / frequency[frequency.length - 1], 1 / frequency[lowest]];
}

/** The velocity over the motion, one figure a quantity of length or angle. */
export function phaseFigures(run) {
  const { phase } = run;
  const signals = run.signals.filter(
    (s) =>
      s.name in phase.signals &&
      (s.unit === 'm' || s.unit === 'rad') &&
      s.name !== 'wave.elevation' &&
      !/^[xyz]$/.test(split(s.name)[1]),
  );
  const note =
    `From ${phase.from.toPrecision(5)} to ${phase.to.toPrecision(5)} s` +
    `${phase.whole ? '' : ', the end of the record'}; ` +
    'velocities are central differences of it.';
  return sortedQuantities(grouped(signals, quantityOf)).map(([key, all], number) =>
    xyFigure({
      title: `${titleOf(key)}: phase`,
      note: number ? undefined : note,
      read: () => {
        const { factor, unit } = shown(all[0].unit);
        const word = split(all[0].name)[1].replaceAll('_', ' ');
        return {
          x: labelled(word, unit),
          y: labelled(`${word} rate`, `${unit}/s`),
          curves: all.map((s) => ({
            name: split(s.name)[0] || s.name,
            x: scaled(numbers(phase.signals[s.name].x), factor),
            y: scaled(numbers(phase.signals[s.name].v), factor),
          })),
        };
      },
    }),
  );
}

/** Paths in plan and in elevation, of bodies (surge, sway, heave) and of points (x, y, z). */
export function trajectoryFigures(run) {
  const { phase } = run;
  const paths = [
    ['surge', 'sway', 'heave'],
    ['x', 'y', 'z'],
  ].flatMap(([x, y, z]) =>
    [
      [x, y],
      [x, z],
    ].map(([a, b]) => ({ a, b })),
  );
  return paths.flatMap(({ a, b }) => {
    const owners = run.signals
      .filter((s) => split(s.name)[1] === a && s.unit === 'm') // a mooring's surge is a load
      .map((s) => split(s.name)[0])
      .filter((owner) => `${owner}.${a}` in phase.signals && `${owner}.${b}` in phase.signals);
    if (!owners.length) return [];
    return [
      xyFigure({
        title: `Trajectories: ${b} over ${a}`,
        equal: true,
        read: () => {
          const { factor, unit } = shown('m');
          const of = (owner, word) => scaled(numbers(phase.signals[`${owner}.${word}`].x), factor);
          return {
            x: labelled(a, unit),
            y: labelled(b, unit),
            curves: owners.map((o) => ({ name: o, x: of(o, a), y: of(o, b) })),
          };
        },
      }),
    ];
  });
}

/** The same signal of several runs over each other; each run has times of its own, which are joined. */
export function comparedFigures(runs, group) {
  const names = runs[0].signals.filter(
    (s) => !isEnergy(s) && runs.slice(1).some((r) => r.signals.some((o) => o.name === s.name && o.unit === s.unit)),
  );
  return names.map((signal) =>
    curveFigure({
      title: signal.name,
      group,
      log: false,
      read: () => {
        const those = runs.map((run) => [run, run.signals.find((s) => s.name === signal.name)]).filter(([, s]) => s);
        const { factor, unit } = shown(signal.unit, largestOf(those.map(([, s]) => numbers(s.values))));
        const joined = joinTimes(those.map(([run, s]) => [numbers(run.time), numbers(s.values)]));
        return {
          x: { label: 'time t [s]', values: joined.time },
          y: { label: labelled(split(signal.name)[1], unit) },
          curves: those.map(([run], i) => ({ name: run.label, values: scaled(joined.values[i], factor) })),
        };
      },
    }),
  );
}

/** Series of other times on the times of all, by straight lines; NaN outside of their record. */
export function joinTimes(all) {
  const time = Float64Array.from(new Set(all.flatMap(([t]) => [...t]))).sort();
  const values = all.map(([t, v]) => {
    let k = 0;
    return Array.from(time, (at) => {
      if (at < t[0] || at > t[t.length - 1]) return NaN;
      while (k + 2 < t.length && t[k + 1] < at) ++k;
      return v[k] + ((at - t[k]) / (t[k + 1] - t[k])) * (v[k + 1] - v[k]);
    });
  });
  return { time, values };
}

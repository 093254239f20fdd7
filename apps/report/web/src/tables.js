// Tables of a run: statistics, loads, accuracy, energy, time.
import { h, table } from './dom.js';
import { isEnergy, isLoad } from './quantity.js';
import { onChange } from './settings.js';
import { format, shown } from './units.js';

/** An element that is made anew when the reader changes units. */
export function following(make) {
  const place = h('div', {});
  const fill = () => place.replaceChildren(make());
  fill();
  onChange(fill);
  return place;
}

function statisticsRow(signal) {
  const s = signal.statistics;
  if (!s) return [signal.name, signal.unit || '1', 'not finite', '', '', '', '', ''];
  const { factor, unit } = shown(signal.unit, Math.max(Math.abs(s.least), Math.abs(s.largest)));
  const told = (v) => (v === undefined ? '–' : format(v * factor));
  return [
    signal.name,
    unit || '1',
    told(s.mean),
    told(s.deviation),
    told(s.least),
    told(s.largest),
    told(s.significant),
    s.waves === undefined ? '–' : String(s.waves),
    s.mean_period === undefined ? '–' : format(s.mean_period, 3),
  ];
}

const STATISTICS = [
  'Signal',
  'Unit',
  'Mean',
  'Standard deviation',
  'Least',
  'Largest',
  'Significant double amplitude',
  'Cycles',
  'Mean period [s]',
];

export const motionTable = (run) =>
  following(() =>
    table(STATISTICS, run.signals.filter((s) => !isEnergy(s) && !isLoad(s)).map(statisticsRow), 'Motions and others'),
  );
export const loadTable = (run) =>
  following(() =>
    table(
      STATISTICS,
      run.signals.filter((s) => isLoad(s)).map(statisticsRow),
      'Loads of connectors, joints, moorings and lines',
    ),
  );

/** Errors as shares of each signal, by source. */
export function accuracyTable(run) {
  const signals = run.signals.filter((s) => s.error && s.error.total > 0);
  const sources = [...new Set(signals.flatMap((s) => Object.keys(s.error.sources)))];
  const percent = (v) => (v === undefined ? '–' : `${format(100 * v, 2)} %`);
  const rows = [...signals]
    .sort((a, b) => b.error.total - a.error.total)
    .map((s) => [
      s.name,
      percent(s.error.total),
      ...sources.map((source) => percent(s.error.sources[source])),
      s.error.predictable_until === undefined ? '' : `until ${format(s.error.predictable_until)} s`,
    ]);
  return table(
    ['Signal', 'Estimated error', ...sources.map((s) => `from ${s}`), 'Predictable'],
    rows,
    'Estimated error, largest first',
  );
}

const LEDGER = ['supplied', 'stored', 'dissipated'];

/** The energy ledger at the end: by effect what was supplied, stored and dissipated. */
export function energyTable(run) {
  const effects = new Map(),
    single = [];
  for (const [name, value] of run.energy) {
    const at = name.lastIndexOf('.'),
      word = name.slice(at + 1);
    if (at < 0 || !LEDGER.includes(word)) {
      single.push([name, value]);
      continue;
    }
    const effect = name.slice(0, at);
    if (!effects.has(effect)) effects.set(effect, {});
    effects.get(effect)[word] = value;
  }
  const largest = Math.max(...run.energy.map(([, v]) => Math.abs(v)), 0);
  const { factor, unit } = shown('J', largest);
  const rows = [...effects].map(([effect, of]) => [effect, ...LEDGER.map((w) => format((of[w] ?? 0) * factor))]);
  return h(
    'div',
    { class: 'beside' },
    table(['Effect', ...LEDGER.map((w) => `${w} [${unit}]`)], rows, 'Energy ledger at the end of the run'),
    table(
      ['Sum', unit],
      single.map(([name, v]) => [name.replaceAll('_', ' '), format(v * factor)]),
      'Sums',
    ),
  );
}

/** Where the wall time went, as bars. */
export function timeShares(run) {
  const sum = run.wall_time.reduce((s, [, v]) => s + v, 0);
  return h(
    'div',
    { class: 'bars' },
    run.wall_time.map(([name, seconds]) =>
      h(
        'div',
        { class: 'bar' },
        h('span', {}, name),
        h(
          'span',
          { class: 'track' },
          h('span', { class: 'fill', style: `width:${sum > 0 ? (100 * seconds) / sum : 0}%` }),
        ),
        h('span', { class: 'number' }, `${format(seconds, 3)} s`),
      ),
    ),
  );
}

/** The plan of a scene: what runs and how, and what is left out. */
export function planTable(plan) {
  if (plan.missing)
    return h(
      'p',
      { class: 'note' },
      `The plan of the scene is not told, since it cannot be read where it is now: ${plan.missing}.`,
    );
  return h(
    'div',
    {},
    plan.sections.map((s) =>
      table(
        ['Effect', 'Method', 'Size'],
        s.lines.map(([effect, method, size, runs]) => [runs ? effect : `${effect} (left out)`, method, size]),
        s.title,
      ),
    ),
    plan.notes.length
      ? h(
          'ul',
          { class: 'note' },
          plan.notes.map((n) => h('li', {}, n)),
        )
      : null,
  );
}

/** How runs differ from the first one. */
export function differenceTable(difference) {
  return following(() => {
    const rows = difference.rows.map((r) => {
      const { factor, unit } = shown(
        r.unit,
        Math.max(...[r.first, r.second].flatMap((s) => [Math.abs(s.least), Math.abs(s.largest)])),
      );
      const told = (v) => format(v * factor);
      const share = r.first.deviation > 0 ? `${format((100 * r.rms) / r.first.deviation, 3)} %` : '–';
      return [
        r.signal,
        unit || '1',
        told(r.first.mean),
        told(r.second.mean),
        told(r.first.deviation),
        told(r.second.deviation),
        told(r.first.largest),
        told(r.second.largest),
        told(r.rms),
        share,
        told(r.largest_difference),
      ];
    });
    return table(
      [
        'Signal',
        'Unit',
        'Mean, first',
        'Mean, second',
        'Deviation, first',
        'Deviation, second',
        'Largest, first',
        'Largest, second',
        'Difference, rms',
        'of the deviation',
        'Largest difference',
      ],
      rows,
      `${difference.second} (second) against ${difference.first} (first)`,
    );
  });
}

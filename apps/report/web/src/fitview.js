// A fit: values with their intervals, what belongs to them, and the figures of measured against fitted.
import { numbers } from './data.js';
import { folded, h, table } from './dom.js';
import { format, labelled, printed } from './units.js';
import { xyFigure } from './xyfigure.js';

const told = (v) =>
  typeof v === 'number'
    ? format(v, 5)
    : typeof v === 'boolean'
      ? v
        ? 'yes'
        : 'no'
      : Array.isArray(v)
        ? v.map(told).join(', ')
        : v === null
          ? '–'
          : String(v);
const isTable = (v) => v !== null && typeof v === 'object' && !Array.isArray(v);
const isList = (v) => Array.isArray(v) && v.some(isTable);

const isEstimate = (v) => isTable(v) && ('interval' in v || v.identifiable === false);

/** All estimates below, with what they are of, nothing for all together: `{name, of: 'run_1.csv', estimate}`. */
function estimatesIn(tree, of = []) {
  return Object.entries(tree).flatMap(([name, v]) => {
    if (isEstimate(v)) return [{ name, of: of.join(' '), estimate: v }];
    if (isList(v)) return v.flatMap((one, i) => estimatesIn(one, [...of, one.file ?? one.of ?? `${name} ${i + 1}`]));
    return isTable(v) ? estimatesIn(v, of) : [];
  });
}

/** The one estimate of a coefficient, that of all runs together if there is; none where runs have one each. */
function estimateOf(name, all) {
  const same = all.filter((e) => e.name === name);
  const together = same.filter((e) => e.of === '');
  return together.length === 1 ? together[0] : same.length === 1 ? same[0] : null;
}

const HEAD = ['Value', 'Interval', 'Standard error', 'Systematic error'];
const cellsOf = (value, estimate) => [
  estimate?.identifiable === false
    ? `not told: ${estimate.why_not ?? estimate.why ?? 'the data do not tell it'}`
    : value,
  estimate?.interval ? estimate.interval.map((v) => format(v, 5)).join(' to ') : '–',
  format(estimate?.standard_error, 3),
  format(estimate?.systematic_error, 3),
];

/** Coefficients with their intervals, and below them the estimates of single runs, where these are others. */
function estimatesTables(tree) {
  const all = estimatesIn(tree);
  const coefficients = Object.entries(isTable(tree.coefficients) ? tree.coefficients : {});
  const those = coefficients.map(([name, v]) => [name, v, estimateOf(name, all)]);
  const used = new Set(those.map(([, , found]) => found));
  const others = all.filter((e) => !used.has(e));
  const words = (name) => name.replaceAll('_', ' ');
  return [
    those.length
      ? table(
          ['Coefficient', ...HEAD],
          those.map(([name, v, found]) => [words(name), ...cellsOf(told(v), found?.estimate)]),
          'Coefficients',
        )
      : null,
    others.length
      ? table(
          ['Of', 'Estimate', ...HEAD],
          others.map(({ name, of, estimate }) => [
            of,
            words(name),
            ...cellsOf(told(estimate.value ?? null), estimate),
          ]),
          'Estimates',
        )
      : null,
  ];
}

/** Whatever stands in a tree of facts, level by level. */
export function treeOf(tree, title, open = true) {
  const plain = Object.entries(tree).filter(([, v]) => !isTable(v) && !isList(v));
  const parts = Object.entries(tree).filter(([, v]) => isTable(v));
  const lists = Object.entries(tree).filter(([, v]) => isList(v));
  return folded(
    title,
    open,
    plain.length
      ? table(
          ['', ''],
          plain.map(([k, v]) => [k.replaceAll('_', ' '), told(v)]),
          title,
        )
      : null,
    parts.map(([k, v]) => treeOf(v, k.replaceAll('_', ' '), open)),
    lists.flatMap(([k, all]) => all.map((v, i) => treeOf(v, `${k.replaceAll('_', ' ')} ${i + 1}`, all.length < 4))),
  );
}

export function fitParts(fit) {
  const { coefficients: _, ...rest } = fit.tree;
  return [
    ...estimatesTables(fit.tree),
    treeOf(rest, 'All that the fit tells', (fit.panels ?? []).length === 0),
  ].filter(Boolean);
}

export function fitFigures(fit) {
  return (fit.panels ?? []).map((panel) =>
    xyFigure({
      title: panel.y.label ? `${panel.y.label} over ${panel.x.label}` : panel.x.label,
      equal: panel.equal,
      read: () => ({
        x: labelled(panel.x.label, printed(panel.x.unit)),
        y: labelled(panel.y.label, printed(panel.y.unit)),
        xlog: panel.x.log,
        ylog: panel.y.log,
        curves: panel.series.map((s, i) => ({
          name: s.name || `curve ${i + 1}`,
          x: numbers(s.x),
          y: numbers(s.y),
          line: s.line,
          marks: s.marks,
          dashed: s.dashed,
        })),
        bands: panel.bands.map((b) => ({ name: b.name, x: numbers(b.x), low: numbers(b.low), high: numbers(b.high) })),
      }),
    }),
  );
}

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

/** Coefficients as a table: value and what else is told of each, as far as names tell it: cd, cd_interval, … */
function estimatesTable(tree) {
  const group = isTable(tree.coefficients) ? tree.coefficients : null;
  if (!group) return null;
  const rows = Object.entries(group).map(([name, v]) => [name.replaceAll('_', ' '), told(v)]);
  return table(['Coefficient', 'Value'], rows, 'Coefficients');
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
  const { coefficients, ...rest } = fit.tree;
  return [
    estimatesTable({ coefficients }),
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

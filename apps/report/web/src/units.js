// Units: results are in SI; what is shown follows the reader's choice and the size of the numbers.
import { settings } from './settings.js';

const FOOT = 0.3048; // m, exact
const PREFIXES = [
  [1e9, 'G'],
  [1e6, 'M'],
  [1e3, 'k'],
];

/** @returns {string} a unit as it is printed: m^2/Hz becomes m²/Hz */
export function printed(unit) {
  return unit
    .replace(/\^(-?\d)/g, (_, d) => [...d].map((c) => ({ '-': '⁻' })[c] ?? '⁰¹²³⁴⁵⁶⁷⁸⁹'[c]).join(''))
    .replaceAll(' ', '·');
}

/** What stands in the unit for lengths and angles, by the reader's choice: [factor, unit]. */
function chosen(unit) {
  let factor = 1;
  const text = unit.replace(/\b(m|rad)(?:\^(-?\d))?(?![\w])/g, (whole, base, power, at) => {
    const over = unit.slice(0, at).includes('/') ? -1 : 1;
    const p = (power ? Number(power) : 1) * over;
    if (base === 'm' && settings.length === 'ft') {
      factor /= FOOT ** p;
      return power ? `ft^${power}` : 'ft';
    }
    if (base === 'rad' && settings.angle === 'deg') {
      factor *= (180 / Math.PI) ** p;
      return power ? `deg^${power}` : 'deg';
    }
    return whole;
  });
  return [factor, text];
}

/**
 * How numbers of a unit are shown. Lengths alone follow the choice between m and ft: a unit with N, J, W, Pa or kg
 * stays SI and gets a prefix by the size of its numbers.
 * @param {string} unit SI
 * @param {number} [largest] absolute, of the numbers that are shown together
 * @returns {{factor: number, unit: string}} numbers times factor are in the unit
 */
export function shown(unit, largest = 0) {
  const heavy = /^(N|J|W|Pa)\b/.exec(unit);
  if (heavy) {
    const power = Number(/^\w+\^(\d)/.exec(unit)?.[1] ?? 1);
    for (const [size, prefix] of PREFIXES)
      if (largest >= size ** power) return { factor: size ** -power, unit: printed(prefix + unit) };
    return { factor: 1, unit: printed(unit) };
  }
  if (/\bkg\b/.test(unit)) return { factor: 1, unit: printed(unit) };
  const [factor, text] = chosen(unit);
  return { factor, unit: printed(text).replace(/^ft\/ft$/, 'ft/ft') };
}

/** "heave [m]" */
export function labelled(name, unit) {
  return unit ? `${name} [${unit}]` : name;
}

/** A number in words: four digits, and a true minus. */
export function format(value, digits = 4) {
  if (value === null || value === undefined || Number.isNaN(value)) return '–';
  if (value === 0) return '0';
  const size = Math.abs(value);
  const text =
    size >= 1e6 || size < 1e-4 ? value.toExponential(digits - 1) : String(Number(value.toPrecision(digits)));
  return text
    .replace(/e([+-])(\d+)/, (_, sign, power) => {
      const raised = [...power].map((c) => '⁰¹²³⁴⁵⁶⁷⁸⁹'[c]).join('');
      return `·10${sign === '-' ? '⁻' : ''}${raised}`;
    })
    .replace('-', '−');
}

/** What stands along frequency axes: [label with unit, value of an angular frequency in rad/s]. */
export const ABSCISSAE = {
  T: { label: 'period T [s]', of: (omega) => (2 * Math.PI) / omega },
  omega: { label: 'angular frequency ω [rad/s]', of: (omega) => omega },
  f: { label: 'frequency f [Hz]', of: (omega) => omega / (2 * Math.PI) },
};

/** A density per Hz, shown over ω as one per rad/s, over f and T per Hz: [factor, unit]. */
export function densityUnit(unit, abscissa, largest) {
  const power = unit ? unit.replace(/(\w+)(?:\^(\d))?/g, (_, base, p) => `${base}^${2 * (p ? Number(p) : 1)}`) : '';
  const { factor, unit: text } = shown(power, largest);
  return abscissa === 'omega'
    ? { factor: factor / (2 * Math.PI), unit: `${text || '1'}/(rad/s)` }
    : { factor, unit: `${text || '1'}/Hz` };
}

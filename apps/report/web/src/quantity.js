// Signals by what they measure, so that each figure shows one quantity.

/** "m3.heave" is the heave of m3: [whose, what]. */
export function split(name) {
  const at = name.lastIndexOf('.');
  return at < 0 ? ['', name] : [name.slice(0, at), name.slice(at + 1)];
}

export const MODES = ['surge', 'sway', 'heave', 'roll', 'pitch', 'yaw'];
const ORDER = ['elevation', ...MODES];

/** What a signal is a curve of: its last word and its unit. */
export const quantityOf = (signal) => `${split(signal.name)[1]}\n${signal.unit}`;

/** Motions first and in their usual order, then the others as they come. */
export function sortedQuantities(groups) {
  const rank = (key) => {
    const [word, unit] = key.split('\n');
    const i = ORDER.indexOf(word);
    return i < 0 || unit.startsWith('N') ? ORDER.length : i;
  };
  return [...groups.entries()].sort((a, b) => rank(a[0]) - rank(b[0]));
}

/** A heading for it: "heave", "force", "anchor tension". */
export const titleOf = (key) => {
  const words = key.split('\n')[0].replaceAll('_', ' ');
  return words.charAt(0).toUpperCase() + words.slice(1);
};

/** True for what is told of the energy ledger. */
export const isEnergy = (signal) => signal.name.startsWith('energy.');
/** True for loads that tables of loads hold: forces, moments, tensions. */
export const isLoad = (signal) => /^N( m)?$/.test(signal.unit);

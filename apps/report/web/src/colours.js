// Colours that can be told apart by those who see fewer (Okabe & Ito 2008, "Color universal design"), darkened or
// lightened so that lines keep a contrast of 3 to the background (WCAG 2.1, 1.4.11).
const LIGHT = ['#0072b2', '#c44e00', '#007f5f', '#b0568a', '#8a6d00', '#3a8fc0'];
const DARK = ['#56b4e9', '#ff9248', '#2fc79f', '#e29ac6', '#f0e442', '#a9c7ff'];
const DASHES = [[], [8, 4], [2, 3], [10, 3, 2, 3], [5, 5], [1, 4]];

export const isDark = () => {
  const theme = document.documentElement.dataset.theme;
  return (
    theme === 'dark' || (theme !== 'light' && matchMedia('(prefers-color-scheme: dark)').matches && !isPrinting())
  );
};
const isPrinting = () => matchMedia('print').matches;

/** The colour of curve number i, on screen or on a page that is always light. */
export const colour = (i) => (isDark() ? DARK : LIGHT)[i % 6];
/** Curves are told apart by their dashes too, so that they are without colours. */
export const dash = (i) => DASHES[i % 6];
/** A stroke of curve number i as the background of a mark: its colour with its dashes. */
export function inked(i, dashes = dash(i)) {
  if (!dashes.length) return colour(i);
  const stops = [];
  let end = 0;
  dashes.forEach((length, k) => {
    stops.push(`${k % 2 ? 'transparent' : colour(i)} ${end}px ${end + length}px`);
    end += length;
  });
  return `repeating-linear-gradient(90deg, ${stops.join(', ')})`;
}
/** A colour of the style sheet. */
export const styled = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

/** Viridis (van der Walt & Smith 2015) at eleven points: equal steps look equal, also in grey. */
const VIRIDIS = [
  '#440154',
  '#482475',
  '#414487',
  '#355f8d',
  '#2a788e',
  '#21918c',
  '#22a884',
  '#44bf70',
  '#7ad151',
  '#bddf26',
  '#fde725',
];
/** @param {number} share 0 … 1 @returns {string} */
export function onScale(share) {
  const x = Math.min(Math.max(share, 0), 1) * 10;
  const i = Math.min(Math.floor(x), 9);
  const mixed = [1, 3, 5].map((at) => {
    const [a, b] = [VIRIDIS[i], VIRIDIS[i + 1]].map((c) => parseInt(c.slice(at, at + 2), 16));
    return Math.round(a + (b - a) * (x - i));
  });
  return `rgb(${mixed.join(',')})`;
}

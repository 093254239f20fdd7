// Colours that can be told apart by those who see fewer (Okabe & Ito 2008, "Color universal design"), darkened or
// lightened so that lines keep a contrast of 3 to the background (WCAG 2.1, 1.4.11).
const LIGHT = ['#0072b2', '#c44e00', '#007f5f', '#b0568a', '#8a6d00', '#3a8fc0'];
const DARK = ['#56b4e9', '#ff9248', '#2fc79f', '#e29ac6', '#f0e442', '#a9c7ff'];
const DASHES = [[], [8, 4], [2, 3], [10, 3, 2, 3], [5, 5], [1, 4]];

const DARK_SYSTEM = matchMedia('(prefers-color-scheme: dark)');
export const isDark = () => {
  const { theme } = document.documentElement.dataset;
  return theme === 'dark' || (theme !== 'light' && DARK_SYSTEM.matches);
};
/** `listener` is called when the system becomes dark or light. */
export const onDarkSystem = (listener) => DARK_SYSTEM.addEventListener('change', listener);

/** The colour of curve number i. */
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
/** Blue below, white at nothing, red above, equally dark at both ends (Brewer's RdBu, seven classes). */
const SIGNED = ['#2166ac', '#67a9cf', '#d1e5f0', '#f7f7f7', '#fddbc7', '#ef8a62', '#b2182b'];

/** The colour at a share of the way along equally spaced ones. */
function between(colours, share) {
  const last = colours.length - 1,
    x = Math.min(Math.max(share, 0), 1) * last;
  const i = Math.min(Math.floor(x), last - 1);
  const mixed = [1, 3, 5].map((at) => {
    const [a, b] = [colours[i], colours[i + 1]].map((c) => parseInt(c.slice(at, at + 2), 16));
    return Math.round(a + (b - a) * (x - i));
  });
  return `rgb(${mixed.join(',')})`;
}
/** @param {number} share 0 … 1 @returns {string} */
export const onScale = (share) => between(VIRIDIS, share);
/** Of what is below nothing, 0 … 0.5, and above it, 0.5 … 1. */
export const onSigned = (share) => between(SIGNED, share);

// What the reader has chosen, and who must know of a change.
import { onDarkSystem } from './colours.js';

const listeners = new Set();

/** length: m or ft; angle: deg or rad; abscissa: T, omega or f; theme: auto, light or dark. */
export const settings = { length: 'm', angle: 'deg', abscissa: 'T', theme: 'auto' };

/** @param {Partial<typeof settings>} change */
export function choose(change) {
  Object.assign(settings, change);
  if ('theme' in change) document.documentElement.dataset.theme = settings.theme;
  for (const listener of [...listeners]) listener(settings);
}

// Drawings hold the ink that they were drawn with: for paper, which is white, they are drawn anew.
let onScreen = null;
addEventListener('beforeprint', () => {
  onScreen ??= settings.theme;
  choose({ theme: 'light' });
});
addEventListener('afterprint', () => {
  if (onScreen !== null) choose({ theme: onScreen });
  onScreen = null;
});
onDarkSystem(() => choose({}));

/** `listener` is called after every change. */
export function onChange(listener) {
  listeners.add(listener);
}

// What the reader has chosen, and who must know of a change.
const listeners = new Set();

/** length: m or ft; angle: deg or rad; abscissa: T, omega or f; theme: auto, light or dark. */
export const settings = { length: 'm', angle: 'deg', abscissa: 'T', theme: 'auto' };

/** @param {Partial<typeof settings>} change */
export function choose(change) {
  Object.assign(settings, change);
  if ('theme' in change) document.documentElement.dataset.theme = settings.theme;
  for (const listener of [...listeners]) listener(settings);
}

/** `listener` is called after every change. */
export function onChange(listener) {
  listeners.add(listener);
}

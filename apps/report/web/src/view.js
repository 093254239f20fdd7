// The animation of a run: in space, or from the side where there is no WebGL.
import { numbers } from './data.js';
import { button, download, h } from './dom.js';
import { frameAt } from './poses.js';
import { player } from './player.js';
import { onChange } from './settings.js';
import { view2d } from './view2d.js';
import { view3d } from './view3d.js';

/** @param {object} view @returns {HTMLElement} */
export function animation(view) {
  if (view.missing) return h('p', { class: 'note' }, view.missing);
  const place = h('div', { class: 'space' }),
    time = numbers(view.time);
  const said = h('p', { class: 'note' });
  let drawn = null,
    now = time[0];
  const show = (t) => {
    now = t;
    drawn?.show(t, ...frameAt(time, t));
  };
  const clock = player(time, show);
  const element = h(
    'figure',
    { class: 'animation' },
    h(
      'figcaption',
      {},
      h('span', { class: 'name' }, 'Motion in space'),
      h(
        'div',
        { class: 'tools' },
        button('⟲', 'The first view again', () => drawn.reset()),
        button('PNG', 'Save this picture', () =>
          drawn.canvas.toBlob((blob) => download('motion.png', blob, 'image/png')),
        ),
      ),
    ),
    place,
    clock.element,
    said,
    h(
      'p',
      { class: 'note' },
      'Drag, or the arrow keys, turn the view; the wheel, or + and −, come nearer; the space bar plays.',
    ),
    view.notes.length
      ? h(
          'ul',
          { class: 'note' },
          view.notes.map((note) => h('li', {}, note)),
        )
      : null,
  );
  element.addEventListener('keydown', (event) => {
    if (event.target.tagName === 'CANVAS') clock.key(event);
  });

  function begin() {
    try {
      drawn = view3d(place, view);
      place.dataset.by = 'webgl';
    } catch {
      place.replaceChildren();
      drawn = view2d(place, view);
      place.dataset.by = 'canvas';
      said.textContent = 'This browser has no WebGL, so the motion is shown from the side: x to the right, z up.';
    }
    clock.goTo(now);
  }
  const near = new IntersectionObserver(
    (entries) => {
      if (!entries.some((e) => e.isIntersecting)) return;
      near.disconnect();
      // The first picture in space can take seconds, and curves near the window are not to wait for it.
      requestAnimationFrame(() => setTimeout(() => drawn ?? begin()));
    },
    { rootMargin: '200px' },
  );
  near.observe(place);
  addEventListener('beforeprint', () => drawn ?? begin());
  onChange(() => drawn?.repaint());
  return element;
}

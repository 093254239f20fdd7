// What every figure has: a heading, tools, a legend outside with which curves are chosen, and a place to draw.
import { button, download, h } from './dom.js';

/** Curves in one figure: more cannot be told apart. */
export const MOST = 6;

let count = 0;

/**
 * @param {{title: string, names: string[], note?: string, csv: () => string, canvas: () => HTMLCanvasElement,
 *          reset?: () => void, log?: (on: boolean) => void, draw: (chosen: Set<string>) => void}} what
 * @returns {{element: HTMLElement, place: HTMLElement, chosen: Set<string>,
 *   setColours: (of: (name: string) => string) => void}} `setColours` takes a background of CSS for each name
 */
export function figure(what) {
  const chosen = new Set(what.names.slice(0, MOST));
  const place = h('div', { class: 'plot' });
  const id = `figure${++count}`;
  const file =
    what.title
      .toLowerCase()
      .replace(/[^a-z0-9]+/g, '_')
      .replace(/^_|_$/g, '') || id;
  const tools = h(
    'div',
    { class: 'tools' },
    what.log ? toggle('log', 'Logarithmic scale', what.log) : null,
    what.reset ? button('⟲', 'Show all again (double click)', what.reset, { class: 'reset' }) : null,
    button('PNG', 'Save this figure as a picture', () => savePicture(what, file)),
    button('CSV', 'Save the numbers of this figure', () => download(`${file}.csv`, what.csv(), 'text/csv')),
  );
  const legend = what.names.length > 1 || what.always ? legendOf(what, chosen) : null;
  const element = h(
    'figure',
    { id, 'aria-labelledby': `${id}c` },
    h('figcaption', { id: `${id}c` }, h('span', { class: 'name' }, what.title), tools),
    place,
    legend?.element,
    what.note ? h('p', { class: 'note' }, what.note) : null,
  );
  return { element, place, chosen, setColours: (of) => legend?.colour(of) };
}

/**
 * Figures are drawn when they come near the window, or go on paper: long reports open at once.
 * @param {HTMLElement} place @param {() => void} draw is called once
 */
export function whenNear(place, draw) {
  const once = () => {
    near.disconnect();
    removeEventListener('beforeprint', once);
    draw();
  };
  const near = new IntersectionObserver((entries) => entries.some((e) => e.isIntersecting) && once(), {
    rootMargin: '400px',
  });
  near.observe(place);
  addEventListener('beforeprint', once);
}

/** A button that stays pressed. */
export function toggle(label, title, onchange, pressed = false) {
  const b = button(
    label,
    title,
    () => {
      const on = b.getAttribute('aria-pressed') !== 'true';
      b.setAttribute('aria-pressed', on);
      onchange(on);
    },
    { 'aria-pressed': pressed },
  );
  return b;
}

function legendOf(what, chosen) {
  const said = h('span', { class: 'note', role: 'status' });
  const items = what.names.map((name) => {
    const box = h('input', { type: 'checkbox', checked: chosen.has(name), onchange: () => change(name, box) });
    const mark = h('span', { class: 'mark' });
    return { name, box, mark, element: h('label', {}, box, mark, h('span', {}, name)) };
  });
  function change(name, box) {
    if (box.checked && chosen.size >= MOST) {
      box.checked = false;
      said.textContent = `At most ${MOST} curves are drawn at once; take one away first.`;
      return;
    }
    said.textContent = '';
    if (box.checked) chosen.add(name);
    else chosen.delete(name);
    what.draw(chosen);
  }
  return {
    element: h(
      'div',
      { class: 'legend', role: 'group', 'aria-label': `Curves of ${what.title}` },
      items.map((i) => i.element),
      what.names.length > MOST ? h('span', { class: 'note' }, `${MOST} of ${what.names.length} at once`) : null,
      said,
    ),
    colour: (of) =>
      items.forEach(({ name, mark }) => {
        mark.style.background = chosen.has(name) ? of(name) : 'transparent';
      }),
  };
}

/** The drawing on the background of the page, with its title and the names of its curves. */
function savePicture(what, file) {
  const source = what.canvas();
  const ratio = devicePixelRatio || 1,
    top = 34 * ratio;
  const canvas = h('canvas', { width: source.width, height: source.height + top });
  const pen = canvas.getContext('2d');
  const style = getComputedStyle(document.body);
  pen.fillStyle = style.backgroundColor;
  pen.fillRect(0, 0, canvas.width, canvas.height);
  pen.fillStyle = style.color;
  pen.font = `600 ${14 * ratio}px system-ui, sans-serif`;
  pen.fillText(what.title, 10 * ratio, 22 * ratio);
  let x = 24 * ratio + pen.measureText(what.title).width;
  pen.font = `${12 * ratio}px system-ui, sans-serif`;
  for (const [name, stroke] of what.curves?.() ?? []) {
    pen.fillStyle = stroke;
    pen.fillRect(x, 16 * ratio, 16 * ratio, 3 * ratio);
    pen.fillStyle = style.color;
    pen.fillText(name, x + 20 * ratio, 22 * ratio);
    x += 34 * ratio + pen.measureText(name).width;
  }
  pen.drawImage(source, 0, top);
  canvas.toBlob((blob) => download(`${file}.png`, blob, 'image/png'));
}

/** A table of numbers as CSV: names with units, and a row for each. */
export function csvOf(columns) {
  const head = columns.map(({ name }) => (/[",\n]/.test(name) ? `"${name.replaceAll('"', '""')}"` : name)).join(',');
  const rows = [head];
  for (let i = 0; i < columns[0].values.length; ++i)
    rows.push(columns.map(({ values }) => (Number.isFinite(values[i]) ? String(values[i]) : '')).join(','));
  return `${rows.join('\n')}\n`;
}

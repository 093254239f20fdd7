// Elements of the page. Whatever comes from results is set as text, never as HTML.

/**
 * @param {string} tag
 * @param {Object<string, any>} attributes `on…` are listeners, `class` and others attributes; false and null are
 *   left out
 * @param {...(Node | string | number | null | (Node | string)[])} children
 * @returns {HTMLElement}
 */
export function h(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === false || value === null || value === undefined) continue;
    if (name.startsWith('on')) element.addEventListener(name.slice(2), value);
    else if (value === true) element.setAttribute(name, '');
    else element.setAttribute(name, value);
  }
  element.append(
    ...children
      .flat()
      .filter((child) => child !== null && child !== undefined)
      .map(asNode),
  );
  return element;
}

function asNode(child) {
  return child instanceof Node ? child : document.createTextNode(String(child));
}

/** A button whose name is told to those who do not see it. */
export function button(label, title, onclick, attributes = {}) {
  return h('button', { type: 'button', title, 'aria-label': title, onclick, ...attributes }, label);
}

/** A list of choices; `choices` are pairs of a value and its text. */
export function select(label, choices, value, onchange) {
  const list = h(
    'select',
    { onchange: () => onchange(list.value) },
    choices.map(([v, text]) => h('option', { value: v, selected: v === value }, text)),
  );
  return h('label', { class: 'choice' }, h('span', {}, label), list);
}

/** A table that scrolls inside itself; `head` are texts, `rows` lists of texts or nodes; numbers are at the right. */
export function table(head, rows, caption) {
  return h(
    'div',
    { class: 'scroll', tabindex: '0', role: 'region', 'aria-label': caption ?? head.join(', ') },
    h(
      'table',
      {},
      caption ? h('caption', {}, caption) : null,
      h(
        'thead',
        {},
        h(
          'tr',
          {},
          head.map((text, i) =>
            h('th', { scope: 'col', class: i && rows.some((row) => isNumber(row[i])) ? 'number' : null }, text),
          ),
        ),
      ),
      h(
        'tbody',
        {},
        rows.map((row) =>
          h(
            'tr',
            {},
            row.map((cell, i) =>
              i
                ? h('td', { class: isNumber(cell) ? 'number' : null }, cell ?? '')
                : h('th', { scope: 'row' }, cell ?? ''),
            ),
          ),
        ),
      ),
    ),
  );
}

function isNumber(cell) {
  return typeof cell === 'string' && /^([−+]?[0-9.]|–$)/.test(cell);
}

/** A part that can be folded. */
export function folded(title, open, ...children) {
  return h('details', { open }, h('summary', {}, title), ...children);
}

/** A folded part that stands open on paper, where nobody can open it. */
export function openOnPaper(part) {
  const before = part.open;
  addEventListener('beforeprint', () => (part.open = true));
  addEventListener('afterprint', () => (part.open = before));
  return part;
}

/** A file for the reader, made here. */
export function download(name, content, type) {
  const url = URL.createObjectURL(content instanceof Blob ? content : new Blob([content], { type }));
  h('a', { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
}

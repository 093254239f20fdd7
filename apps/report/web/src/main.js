// The report: a bar of choices, a list of contents, and a section for each result.
import { h, select } from './dom.js';
import { raoFigures } from './frequency.js';
import { readData } from './data.js';
import { grid, part, sectionOf } from './sections.js';
import { comparedFigures } from './series.js';
import { choose, settings } from './settings.js';
import { differenceTable } from './tables.js';

const KINDS = {
  run: 'run',
  rao: 'response amplitude operators',
  modes: 'free motions',
  field: 'free surface',
  table: 'table',
  fit: 'fit',
  sweep: 'sweep',
};

/** Runs over each other, and RAOs, where there are several. */
function comparison(data) {
  const runs = data.results.filter((r) => r.kind === 'run'),
    raos = data.results.filter((r) => r.kind === 'rao');
  if (runs.length < 2 && raos.length < 2) return null;
  const figures = runs.length > 1 ? comparedFigures(runs, 'compared') : [];
  return h(
    'section',
    { class: 'result', id: 'comparison', 'data-kind': 'comparison' },
    h('h2', {}, 'Comparison'),
    runs.length > 1
      ? part(
          'Signals over each other',
          figures.length ? grid(figures) : h('p', {}, 'The runs have no signal in common that is drawn; what else they both hold is compared below.'),
        )
      : null,
    data.differences.length
      ? part(
          'Differences',
          data.differences.map((d) => differenceTable(d)),
          h(
            'p',
            { class: 'note' },
            'Before any thinning, over the time that both cover; the second run is interpolated by straight lines ' +
              'at the samples of the first.',
          ),
        )
      : null,
    raos.length > 1 ? part('Responses over each other', grid(raoFigures(raos, 'comparedw'))) : null,
  );
}

function bar(data) {
  return h(
    'header',
    { class: 'bar' },
    h('h1', {}, data.title),
    h(
      'div',
      { class: 'choices', role: 'group', 'aria-label': 'Units and appearance' },
      select(
        'Lengths',
        [
          ['m', 'm'],
          ['ft', 'ft'],
        ],
        settings.length,
        (length) => choose({ length }),
      ),
      select(
        'Angles',
        [
          ['deg', 'deg'],
          ['rad', 'rad'],
        ],
        settings.angle,
        (angle) => choose({ angle }),
      ),
      select(
        'Abscissa of spectra',
        [
          ['T', 'period T'],
          ['omega', 'ω'],
          ['f', 'f'],
        ],
        settings.abscissa,
        (abscissa) => choose({ abscissa }),
      ),
      select(
        'Appearance',
        [
          ['auto', 'as the system'],
          ['light', 'light'],
          ['dark', 'dark'],
        ],
        settings.theme,
        (theme) => choose({ theme }),
      ),
    ),
  );
}

function contents(data, compared) {
  const entries = data.results.map((r, i) => [`#result${i}`, `${r.title || r.label} (${KINDS[r.kind]})`]);
  if (compared) entries.unshift(['#comparison', 'Comparison']);
  return entries.length > 1
    ? h(
        'nav',
        { 'aria-label': 'Contents' },
        entries.map(([to, text]) => h('a', { href: to }, text)),
      )
    : null;
}

const data = readData();
const compared = comparison(data);
document
  .getElementById('report')
  .append(
    h('a', { class: 'skip', href: '#content' }, 'To the content'),
    bar(data),
    contents(data, compared) ?? '',
    h('main', { id: 'content' }, compared, data.results.map(sectionOf)),
    h(
      'footer',
      {},
      `Made by froude report, version ${data.version}, ${data.made}. ` +
        'Results are in SI; units shown are chosen above. ' +
        'In figures: drag to come nearer, double click for all, boxes choose curves.',
    ),
  );
document.documentElement.dataset.ready = 'yes';

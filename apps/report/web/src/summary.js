// What comes first of every result: what it is of, whether it is whole, and what not to trust.
import { folded, h, openOnPaper, table } from './dom.js';
import { format } from './units.js';

/** A sentence that must be seen. */
export const alarm = (word, text) =>
  h(
    'p',
    { class: `alarm ${word === 'Stopped' || word === 'Refused' ? 'bad' : ''}`, role: 'note' },
    h('strong', {}, word),
    ' ',
    text,
  );

export function summary(result) {
  const facts = [...result.facts];
  if (result.record) {
    const { begin, end, samples, from, counted } = result.record;
    facts.push(['Record', `${format(begin)} to ${format(end)} s, ${samples} samples`]);
    facts.push(['Statistics and spectra', `${format(from)} to ${format(end)} s, ${counted} samples`]);
  }
  if (result.kind === 'field') {
    const heading = format((result.heading * 180) / Math.PI);
    facts.push(['Wave', `${format((2 * Math.PI) / result.omega)} s, going to ${heading}°`]);
    facts.push(['Bodies', result.bodies]);
    facts.push(['Estimated error of the elevation', `${format(100 * result.error, 2)} % of the highest`]);
  }
  if (result.kind === 'run' || result.kind === 'rao')
    facts.push(['Status', result.stopped ? 'stopped early' : 'complete']);
  return h(
    'div',
    {},
    result.stopped
      ? alarm('Stopped', `This run ended before its time, and what follows is a part of it: ${result.stopped}.`)
      : null,
    result.refused ? alarm('Refused', `No value may be told of this fit: ${result.refused}`) : null,
    (result.warnings ?? []).map((w) => alarm('Warning', w)),
    (result.accepted ?? []).length
      ? alarm('Accepted', `The scene takes by name what misses a rule: ${result.accepted.join('; ')}.`)
      : null,
    h(
      'dl',
      { class: 'facts' },
      facts.filter(([, value]) => value).map(([name, value]) => h('div', {}, h('dt', {}, name), h('dd', {}, value))),
    ),
    result.accuracy_told ? h('p', {}, `Of the accuracy: ${result.accuracy_told}.`) : null,
  );
}

/** Notes, settings and the scene itself, folded. */
export function origins(result) {
  const settings = result.settings ?? [];
  return [
    result.notes?.length
      ? openOnPaper(
          folded(
            `Notes (${result.notes.length})`,
            false,
            h(
              'ul',
              {},
              result.notes.map((n) => h('li', {}, n)),
            ),
          ),
        )
      : null,
    settings.length
      ? folded(
          `Settings, defaults included (${settings.length})`,
          false,
          table(
            ['Key', 'Value'],
            settings.map(([k, v]) => [k, v]),
          ),
        )
      : null,
    result.scene_text
      ? folded('The scene as it was read', false, h('pre', { tabindex: '0' }, result.scene_text))
      : null,
    result.study_text ? folded('The study', false, h('pre', { tabindex: '0' }, result.study_text)) : null,
  ].filter(Boolean);
}

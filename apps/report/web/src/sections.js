// The parts of the report, by what each result is.
import { h, folded } from './dom.js';
import { sectionFigures, sectionTable } from './cutview.js';
import { extremesTable, fieldFigures, meansTable } from './fieldview.js';
import { fitFigures, fitParts } from './fitview.js';
import { modesTable, peaksTable, raoFigures, tableFigures } from './frequency.js';
import { isLoad } from './quantity.js';
import { phaseFigures, seriesFigures, spectrumFigures, trajectoryFigures } from './series.js';
import { alarm, origins, summary } from './summary.js';
import { casesTable, sweepFigures } from './sweepview.js';
import { accuracyTable, energyTable, following, loadTable, motionTable, planTable, timeShares } from './tables.js';
import { animation } from './view.js';

/** A heading with what belongs to it; none where nothing does. */
function part(title, ...children) {
  const inside = children.flat().filter(Boolean);
  return inside.length ? h('section', { class: 'part' }, h('h3', {}, title), inside) : null;
}

const grid = (figures) => (figures.length ? h('div', { class: 'figures' }, figures) : null);

const SECTIONS = {
  run: (run, id) => [
    run.view ? part('Animation', animation(run.view)) : null,
    part('Time series', grid(seriesFigures(run, `${id}t`))),
    part('Spectra', grid(spectrumFigures(run, `${id}f`))),
    part('Statistics', motionTable(run), run.signals.some(isLoad) ? loadTable(run) : null),
    part('Phase plots', grid(phaseFigures(run))),
    part('Trajectories', grid(trajectoryFigures(run))),
    run.signals.some((s) => s.error) ? part('Accuracy', accuracyTable(run)) : null,
    run.energy.length ? part('Energy', energyTable(run)) : null,
    run.wall_time.length ? part('Time of computation', timeShares(run)) : null,
    run.plan ? part('Plan', folded('Effects, methods and what is left out', false, planTable(run.plan))) : null,
  ],
  rao: (rao, id) => [
    part('Response amplitude operators', grid(raoFigures([rao], `${id}w`))),
    part(
      'Peaks',
      following(() => peaksTable(rao)),
    ),
    rao.sections
      ? part(
          'Loads at sections of hulls',
          following(() => sectionTable(rao)),
          grid(sectionFigures(rao)),
        )
      : null,
  ],
  modes: (modes) => [part('Free motions', modesTable(modes))],
  field: (field) => [
    part('Free surface', fieldFigures(field)),
    part('Mean drift and power', meansTable(field)),
    part('Highest and lowest', extremesTable(field)),
  ],
  table: (result, id) => [part('Curves', grid(tableFigures(result, `${id}x`)))],
  fit: (fit) => [part('Values', fitParts(fit)), part('Measured and fitted', grid(fitFigures(fit)))],
  sweep: (sweep) => {
    const { all, done, failed, skipped } = sweep.cases;
    const rest = all - done - failed - skipped;
    return [
      rest > 0
        ? alarm('Partial', `${rest} of ${all} cases are still to be run; what follows is of the others.`)
        : null,
      h('p', {}, `Of ${all} cases ${done} are done, ${failed} have failed and ${skipped} are skipped.`),
      part('Curves and maps', sweepFigures(sweep)),
      part('Cases', folded('All cases', sweep.number.length <= 30, casesTable(sweep))),
      sweep.why.length
        ? part(
            'Cases that failed, were skipped or warn',
            h(
              'ul',
              {},
              sweep.why.map(([n, state, why]) => h('li', {}, `Case ${n}, ${state}: ${why}`)),
            ),
          )
        : null,
    ];
  },
};

/** @returns {HTMLElement} the whole of one result */
export function sectionOf(result, i) {
  return h(
    'section',
    { class: 'result', id: `result${i}`, 'data-kind': result.kind },
    h('h2', {}, result.title || result.label, result.title ? h('small', {}, ` ${result.label}`) : null),
    summary(result),
    SECTIONS[result.kind](result, `r${i}`),
    part('How it came about', origins(result)),
  );
}

export { grid, part };

// The clock of an animation: it plays, stops, is moved and goes at several speeds; by mouse and by keyboard.
import { button, h, select } from './dom.js';

/**
 * @param {ArrayLike<number>} time of the frames, s
 * @param {(t: number) => void} show
 */
export function player(time, show) {
  const begin = time[0],
    end = time[time.length - 1];
  let t = begin,
    speed = 1,
    playing = false,
    last = 0;
  const readout = h('output', { class: 'time' });
  const slider = h('input', {
    type: 'range',
    min: begin,
    max: end,
    step: 'any',
    value: begin,
    'aria-label': 'Time, s',
    oninput: () => goTo(Number(slider.value)),
  });
  const play = button('▶', 'Play', () => setPlaying(!playing), { class: 'play' });
  const element = h(
    'div',
    { class: 'player' },
    play,
    slider,
    readout,
    select(
      'Speed',
      [
        ['0.25', '¼×'],
        ['1', '1×'],
        ['4', '4×'],
        ['16', '16×'],
      ],
      '1',
      (v) => {
        speed = Number(v);
      },
    ),
  );

  function goTo(at) {
    t = Math.min(Math.max(at, begin), end);
    slider.value = t;
    readout.textContent = `t = ${t.toFixed(1)} s`;
    show(t);
  }
  function setPlaying(on) {
    playing = on;
    play.textContent = on ? '❚❚' : '▶';
    play.title = on ? 'Pause' : 'Play';
    play.setAttribute('aria-label', play.title);
    last = performance.now();
    if (on) requestAnimationFrame(step);
  }
  function step(now) {
    if (!playing) return;
    goTo(t >= end ? begin : t + (speed * (now - last)) / 1000);
    last = now;
    requestAnimationFrame(step);
  }
  /** Space plays, full stop and comma step by a frame. Others go on. */
  function key(event) {
    const by = { '.': 1, ',': -1 }[event.key];
    if (event.key === ' ') setPlaying(!playing);
    else if (by) goTo(t + (by * (end - begin)) / Math.max(time.length - 1, 1));
    else return;
    event.preventDefault();
  }
  return { element, goTo, key, stop: () => setPlaying(false) };
}

// Reports as their readers meet them, in Chromium.
//
//   node report_test.mjs FROUDE SOURCE PACKAGES
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { CHROMIUM, colouredPixels, openBrowser, openReport } from './browser.mjs';

const [froude, source, packages] = process.argv.slice(2);
if (!existsSync(CHROMIUM)) {
  console.log('skipped: there is no Chromium; scripts/setup report installs it');
  process.exit(77);
}

const folder = mkdtempSync(join(tmpdir(), 'froude_browser_'));
const file = (name) => join(folder, name);
const run = (...words) =>
  execFileSync(froude, words, { cwd: folder, encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'] });
const report = (name, ...words) => {
  run('report', ...words, '-o', file(name));
  return file(name);
};
process.on('exit', () => rmSync(folder, { recursive: true, force: true }));

const hostile = readFileSync(join(source, 'examples/moored.toml'), 'utf8')
  .replace(
    'title = "A module on four chains"',
    'title = "</script><script>document.title = \'taken\'</script><b id=taken>"',
  )
  .replace('data/pontoon1.nc', join(source, 'examples/data/pontoon1.nc'));
writeFileSync(file('hostile.toml'), hostile);
run('run', file('hostile.toml'), '-o', 'hostile.h5');
run('run', join(source, 'examples/moored.toml'), '-o', 'moored.h5');
run('rao', join(source, 'examples/headings.toml'), '-o', 'rao.h5');
const browser = await openBrowser(packages);

/** Opens, looks, and expects that nothing went wrong meanwhile. */
async function looking(html, look, ...more) {
  const { page, wrong } = await openReport(browser, html, ...more);
  await look(page);
  assert.deepEqual(wrong, []);
  await page.context().close();
}

const moored = () => report('moored.html', 'moored.h5', '--scene-folder', join(source, 'examples'));
const figureNamed = (page, name) =>
  page.locator('figure', { has: page.locator('figcaption .name', { hasText: new RegExp(`^${name}$`) }) }).first();
const rangeOf = async (figure) => (await figure.locator('.plot').getAttribute('data-x')).split(' ').map(Number);

/** From a quarter to three quarters of a figure. */
async function dragAcross(page, figure) {
  const over = figure.locator('.u-over');
  await over.scrollIntoViewIfNeeded();
  const box = await over.boundingBox();
  await page.mouse.move(box.x + box.width / 4, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2, { steps: 4 });
  await page.mouse.move(box.x + (3 * box.width) / 4, box.y + box.height / 2, { steps: 4 });
  await page.mouse.up();
}

test('a run has curves that zoom together and follow the units', async () => {
  await looking(moored(), async (page) => {
    const heave = figureNamed(page, 'Heave'),
      surge = figureNamed(page, 'Surge');
    await surge.scrollIntoViewIfNeeded();
    await heave.scrollIntoViewIfNeeded();
    await heave.locator('canvas').waitFor();
    assert.ok((await colouredPixels(heave.locator('canvas'))) > 300);
    assert.deepEqual(await rangeOf(heave), [0, 40]);
    await dragAcross(page, heave);
    const [low, high] = await rangeOf(heave);
    // A quarter to three quarters of 0 to 40 s; the mouse is told in whole pixels of some 400.
    assert.ok(Math.abs(low - 10) < 0.3 && Math.abs(high - 30) < 0.3, `${low} ${high}`);
    assert.deepEqual(await rangeOf(surge), [low, high]);
    await heave.locator('.u-over').dblclick();
    assert.deepEqual(await rangeOf(heave), [0, 40]);
    assert.match(await heave.locator('.plot').getAttribute('data-y'), /\[m\]/);
    await page.getByLabel('Lengths').selectOption('ft');
    assert.match(await heave.locator('.plot').getAttribute('data-y'), /\[ft\]/);
    const pitch = page.locator('.plot[data-y^="pitch"]').first();
    await pitch.scrollIntoViewIfNeeded();
    assert.match(await pitch.getAttribute('data-y'), /\[deg\]/);
    await page.getByLabel('Angles').selectOption('rad');
    assert.match(await pitch.getAttribute('data-y'), /\[rad\]/);
  });
});

test('spectra stand over period, angular frequency or frequency', async () => {
  await looking(moored(), async (page) => {
    const spectrum = figureNamed(page, 'Heave: spectral density');
    await spectrum.scrollIntoViewIfNeeded();
    await spectrum.locator('canvas').waitFor();
    const [, longest] = await rangeOf(spectrum);
    await page.getByLabel('Abscissa of spectra').selectOption('f');
    const [lowest] = await rangeOf(spectrum);
    assert.ok(Math.abs(longest * lowest - 1) < 1e-9, 'the longest period is that of the lowest frequency');
    assert.match(await spectrum.locator('.plot').getAttribute('data-y'), /m²\/Hz/);
    await page.getByLabel('Abscissa of spectra').selectOption('omega');
    assert.ok(Math.abs((await rangeOf(spectrum))[0] / (2 * Math.PI * lowest) - 1) < 1e-9);
    assert.match(await spectrum.locator('.plot').getAttribute('data-y'), /m²\/\(rad\/s\)/);
    const before = await colouredPixels(spectrum.locator('canvas'));
    await spectrum.getByRole('button', { name: 'Logarithmic scale' }).click();
    assert.notEqual(await colouredPixels(spectrum.locator('canvas')), before);
  });
});

test('the animation plays, is moved, and turns by the keyboard', async () => {
  await looking(moored(), async (page) => {
    const space = page.locator('.space[data-by=webgl]');
    await space.waitFor();
    const time = page.locator('output.time'),
      canvas = space.locator('canvas');
    const picture = () => canvas.evaluate((c) => c.toDataURL());
    assert.ok((await colouredPixels(canvas)) > 2000);
    const first = await picture();
    await page.getByRole('button', { name: 'Play' }).click();
    await page.waitForFunction(() => parseFloat(document.querySelector('output.time').textContent.slice(4)) > 0.5);
    await page.getByRole('button', { name: 'Pause' }).click();
    const told = await time.textContent();
    assert.notEqual(await picture(), first, 'the picture moves');
    await page.waitForTimeout(200);
    assert.equal(await time.textContent(), told, 'it stands still when paused');
    const before = await picture();
    await canvas.focus();
    await page.keyboard.press('ArrowLeft');
    assert.notEqual(await picture(), before, 'arrow keys turn it');
    await page.getByLabel('Time, s').fill('20');
    assert.equal(await time.textContent(), 't = 20.0 s');
  });
});

test('without WebGL the side view plays', async () => {
  const plain = await openBrowser(packages, ['--disable-gpu', '--disable-3d-apis']);
  const { page, wrong } = await openReport(plain, moored());
  await page.locator('.space[data-by=canvas]').waitFor();
  const canvas = page.locator('.space canvas');
  const first = await canvas.evaluate((c) => c.toDataURL());
  assert.ok((await colouredPixels(canvas)) > 1000);
  await page.getByLabel('Time, s').fill('13');
  assert.notEqual(await canvas.evaluate((c) => c.toDataURL()), first);
  assert.deepEqual(
    wrong.filter((line) => !/WebGL/.test(line)),
    [],
  );
  await plain.close();
});

test('the title of a scene stays text', async () => {
  await looking(report('hostile.html', 'hostile.h5'), async (page) => {
    assert.match(await page.title(), /^<\/script><script>document\.title/);
    assert.equal(await page.locator('#taken').count(), 0);
    assert.match(await page.locator('h1').textContent(), /<b id=taken>/);
  });
});

test('responses show amplitude and phase of several headings', async () => {
  await looking(report('rao.html', 'rao.h5'), async (page) => {
    const heave = figureNamed(page, 'Heave: amplitude');
    await heave.scrollIntoViewIfNeeded();
    await heave.locator('canvas').waitFor();
    assert.ok((await colouredPixels(heave.locator('canvas'))) > 300);
    const boxes = heave.locator('.legend input');
    assert.equal(await boxes.count(), 13);
    assert.equal(await heave.locator('.legend input:checked').count(), 6);
    await boxes.nth(8).click();
    assert.equal(await heave.locator('.legend input:checked').count(), 6, 'a seventh curve is refused');
    await boxes.nth(0).click();
    await boxes.nth(8).click();
    assert.equal(await heave.locator('.legend input:checked').count(), 6);
    assert.equal(await figureNamed(page, 'Heave: phase').count(), 1);
    // Roll in head seas is 1e-12 of that in beam seas.
    assert.match(await figureNamed(page, 'Roll: phase').textContent(), /rounding, whose phase is not drawn/);
    assert.match(await heave.locator('.plot').getAttribute('data-y'), /\[m\/m\]/);
  });
});

test('two runs lie over each other, and a table tells their difference', async () => {
  await looking(report('two.html', 'moored.h5', 'hostile.h5'), async (page) => {
    const both = figureNamed(page, 'module.heave');
    await both.scrollIntoViewIfNeeded();
    assert.equal(await both.locator('.legend input:checked').count(), 2);
    const row = page.locator('#comparison table tr', { hasText: 'module.heave' });
    assert.equal(
      await row
        .locator('td')
        .nth(8 - 1)
        .textContent(),
      '0',
      'the same run differs by nothing',
    );
  });
});

test('a fit and a table have their figures', async () => {
  const fit = report('fit.html', join(source, 'examples/fit/oscillation.toml'));
  await looking(fit, async (page) => {
    assert.match(
      await page.locator('table', { hasText: 'Coefficients' }).first().textContent(),
      /1\.2185.*1\.1769 to 1\.2602/,
    );
    assert.ok((await colouredPixels(page.locator('canvas.plane').first())) > 200);
  });
  run('psd', 'moored.h5', '--signal', 'module.heave', '-o', 'psd.csv');
  await looking(report('psd.html', 'psd.csv'), async (page) => {
    await page.locator('.plot canvas').first().waitFor();
    assert.ok((await colouredPixels(page.locator('.plot canvas').first())) > 300);
  });
});

test('a sweep is a map that tells its values', async () => {
  writeFileSync(
    file('study.toml'),
    `schema = 1\ntitle = "Map"\nscene = "${join(source, 'examples/headings.toml')}"\n[[axis]]\nname = "mass"\n` +
      'key = "body.float.mass"\nvalues = ["1017.9 t", "1000 t"]\n' +
      '[[axis]]\nname = "k"\nkey = "mooring.stiffness.surge"\nvalues = ["60 kN/m", "80 kN/m", "90 kN/m"]\n' +
      '[[output]]\nkind = "rao"\nof = "float.pitch"\nstatistic = "peak"\n',
  );
  run('sweep', 'study.toml', '-o', 'cases');
  await looking(report('sweep.html', 'cases'), async (page) => {
    const map = page.locator('canvas.plane').first();
    await map.waitFor();
    assert.ok((await colouredPixels(map)) > 5000);
    const box = await map.boundingBox();
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    assert.match(await page.locator('.readout').first().textContent(), /mass .*k .*:/);
    assert.equal(await page.locator('table tbody tr').count(), 6);
  });
});

/** A post that stands in waves: small, and known in all its numbers. */
writeFileSync(
  file('post.toml'),
  `schema = 1
title = "A post"
[water]
density = "1000 kg/m^3"
depth = "10 m"
[[body]]
name = "post"
mass = "1 t"
free = "heave"
[body.hydrodynamics]
excitation = true
cylinders = { at = "(6, 2, 0) m", diameter = "4 m", draught = "6 m", frequencies = "1.5 rad/s .. 1.6 rad/s, 2 values" }
[ask]
field = { omega = "1.5 rad/s", bodies = "held", x = "0 m .. 12 m, 25 values", y = "-4 m .. 8 m, 25 values" }
accuracy = 0.1
`,
);

/** The colours of the nine pixels about a place of a map, in px of its canvas. */
const pixelsAt = (canvas, x, y) =>
  canvas.evaluate(
    (c, [px, py]) => {
      const { data } = c
        .getContext('2d')
        .getImageData(Math.round(px * devicePixelRatio) - 1, Math.round(py * devicePixelRatio) - 1, 3, 3);
      return Array.from({ length: 9 }, (_, i) => [...data.slice(4 * i, 4 * i + 4)]);
    },
    [x, y],
  );
/** Ink of the light theme, #1c2733, is darker than any colour of the scale, whose darkest is #440154. */
const hasInk = (pixels) => pixels.some(([r, g, b, a]) => a > 250 && Math.max(r, g, b) < 65);

for (const [width, height] of [
  [1280, 900],
  [400, 800],
])
  test(`a free surface is a map with outlines of the bodies, in ${width} px`, async () => {
    run('field', 'post.toml', '-o', 'post.h5');
    const told = JSON.parse(run('--json', 'field', 'post.toml', '-o', 'post.h5'));
    await looking(
      report('field.html', 'post.h5'),
      async (page) => {
        const amplitude = figureNamed(page, 'Amplitude per metre of wave amplitude');
        const canvas = amplitude.locator('canvas.plane');
        await canvas.waitFor();
        assert.ok((await colouredPixels(canvas)) > 5000);
        assert.equal(await amplitude.locator('.plot').getAttribute('data-x'), 'x [m]');
        assert.equal(await amplitude.locator('.plot').getAttribute('data-y'), 'y [m]');
        assert.match(await amplitude.locator('.scalebar').textContent(), /amplitude of elevation \[m\/m\]/);
        // Axes have one scale: the middle of the post is that of the grid, half a cell further on each side.
        await canvas.scrollIntoViewIfNeeded();
        const box = await canvas.boundingBox();
        const [left, right, top, bottom] = [64, box.width - 14, 10, box.height - 44];
        const per = Math.max(12.5 / (right - left), 12.5 / (bottom - top));
        const at = (x, y) => [(left + right) / 2 + (x - 6) / per, (top + bottom) / 2 - (y - 2) / per];
        const about = (r, angle) => pixelsAt(canvas, ...at(6 + r * Math.cos(angle), 2 + r * Math.sin(angle)));
        assert.ok(
          (await about(1.2, 0.8)).every((p) => p[3] === 0),
          'a point in the post has no colour',
        );
        assert.ok(
          (await about(5, 0.8)).every((p) => p[3] === 255),
          'a point in the water has one',
        );
        for (const angle of [0.3, 1.9, 4]) {
          assert.ok(hasInk(await about(2, angle)), `the side of the post is drawn at ${angle} rad`);
          assert.ok(!hasInk(await about(2.6, angle)), `nothing else is at ${angle} rad`);
        }
        await page.mouse.move(box.x + (left + right) / 2, box.y + bottom - 3);
        const said = await amplitude.locator('.readout').textContent();
        assert.match(said, /x 6 m, y .*: amplitude of elevation [0-9.]+ m/);
        // The surface goes by: a quarter of a period later it is another one.
        const surface = figureNamed(page, 'Surface while the wave goes by');
        await surface.scrollIntoViewIfNeeded();
        const wave = surface.locator('canvas.plane');
        await wave.waitFor();
        const picture = () => wave.evaluate((c) => c.toDataURL());
        const first = await picture();
        await surface.getByLabel('Time, s').fill('1');
        assert.notEqual(await picture(), first);
        assert.match(await surface.locator('.scalebar').textContent(), /elevation at t = 1\.0 s/);
        const before = await canvas.evaluate((c) => c.toDataURL());
        await page.getByLabel('Part').selectOption('scattered');
        assert.notEqual(await canvas.evaluate((c) => c.toDataURL()), before, 'another part is another map');
        const drift = page.locator('tr', { hasText: 'mean drift force along x' }).locator('td');
        const { x_N_m2 } = told.mean_drift;
        assert.equal(await drift.textContent(), `${Number((x_N_m2 / 1000).toPrecision(4))} kN/m²`);
        await page.getByLabel('Lengths').selectOption('ft');
        assert.equal(await amplitude.locator('.plot').getAttribute('data-x'), 'x [ft]');
        const [wide, window] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
        assert.ok(wide <= window, `${wide} px in a window of ${window} px`);
      },
      { width, height },
    );
  });

test('nothing is wider than a telephone, and all controls are reached by the keyboard', async () => {
  await looking(
    moored(),
    async (page) => {
      const [wide, window] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
      assert.ok(wide <= window, `${wide} px in a window of ${window} px`);
      const reached = new Set();
      for (let i = 0; i < 14; ++i) {
        await page.keyboard.press('Tab');
        reached.add(
          await page.evaluate(() =>
            `${document.activeElement.tagName} ${document.activeElement.getAttribute('aria-label') ?? ''}`.trim(),
          ),
        );
      }
      for (const control of ['SELECT', 'BUTTON Play', 'INPUT Time, s'])
        assert.ok(reached.has(control), `${control} is reached: ${[...reached]}`);
    },
    { width: 400, height: 800 },
  );
});

test('a page of paper has every figure whole, and the notes', async () => {
  await looking(
    moored(),
    async (page) => {
      await page.emulateMedia({ media: 'print' });
      await page.evaluate(() => dispatchEvent(new Event('beforeprint')));
      const drawn = await page.evaluate(() =>
        [...document.querySelectorAll('figure')].map((figure) => {
          const canvas = figure.querySelector('canvas');
          const box = canvas?.getBoundingClientRect();
          return {
            name: figure.querySelector('.name').textContent,
            inside: Boolean(box) && box.width > 100 && box.right <= figure.getBoundingClientRect().right + 0.5,
            // Boxes of print are whole pixels: of 200 one is half a per cent.
            squeezed: box ? Math.abs(box.width / box.height / (canvas.width / canvas.height) - 1) > 0.01 : true,
          };
        }),
      );
      assert.ok(drawn.length > 10);
      assert.deepEqual(
        drawn.filter((f) => !f.inside || f.squeezed),
        [],
      );
      assert.equal(await page.locator('details', { hasText: /^Notes/ }).getAttribute('open'), '');
      assert.equal(
        await page.locator('.legend label:visible', { has: page.locator('input:not(:checked)') }).count(),
        0,
      );
    },
    { width: 700, height: 900 },
  );
});

/** Of what is drawn on a canvas the lightest grey: ink, by its three colours from 0 to 255. */
const lightestGrey = (canvas) =>
  canvas.evaluate((c) => {
    const copy = document.createElement('canvas');
    copy.width = c.width;
    copy.height = c.height;
    const pen = copy.getContext('2d');
    pen.drawImage(c, 0, 0);
    const { data } = pen.getImageData(0, 0, copy.width, copy.height);
    let most = 0;
    for (let i = 0; i < data.length; i += 4) {
      const rgb = data.slice(i, i + 3);
      if (data[i + 3] > 250 && Math.max(...rgb) - Math.min(...rgb) < 24) most = Math.max(most, data[i]);
    }
    return most;
  });

/** Luminance by the contrast rule of WCAG 2.1, 0 black, 1 white, of "rgb(…)". */
function luminance(colour) {
  const [r, g, b] = /\(([^)]*)\)/
    .exec(colour)[1]
    .split(/[, ]+/)
    .map((v) => v / 255)
    .map((v) => (v <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4));
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

for (const [dark, more, choose] of [
  ['chosen', {}, true],
  ['that of the system', { colorScheme: 'dark' }, false],
])
  test(`paper is white and its ink dark, where the dark theme is ${dark}`, async () => {
    await looking(
      moored(),
      async (page) => {
        if (choose) await page.getByRole('combobox', { name: 'Appearance' }).selectOption('dark');
        const heave = figureNamed(page, 'Heave').locator('canvas');
        await heave.scrollIntoViewIfNeeded();
        await heave.waitFor();
        const paper = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
        const dark_ = await paper();
        assert.ok(luminance(dark_) < 0.05, `the screen is dark: ${dark_}`);
        // The ink of axes, #e4ebf2, is lighter than that of the grid; on paper it is #111111, the grid #cccccc.
        assert.ok((await lightestGrey(heave)) > 220, 'the ink of a dark screen is light');
        await page.emulateMedia({ media: 'print', ...more });
        // The style sheet by itself, as where a browser prints without telling the page.
        const all = await page.evaluate(() => {
          const parts = 'body, h1, h3, figure, figcaption .name, td, thead th, .note, .alarm, dd, pre, summary, footer';
          const groundOf = (element) => {
            const ground = getComputedStyle(element).backgroundColor;
            return ground === 'rgba(0, 0, 0, 0)' && element.parentElement ? groundOf(element.parentElement) : ground;
          };
          return [...document.querySelectorAll(parts)].map((element) => [
            `${element.tagName} ${element.className}`,
            getComputedStyle(element).color,
            groundOf(element),
          ]);
        });
        assert.ok(all.length > 15);
        for (const [where, ink, ground] of all) {
          assert.ok(luminance(ground) > 0.85, `${where} on ${ground}`);
          // 4.5 is the contrast that WCAG 2.1 asks for texts (1.4.3).
          assert.ok((luminance(ground) + 0.05) / (luminance(ink) + 0.05) > 4.5, `${where}: ${ink} on ${ground}`);
        }
        // Drawings are made anew before the page is a page of paper, and again once it is a screen.
        await page.emulateMedia({ media: 'screen', ...more });
        await page.evaluate(() => dispatchEvent(new Event('beforeprint')));
        await page.emulateMedia({ media: 'print', ...more });
        await page.waitForFunction(() => document.querySelectorAll('.plot canvas').length > 10);
        assert.ok((await lightestGrey(figureNamed(page, 'Heave').locator('canvas'))) < 220, 'drawings have dark ink');
        await page.emulateMedia({ media: 'screen', ...more });
        await page.evaluate(() => dispatchEvent(new Event('afterprint')));
        assert.equal(await paper(), dark_, 'the screen is dark again');
        assert.ok((await lightestGrey(figureNamed(page, 'Heave').locator('canvas'))) > 220);
      },
      { width: 1280, height: 900 },
      more,
    );
  });

test('curves are there within a second', async () => {
  const html = moored();
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 } });
  const page = await context.newPage();
  await page.addInitScript(() => {
    new MutationObserver(() => {
      if (document.querySelector('.u-wrap canvas')) window.drawn ??= performance.now();
    }).observe(document, { subtree: true, childList: true });
  });
  await page.goto(pathToFileURL(html).href);
  await page.waitForFunction(() => window.drawn);
  const ms = await page.evaluate(() => window.drawn);
  // 1 s is promised, and 0.4 s is seen; a machine that is at work with other things may take longer.
  assert.ok(ms < 3000, `${ms} ms`);
  await context.close();
});

test('a dark page has light ink, and figures can be saved', async () => {
  await looking(moored(), async (page) => {
    const paper = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
    const light = await paper();
    await page.getByRole('combobox', { name: 'Appearance' }).selectOption('dark');
    assert.notEqual(await paper(), light);
    const heave = figureNamed(page, 'Heave');
    await heave.scrollIntoViewIfNeeded();
    await heave.locator('canvas').waitFor();
    const saved = async (name) => {
      const [file_] = await Promise.all([page.waitForEvent('download'), heave.getByRole('button', { name }).click()]);
      return file_.path();
    };
    const csv = readFileSync(await saved('Save the numbers of this figure'), 'utf8').split('\n');
    assert.match(csv[0], /^time t \[s\],module \[m\]/);
    assert.equal(csv.length, 1 + 401 + 1);
    assert.ok(statSync(await saved('Save this figure as a picture')).size > 3000);
  });
});

test('the browser closes', () => browser.close());

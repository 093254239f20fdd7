// A real browser that opens reports: Debian's Chromium, driven by playwright-core of the lock file.
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

export const CHROMIUM = '/usr/bin/chromium';

/**
 * @param {string} packages where npm has put the packages of the lock file
 * @param {string[]} more arguments of Chromium
 */
export async function openBrowser(
  packages,
  more = ['--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
) {
  const { chromium } = createRequire(join(packages, 'package.json'))('playwright-core');
  return chromium.launch({ executablePath: CHROMIUM, args: ['--no-sandbox', '--disable-dev-shm-usage', ...more] });
}

/**
 * A page with a report, which keeps what went wrong: errors of the console, exceptions, requests to anywhere.
 * @returns {Promise<{page: import('playwright-core').Page, wrong: string[]}>}
 */
export async function openReport(browser, file, size = { width: 1280, height: 900 }, more = {}) {
  const context = await browser.newContext({ viewport: size, ...more });
  const page = await context.newPage(),
    wrong = [];
  page.on('console', (message) => {
    if (message.type() === 'error') wrong.push(`console: ${message.text()}`);
  });
  page.on('pageerror', (error) => wrong.push(`exception: ${error.message}`));
  page.on('request', (request) => {
    if (!/^(file|data|blob):/.test(request.url())) wrong.push(`request: ${request.url()}`);
  });
  await page.goto(pathToFileURL(file).href);
  await page.waitForSelector('html[data-ready]', { timeout: 20000 }).catch(() => {
    throw new Error(`the page is not ready: ${wrong}`);
  });
  return { page, wrong };
}

/** How many pixels of a canvas have a colour, that is, are neither transparent nor grey. */
export function colouredPixels(canvas) {
  return canvas.evaluate((c) => {
    const copy = document.createElement('canvas');
    copy.width = c.width;
    copy.height = c.height;
    const pen = copy.getContext('2d');
    pen.drawImage(c, 0, 0);
    const { data } = pen.getImageData(0, 0, copy.width, copy.height);
    let count = 0;
    for (let i = 0; i < data.length; i += 4)
      if (
        data[i + 3] > 40 &&
        Math.max(data[i], data[i + 1], data[i + 2]) - Math.min(data[i], data[i + 1], data[i + 2]) > 40
      )
        ++count;
    return count;
  });
}

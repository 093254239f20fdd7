// node bundle.mjs PACKAGES PAGE: makes the page of reports of src/, with the packages of the lock file that npm has
// put into the folder PACKAGES. The page is one file: script and style stand in it, and the licences of what it brings.
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const [packages, page] = process.argv.slice(2);
const here = dirname(fileURLToPath(import.meta.url));
const { buildSync } = createRequire(join(packages, 'package.json'))('esbuild');

/** One source with all that it imports, as text. */
function bundled(entry) {
  const made = buildSync({
    entryPoints: [join(here, 'src', entry)],
    bundle: true,
    minify: true,
    write: false,
    format: 'esm',
    target: 'es2021',
    legalComments: 'none',
    charset: 'utf8',
    nodePaths: [join(packages, 'node_modules')],
    logLevel: 'error',
  });
  return made.outputFiles[0].text;
}

/** What the licence asks for stands in every report. */
function licence(name) {
  const folder = join(packages, 'node_modules', name);
  const { version } = JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8'));
  return `${name} ${version}\n\n${readFileSync(join(folder, 'LICENSE'), 'utf8').trim()}`.replaceAll('--', '- -');
}

const parts = {
  style: bundled('style.css'),
  script: bundled('main.js').replaceAll('</script', '<\\/script'),
  licences: ['uplot', 'three'].map(licence).join('\n\n'),
};
const frame = readFileSync(join(here, 'src', 'page.html'), 'utf8');
mkdirSync(dirname(page), { recursive: true });
writeFileSync(
  page,
  frame.replace(/\{\{(\w+)\}\}/g, (_, part) => parts[part]),
);

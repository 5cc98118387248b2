// Bundles the viewer into one page, build/viewer/playback.html, with the place where `fram view` puts a record left
// open.
import { build } from 'esbuild';
import { mkdir, readFile, rename, writeFile } from 'node:fs/promises';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const target = process.argv[2] ?? join(here, '..', 'build', 'viewer', 'playback.html');

const bundle = await build({
    entryPoints: [join(here, 'src', 'main.js')],
    bundle: true,
    minify: true,
    format: 'iife',
    target: 'es2020',
    legalComments: 'inline',
    write: false,
});
// A closing tag inside the script would end it early.
const script = bundle.outputFiles[0].text.replaceAll('</script', '<\\/script');
const style = await readFile(join(here, 'src', 'page.css'), 'utf8');
const page = (await readFile(join(here, 'src', 'page.html'), 'utf8'))
    .replace('/*STYLE*/', () => style)
    .replace('/*SCRIPT*/', () => script);
await mkdir(dirname(target), { recursive: true });
await writeFile(target + '.new', page);
await rename(target + '.new', target);
console.log(`${target}: ${(page.length / 1024).toFixed(0)} kB`);

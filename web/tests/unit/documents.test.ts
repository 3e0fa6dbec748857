// The blocks of docs/adding-a-mode.md: the mode and its test run as written, and the interface is
// that of the source.

import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { afterAll, expect, test } from 'vitest';

const SOURCE = fileURLToPath(new URL('../../src', import.meta.url));
const page = readFileSync(fileURLToPath(new URL('../../../docs/adding-a-mode.md', import.meta.url)), 'utf8');
const blocks = [...page.matchAll(/^```ts\n(.*?)^```/gms)].map(([, text]) => text);

/** Text without comments and spaces. */
const bare = (text: string) => text.replace(/\/\*\*.*?\*\//gs, '').replace(/\s+/g, ' ');

const folder = mkdtempSync(join(tmpdir(), 'documents-'));
afterAll(() => rmSync(folder, { recursive: true }));

test('the interface of a mode is that of the source', () => {
  const members = bare(blocks[0]).replace(/^ ?interface Mode \{|\} ?$/g, '');
  const source = bare(readFileSync(join(SOURCE, 'modes/mode.ts'), 'utf8'));
  for (const member of members.split(';').filter(text => text.trim())) expect(source).toContain(member.trim());
});

test('the index of the modes is that of the source and one more', () => {
  const index = bare(readFileSync(join(SOURCE, 'modes/index.ts'), 'utf8'));
  expect(index).toContain(bare(blocks[2]).replace(', suddenDeath]', ']').trim());
});

// The test of the page is one of this file.
const located = (text: string) =>
  text
    .replaceAll("'../../src/modes/sudden-death'", `'${folder}/sudden-death.ts'`)
    .replaceAll("'../../src/", `'${SOURCE}/`)
    .replaceAll("'../", `'${SOURCE}/`)
    .replaceAll("'./", `'${SOURCE}/modes/`);
writeFileSync(join(folder, 'sudden-death.ts'), located(blocks[1]));
writeFileSync(join(folder, 'sudden-death.test.ts'), located(blocks[3]).replace(/^import .* from 'vitest';/m, ''));
Object.assign(globalThis, { expect, test });
await import(/* @vite-ignore */ join(folder, 'sudden-death.test.ts'));

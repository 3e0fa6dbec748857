// The texts of the pages: every language has all, and the documents name only what there is.

import { readFileSync } from 'node:fs';
import { describe, expect, test } from 'vitest';
import { en } from '../../src/messages/en';
import { textOf } from '../../src/messages/fill';
import { formatsOf } from '../../src/messages/formats';
import { LANGUAGES, languageFor } from '../../src/messages/languages';
import { initSync, sceneList } from '../../src/wasm/teeter_wasm.js';

const path = (name: string) => new URL(`../../${name}`, import.meta.url);
const PAGES = ['index.html', 'museum.html'];

/** Texts of a tree by key; functions are called with figures that every phrase can take. */
function* textsOf(tree: object, prefix = ''): Generator<[string, string]> {
  for (const [name, value] of Object.entries(tree)) {
    const key = `${prefix}${name}`;
    if (typeof value === 'object') yield* textsOf(value, `${key}.`);
    else yield [key, typeof value === 'function' ? value(2, 3, 4) : value];
  }
}

describe.each(Object.entries(LANGUAGES))('the language %s', (language, messages) => {
  test('has every text, none empty where English has one', () => {
    const [texts, english] = [Object.fromEntries(textsOf(messages)), Object.fromEntries(textsOf(en))];
    expect(Object.keys(texts).sort()).toEqual(Object.keys(english).sort());
    for (const [key, value] of Object.entries(english)) expect(texts[key] === '', key).toBe(value === '');
  });

  test('takes the same marks as English, in pairs', () => {
    const marks = (text: string) => text.match(/\*\*|\*|`/g)?.join() ?? '';
    const english = Object.fromEntries(textsOf(en));
    for (const [key, value] of textsOf(messages)) expect(marks(value), key).toBe(marks(english[key]));
  });

  test('is known to Intl, which then writes its plurals and decimals', () => {
    expect(Intl.PluralRules.supportedLocalesOf([language])).toEqual([language]);
  });
});

test.each(PAGES)('%s names only texts that there are, and holds none itself', page => {
  const html = readFileSync(path(page), 'utf8');
  const keys = [...html.matchAll(/data-(?:text|label|tip|content|title)="([^"]*)"/g)].map(([, key]) => key);
  expect(keys.length).toBeGreaterThan(50);
  for (const key of keys) for (const messages of Object.values(LANGUAGES)) textOf(key, messages);
  const body = html.slice(html.indexOf('<body>')).replace(/<noscript[^]*?<\/noscript\s*>/g, '');
  const words = [...body.matchAll(/>([^<]*\p{L}{2}[^<]*)</gu)].map(([, text]) => text.trim());
  expect(words.filter(word => word !== 'Teeter')).toEqual([]);
  expect(body.match(/ (aria-label|title|placeholder|alt)="[^"]/g)).toBeNull();
});

test('a text that there is not is an error which names the key', () => {
  expect(() => textOf('panel.nonsense')).toThrow('panel.nonsense');
  expect(() => textOf('panel')).toThrow('panel');
});

test('every named scene but the towers has a title', () => {
  initSync({ module: readFileSync(path('src/wasm/teeter_wasm_bg.wasm')) });
  const names = (JSON.parse(sceneList()) as { name: string }[]).map(entry => entry.name);
  expect(Object.keys(en.scenes).sort()).toEqual(names.filter(name => name !== 'tower' && name !== 'official').sort());
});

test('the address comes before the choice, the choice before the browser, and English is the rest', () => {
  expect(languageFor('?lang=de', 'en', ['en-GB'])).toBe('de');
  expect(languageFor('', 'de', ['en-GB'])).toBe('de');
  expect(languageFor('', null, ['xx', 'de-AT', 'en'])).toBe('de');
  expect(languageFor('?lang=xx', null, ['DE'])).toBe('de');
  expect(languageFor('?lang=toString', '', ['constructor'])).toBe('en');
});

test('numbers have the decimal sign of the language, and groups from five digits on', () => {
  const [english, german] = [formatsOf('en'), formatsOf('de')];
  expect([english.decimal(1234.5, 2), german.decimal(1234.5, 2)]).toEqual(['1234.50', '1234,50']);
  expect([english.significant(0.0346, 2), german.significant(0.0346, 2)]).toEqual(['0.035', '0,035']);
  expect([english.count(1234), german.count(1234567)]).toEqual(['1234', '1\u202f234\u202f567']);
  expect([english.list(['a', 'b', 'c']), german.list(['a', 'b'])]).toEqual(['a, b, and c', 'a und b']);
});

test('one block is singular in every language', () => {
  for (const [language, messages] of Object.entries(LANGUAGES))
    expect(messages.readouts.blocks(1), language).not.toBe(messages.readouts.blocks(2).replace('2', '1'));
});

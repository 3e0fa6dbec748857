// Fills the texts of a page into its document, which names them by their keys: `data-text` for the
// content of an element, `data-label` and `data-tip` for its name and its tooltip, and `data-title`
// of the root for the title of the page.

import { language, text } from '.';
import type { Messages } from './en';

/** Attributes that name a text, and the attribute that takes it. */
const ATTRIBUTES = { label: 'aria-label', tip: 'title', content: 'content' } as const;
/** Tags of the marks in a text. */
const MARKS = { '**': 'b', '*': 'cite', '`': 'code' } as const;

/** Fills all texts of the document, and names its language. */
export function fillDocument(): void {
  const root = document.documentElement;
  root.lang = language;
  document.title = textOf(root.dataset.title!);
  fill(document);
  for (const template of document.querySelectorAll('template')) fill(template.content);
}

function fill(root: ParentNode): void {
  for (const node of root.querySelectorAll<HTMLElement>('[data-text]'))
    node.replaceChildren(...marked(textOf(node.dataset.text!)));
  for (const [name, attribute] of Object.entries(ATTRIBUTES))
    for (const node of root.querySelectorAll<HTMLElement>(`[data-${name}]`))
      node.setAttribute(attribute, textOf(node.dataset[name]!));
}

/** Returns the text of a key such as `panel.rows`. Throws where there is none. */
export function textOf(key: string, messages: Messages = text): string {
  let value: unknown = messages;
  for (const part of key.split('.')) value = (value as Record<string, unknown> | undefined)?.[part];
  if (typeof value !== 'string') throw new Error(`no text has the key ${key}`);
  return value;
}

/** Splits a text at its marks into elements and plain text. */
function marked(value: string): (Node | string)[] {
  return value.split(/(\*\*.+?\*\*|\*.+?\*|`.+?`)/).map(part => {
    const mark = (Object.keys(MARKS) as (keyof typeof MARKS)[]).find(m => part.startsWith(m) && part.length > m.length);
    if (!mark) return part;
    const node = document.createElement(MARKS[mark]);
    node.textContent = part.slice(mark.length, -mark.length);
    return node;
  });
}

// Access to the elements of a page.

export function element<T extends Element = HTMLElement>(id: string): T {
  return document.getElementById(id) as unknown as T;
}

/** Sets a text where it differs. */
export function setText(target: string | Element, text: string): void {
  const node = typeof target === 'string' ? element(target) : target;
  if (node.textContent !== text) node.textContent = text;
}

export function onClick(id: string, action: () => void): void {
  element(id).addEventListener('click', action);
}

export function capitalized(text: string): string {
  return text.charAt(0).toUpperCase() + text.slice(1);
}

// Address of the kept engines, beside the page (kept-engines.ts).

export function enginesAddress(): string {
  return new URL('engines/', document.baseURI).href;
}

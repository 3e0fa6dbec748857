// Short lines for the player, read out by screen readers too.

export class Notice {
  private readonly element = document.getElementById('notice')!;
  private timer = 0;

  say(text: string, seconds = 3.5): void {
    clearTimeout(this.timer);
    // The same line said again is read out again.
    if (this.element.textContent === text) this.element.textContent = '';
    this.element.textContent = text;
    this.element.classList.add('shown');
    this.timer = window.setTimeout(() => this.element.classList.remove('shown'), seconds * 1000);
  }
}

/** Tells that the page cannot run, and why. */
export function trouble(text: string): void {
  document.getElementById('trouble-text')!.textContent = text;
  document.getElementById('trouble')!.hidden = false;
}

// The page of the museum: the simulators of the 2003 dissertation, its tower and the methods in the
// plane before it.

import { readOptions } from '../app/url';
import { text } from '../messages';
import { fillDocument } from '../messages/fill';
import { showTrouble } from '../ui/notice';
import { EXHIBITS } from './catalogue';
import { ExhibitView } from './exhibit-view';
import type { MuseumInspect } from './inspect';
import type { Colours } from './plane-picture';
import { Tower } from './tower';

function start(): void {
  fillDocument();
  if (typeof WebAssembly !== 'object' || typeof Worker !== 'function') return showTrouble(text.museum.unsupported);
  const template = document.getElementById('exhibit') as HTMLTemplateElement;
  let colours = readColours();
  const views = new Map(EXHIBITS.map(exhibit => [exhibit.method, new ExhibitView(exhibit, template, () => colours)]));
  document.getElementById('exhibits')!.append(...[...views.values()].map(view => view.element));
  const tower = createTower();
  window.museum = Object.freeze<MuseumInspect>({
    tower: tower?.inspect ?? null,
    plane: method => views.get(method)!.inspect,
    planeAt: (method, x, y) => views.get(method)!.screen(x, y),
  });
  observe([...views.values()], tower);

  const dark = matchMedia('(prefers-color-scheme: dark)');
  const applyColours = () => {
    colours = readColours();
    tower?.setDark(dark.matches);
    views.forEach(view => view.invalidate());
  };
  dark.addEventListener('change', applyColours);
  applyColours();
}

/** Returns null without WebGL, which the plane does not need. */
function createTower(): Tower | null {
  try {
    return new Tower(readOptions(location.search));
  } catch {
    document.getElementById('stage')!.classList.add('without');
    return null;
  }
}

/**
 * Runs the simulators only while they are on the screen, and draws an exhibit again when its size
 * changes.
 */
function observe(views: ExhibitView[], tower: Tower | null): void {
  const targets = new Map<Element, (onScreen: boolean) => void>(
    views.map(view => [view.element, onScreen => view.setOnScreen(onScreen)]),
  );
  targets.set(document.getElementById('stage')!, onScreen => tower?.setOnScreen(onScreen));
  const observer = new IntersectionObserver(entries => {
    for (const { target, isIntersecting } of entries) targets.get(target)!(isIntersecting);
  });
  for (const element of targets.keys()) observer.observe(element);
  const sizes = new ResizeObserver(() => views.forEach(view => view.invalidate()));
  for (const view of views) sizes.observe(view.element);
}

function readColours(): Colours {
  const style = getComputedStyle(document.documentElement);
  const of = (name: string) => style.getPropertyValue(`--${name}`).trim();
  return {
    ink: of('ink'),
    soft: of('soft'),
    line: of('line'),
    accent: of('accent'),
    push: of('push'),
    wood: of('wood'),
    edge: of('wood-edge'),
  };
}

start();

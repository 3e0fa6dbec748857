// The museum: the simulators of the 2003 dissertation, the tower and the attempts in the plane before it.

import { trouble } from '../notice';
import { readOptions } from '../query';
import { EXHIBITS } from './catalogue';
import { ExhibitView } from './exhibit-view';
import type { MuseumInspect } from './inspect';
import type { Colours } from './plane-picture';
import { Tower } from './tower';

function start(): void {
  if (typeof WebAssembly !== 'object' || typeof Worker !== 'function')
    return trouble('The simulators need WebAssembly and workers. A current version of any browser has both.');
  const template = document.getElementById('exhibit') as HTMLTemplateElement;
  let colours = readColours();
  const views = new Map(EXHIBITS.map(exhibit => [exhibit.method, new ExhibitView(exhibit, template, () => colours)]));
  document.getElementById('exhibits')!.append(...[...views.values()].map(view => view.element));
  let tower: Tower | null = null;
  try {
    tower = new Tower(readOptions(location.search));
  } catch {
    // The plane needs no WebGL.
    document.getElementById('stage')!.classList.add('without');
  }
  window.museum = Object.freeze<MuseumInspect>({
    tower: tower?.inspect ?? null,
    plane: method => views.get(method)!.inspect,
    planeAt: (method, x, y) => views.get(method)!.screen(x, y),
  });

  const seen = new Map<Element, (seen: boolean) => void>(
    [...views.values()].map(view => [view.element, s => view.show(s)]),
  );
  seen.set(document.getElementById('stage')!, s => tower?.setSeen(s));
  const observer = new IntersectionObserver(entries => {
    for (const { target, isIntersecting } of entries) seen.get(target)!(isIntersecting);
  });
  for (const element of seen.keys()) observer.observe(element);
  const sizes = new ResizeObserver(() => views.forEach(view => view.invalidate()));
  for (const view of views.values()) sizes.observe(view.element);

  const dark = matchMedia('(prefers-color-scheme: dark)');
  const dress = () => {
    colours = readColours();
    tower?.setDark(dark.matches);
    views.forEach(view => view.invalidate());
  };
  dark.addEventListener('change', dress);
  dress();
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

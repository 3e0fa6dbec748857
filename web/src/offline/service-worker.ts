// The service worker: keeps the files of one version, which then opens without a network.
//
// A new version is fetched whole beside the old one, which stays in use until all its pages are
// closed or the player asks for the new one. Pages and files of two versions never mix. Kept
// engines belong to no version: each is fetched when the first record needs it.

/// <reference lib="webworker" />

export {};

const scope = self as unknown as ServiceWorkerGlobalScope;

/** Files of this version and its name; the build fills them in. */
const FILES: readonly string[] = JSON.parse('__FILES__');
const CACHE = 'teeter-__VERSION__';
/** Cache and folder of the kept engines, whose names are their content. */
const ENGINES = { cache: 'engines', folder: 'engines/' };

scope.addEventListener('install', event => {
  event.waitUntil(keep());
});

scope.addEventListener('activate', event => {
  event.waitUntil(takeOver());
});

scope.addEventListener('message', event => {
  if (event.data === 'activate') void scope.skipWaiting();
});

scope.addEventListener('fetch', event => {
  const { request } = event;
  const { origin, pathname } = new URL(request.url);
  if (request.method !== 'GET' || origin !== scope.location.origin) return;
  const folder = new URL('./', scope.location.href).pathname;
  const path = pathname === folder ? `${folder}index.html` : pathname;
  const file = path.slice(folder.length);
  if (FILES.includes(file)) event.respondWith(answer(path, request));
  else if (file.startsWith(ENGINES.folder)) event.respondWith(engineFile(request));
});

/** Fetches all files past the browser's own cache, which may hold those of another version. */
async function keep(): Promise<void> {
  const cache = await caches.open(CACHE);
  await cache.addAll(FILES.map(file => new Request(file, { cache: 'reload' })));
}

async function takeOver(): Promise<void> {
  const names = await caches.keys();
  await Promise.all(
    names.filter(name => name.startsWith('teeter-') && name !== CACHE).map(name => caches.delete(name)),
  );
  await scope.clients.claim();
}

/** The address of a page may have options, which its file does not depend on. */
async function answer(path: string, request: Request): Promise<Response> {
  const kept = await (await caches.open(CACHE)).match(path);
  return kept ?? fetch(request);
}

/** A file of a kept engine, which stays once it was fetched. */
async function engineFile(request: Request): Promise<Response> {
  const cache = await caches.open(ENGINES.cache);
  const kept = await cache.match(request);
  if (kept) return kept;
  const response = await fetch(request);
  // Some servers send a page where a file is missing.
  const isPage = response.headers.get('content-type')?.startsWith('text/html') ?? false;
  if (response.ok && !isPage) await cache.put(request, response.clone()).catch(() => undefined);
  return response;
}

// Keeps the page for use without a network, and says when there is a new version.

export interface VersionListener {
  /** A new version is ready; `load` loads the page in it. */
  ready(load: () => void): void;
}

/** Time after which the files are kept, s: the start of the game comes first. */
const DELAY = 3;

/** Registers the service worker, where the browser has one and the page was built. */
export function keepOffline(listener: VersionListener): void {
  if (!import.meta.env.PROD || !('serviceWorker' in navigator)) return;
  window.setTimeout(() => void register(listener).catch(() => undefined), DELAY * 1000);
}

async function register(listener: VersionListener): Promise<void> {
  const container = navigator.serviceWorker;
  const registration = await container.register('service-worker.js');
  // Without a controller this is the first visit, and its files are those of the page.
  const offer = (worker: ServiceWorker | null) => {
    if (worker && container.controller) listener.ready(() => change(worker));
  };
  offer(registration.waiting);
  registration.addEventListener('updatefound', () => {
    const worker = registration.installing;
    worker?.addEventListener('statechange', () => {
      if (worker.state === 'installed') offer(worker);
    });
  });
}

function change(worker: ServiceWorker): void {
  navigator.serviceWorker.addEventListener('controllerchange', () => location.reload(), { once: true });
  worker.postMessage('activate');
}

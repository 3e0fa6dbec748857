// A headless Chromium on the built page. WebGL is drawn in software there, so tests keep the
// picture small, and wait for simulated time or for conditions instead of wall time: a slow machine
// must not fail them.

import { existsSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { chromium, type Browser, type BrowserContextOptions, type Page } from 'playwright-core';
import { preview, type PreviewServer } from 'vite';

export const ROOT = fileURLToPath(new URL('../..', import.meta.url));
const EXECUTABLES = ['/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'];
const FLAGS = [
  '--no-sandbox',
  '--use-gl=angle',
  '--use-angle=swiftshader',
  '--disable-gpu-sandbox',
  '--disable-quic',
  '--no-first-run',
  '--disable-background-networking',
  '--disable-component-update',
  '--disable-sync',
  // Memory is measured when it is asked for.
  '--enable-blink-features=ForceEagerMeasureMemory',
];
/**
 * A fifth of the resolution and the lowest tier; the device chooses the form of the blocks and the
 * stiffness of the contacts.
 */
export const MEASURED = 'help=0&view=small&scale=0.2';
/** The page as most tests open it, with the same bits on every machine. */
export const SMALL = `${MEASURED}&form=rigid&stiffness=1e6`;
/** The page with springs inside the blocks, as stiff as the contacts. */
export const SPRUNG = `${MEASURED}&form=lattice&stiffness=1e6`;

/** Longest time that a condition may take on a busy machine, ms. */
const TIMEOUT = 180_000;

export class Session {
  readonly complaints: string[] = [];

  private constructor(
    readonly page: Page,
    private readonly close: () => Promise<void>,
  ) {
    page.on('console', message => {
      if (message.type() === 'error' || message.type() === 'warning') this.complaints.push(message.text());
    });
    page.on('pageerror', error => this.complaints.push(error.message));
    page.on('requestfailed', request => {
      // A navigation ends the requests of the page that it leaves.
      const isEnded = request.failure()?.errorText === 'net::ERR_ABORTED';
      if (!isEnded) this.complaints.push(`request failed: ${request.url()}`);
    });
  }

  /**
   * Opens the page. `before` runs ahead of it; `ready: false` does not wait for it, `offline: true`
   * lets it keep its files.
   */
  static async open(
    host: Host,
    query: string,
    {
      before,
      path = '',
      ready = true,
      offline = false,
      ...options
    }: BrowserContextOptions & {
      before?: (page: Page) => Promise<unknown> | void;
      path?: string;
      ready?: boolean;
      offline?: boolean;
    } = {},
  ): Promise<Session> {
    const context = await host.browser.newContext({
      viewport: { width: 900, height: 700 },
      ...options,
    });
    context.setDefaultTimeout(TIMEOUT);
    const session = new Session(await context.newPage(), () => context.close());
    // Most tests change what the page loads, which a service worker would hide from them.
    if (!offline) await session.page.addInitScript('delete Navigator.prototype.serviceWorker');
    await before?.(session.page);
    await session.page.goto(`${host.address}${path}?${query}`);
    if (ready) await session.page.waitForFunction(() => window.teeter?.ready);
    return session;
  }

  async [Symbol.asyncDispose](): Promise<void> {
    await this.close();
  }

  /** Waits until simulated time has gone on by `seconds`. */
  async simulate(seconds: number): Promise<void> {
    const until = (await this.page.evaluate(() => (window.teeter ?? window.museum.tower).time)) + seconds;
    await this.page.waitForFunction(t => (window.teeter ?? window.museum.tower).time >= t, until, { polling: 10 });
  }

  /** Performs an action that builds a world, and waits for its first frame. */
  async rebuild(action: () => Promise<unknown>): Promise<void> {
    const before = await this.page.evaluate(() => (window.teeter ?? window.museum.tower).world);
    await action();
    const built = (n: number) => (window.teeter ?? window.museum.tower).world > n;
    await this.page.waitForFunction(built, before);
    await this.page.waitForFunction(() => (window.teeter ?? window.museum.tower).ready);
  }

  /**
   * Waits until a value of the page is the same in four pictures, as that of a camera that has come
   * to rest.
   */
  async settled(read: () => unknown): Promise<void> {
    await this.page.evaluate(async text => {
      const value = () => JSON.stringify((0, eval)(`(${text})()`));
      const picture = () => new Promise(resolve => requestAnimationFrame(resolve));
      let same = 0;
      for (let last = value(); same < 4;) {
        await picture();
        const next = value();
        same = next === last ? same + 1 : 0;
        last = next;
      }
    }, read.toString());
  }

  poses(): Promise<number[]> {
    return this.page.evaluate(() => window.teeter.poses);
  }
}

export interface Host {
  browser: Browser;
  address: string;
  stop(): Promise<void>;
}

/** Serves a built page, in the folder `dist` of `root`, to a browser. */
export async function host(root = ROOT): Promise<Host> {
  const executablePath = process.env.CHROMIUM ?? EXECUTABLES.find(existsSync);
  if (!executablePath)
    throw new Error('no Chromium: install the package chromium, or name one in the variable CHROMIUM');
  if (!existsSync(`${ROOT}/dist/index.html`)) throw new Error('the page is not built: npm run build');
  const server: PreviewServer = await preview({
    root,
    configFile: false,
    base: './',
    logLevel: 'silent',
    preview: {
      host: '127.0.0.1',
      port: 0,
      // As `teeter play` sends them.
      headers: {
        'cross-origin-opener-policy': 'same-origin',
        'cross-origin-embedder-policy': 'require-corp',
        'cross-origin-resource-policy': 'same-origin',
      },
    },
  });
  const browser = await chromium.launch({ executablePath, args: FLAGS });
  const { port } = server.httpServer.address() as { port: number };
  return {
    browser,
    address: `http://127.0.0.1:${port}/`,
    async stop() {
      await browser.close();
      await server.close();
    },
  };
}

/**
 * Moves the mouse in steps, and waits for so much simulated time after each (s); without it the
 * mouse does not wait.
 */
export async function drag(
  session: Session,
  from: { x: number; y: number },
  to: { x: number; y: number },
  steps: number,
  seconds = 0,
) {
  for (let k = 1; k <= steps; k++) {
    await session.page.mouse.move(from.x + ((to.x - from.x) * k) / steps, from.y + ((to.y - from.y) * k) / steps);
    if (seconds > 0) await session.simulate(seconds);
  }
}

/** Clicks within an instant, so that a busy page takes it as a tap. */
export async function tap({ mouse }: Page, { x, y }: { x: number; y: number }): Promise<void> {
  await mouse.move(x, y);
  await Promise.all([mouse.down(), mouse.up()]);
}

/**
 * Hashes of the states of all steps until a simulated time (s), by time: as many on a slow machine
 * as on a fast one.
 */
export async function states(session: Session, until: number): Promise<Map<string, string>> {
  const found = await session.page.evaluate(end => window.teeter.hashes(end), until);
  return new Map(found.map(({ hash, time }) => [time.toFixed(4), hash]));
}

/**
 * Standard deviation of the brightness (of 255) in a part of an element's picture: left, top,
 * width, height as parts of it.
 */
export async function contrast(page: Page, selector: string, part = [0, 0, 1, 1]): Promise<number> {
  const picture = (await page.locator(selector).screenshot()).toString('base64');
  return page.evaluate(
    async ({ picture, part }) => {
      const image = await createImageBitmap(await (await fetch(`data:image/png;base64,${picture}`)).blob());
      const canvas = new OffscreenCanvas(image.width, image.height);
      const context = canvas.getContext('2d')!;
      context.drawImage(image, 0, 0);
      const [x, y, w, h] = part.map((p, i) => Math.round(p * (i % 2 ? image.height : image.width)));
      const { data: pixels } = context.getImageData(x, y, w, h);
      let [sum, squares] = [0, 0];
      for (let i = 0; i < pixels.length; i += 4) {
        const light = (pixels[i] + pixels[i + 1] + pixels[i + 2]) / 3;
        sum += light;
        squares += light * light;
      }
      const n = pixels.length / 4;
      return Math.sqrt(squares / n - (sum / n) ** 2);
    },
    { picture, part },
  );
}

/** Drops bytes on the page as a file. */
export async function drop({ page }: Session, bytes: ArrayLike<number>, name = 'game.record'): Promise<void> {
  await page.evaluate(
    ({ bytes, name }) => {
      const data = new DataTransfer();
      data.items.add(new File([Uint8Array.from(bytes)], name));
      window.dispatchEvent(new DragEvent('drop', { dataTransfer: data, cancelable: true }));
    },
    { bytes: [...Array.from(bytes)], name },
  );
}

/** Displacement of each body between two arrays of poses, m. */
export function displacements(before: number[], after: number[]): number[] {
  return Array.from({ length: before.length / 7 }, (_, i) =>
    Math.hypot(...[0, 1, 2].map(k => after[7 * i + k] - before[7 * i + k])),
  );
}

// The page: builds its parts and ties them together.

import { Vector3 } from 'three';
import { Bodies } from './bodies';
import { Client } from './client';
import { Hand, holding } from './hand';
import type { Inspect } from './inspect';
import { listen } from './keys';
import { greatest, Lattices } from './lattice';
import { Labels } from './labels';
import { Legend, XRayLegend } from './legend';
import { Notice, trouble } from './notice';
import { Orbit } from './orbit';
import { Blend, Rate } from './pacing';
import { Panel, SLOW } from './panel';
import { Pointers } from './pointers';
import { FRAME, type Built, type Constant, type Form, type Frame, type Setup } from './protocol';
import { Quality, TIERS } from './quality';
import { readOptions } from './query';
import { heldBy, Ring, ringOf } from './ring';
import { ForceScale } from './scale';
import { squash } from './squash';
import { Verdict, type State } from './verdict';
import { View } from './view';
import { channels, colourOf, forceText, isDark, isLoose, NO_COLOUR, readings, type Reading } from './xray';

/** Direction of the first view, rad: a corner, so that ends and sides are seen. */
const FIRST_AZIMUTH = -0.95;
/** Part of the wood that the X-ray stains: at rest, and while what it told is no longer so. */
const STAIN = { known: 0.92, past: 0.3 };
/** Time between readouts, s. */
const READOUT = 0.25;

function start(): void {
  if (typeof WebAssembly !== 'object')
    return trouble(
      'This browser cannot run WebAssembly, in which the physics is written. A current version of any browser can.',
    );
  if (typeof Worker !== 'function')
    return trouble('This browser allows no workers, in which the physics runs. A current version of any browser does.');
  const canvas = document.getElementById('picture') as HTMLCanvasElement;
  const options = readOptions(location.search);
  const calm = matchMedia('(prefers-reduced-motion: reduce)').matches;
  const touch = matchMedia('(hover: none)').matches;
  const orbit = new Orbit(calm);
  let view: View;
  try {
    view = new View(canvas, orbit, options.scale);
  } catch {
    return trouble(
      'This browser gives the page no WebGL 2, with which the tower is drawn. It may be switched off in the settings, or the graphics driver may be too old.',
    );
  }
  const quality = new Quality(options.tier ?? (touch ? 1 : TIERS.length - 1), options.tier !== null);
  const notice = new Notice();
  const ring = new Ring();
  const blend = new Blend(FRAME);
  const pictures = new Rate();

  let bodies: Bodies | null = null;
  let verdict: Verdict | null = null;
  let state: State = 'standing';
  let last: Frame | null = null;
  let paused = false;
  let slow = false;
  let slowSince = 0;
  let stiffness: Constant<number> = { value: 0, chosen: false };
  let form: Constant<Form> = { value: 'rigid', chosen: false };
  let springs: number | null = null;
  const lattices = new Lattices();
  const forces = new ForceScale();
  /** Whether the springs are to be seen. */
  let watching = false;
  /** Whether the X-ray is to be seen. */
  let xraying = false;
  /** What it says of each block; null while the tower moves. */
  let xray: Reading[] | null = null;
  const labels = new Labels();
  /** Whether forces have changed since they were drawn. */
  let tensed = false;

  const client = new Client(new Worker(new URL('./worker.ts', import.meta.url), { type: 'module' }), {
    scenes(list) {
      panel.setScenes(list, options.scene);
      build(panel.setup());
    },
    built,
    frame: arrive,
    xray: ({ forces }) => showXRay(forces && bodies ? readings(forces, bodies) : null),
    refused: message => notice.say(`This scene cannot be built: ${message}`, 8),
    failed: message => trouble(`The physics stopped: ${message}. Loading the page again starts anew.`),
  });
  const hand = new Hand(client, orbit, new Bodies(new Float32Array(0), new Float32Array(0)));
  hand.cap = options.cap;

  const panel = new Panel(options, {
    build,
    reset: () => build(panel.setup()),
    pause: setPaused,
    mode(mode) {
      hand.mode = mode;
      panel.setMode(mode);
    },
    cap: force => (hand.cap = force),
    place: () => hand.place(),
    turn: quarters => hand.turn((quarters * Math.PI) / 2),
    tip: () => hand.tip(),
    letGo: () => hand.letGo(),
    form: (next, stiffness) => client.form(next, stiffness),
    springs: on => watch(on, false),
  });
  const legend = new Legend({ toggle: () => watch(!watching, false), useSprings: () => panel.chooseForm('lattice') });
  const xrayLegend = new XRayLegend(() => watch(false, !xraying));
  const frameTower = () => orbit.frame(bodies?.top() ?? 0.33);
  const pointers = new Pointers(canvas, hand, orbit, () => bodies, frameTower);
  listen(hand, orbit, {
    pause: () => setPaused(!paused),
    frame: frameTower,
    mode(mode) {
      hand.mode = mode;
      panel.setMode(mode);
    },
    place: () => hand.place(),
    help: () => panel.openHelp(),
    springs: () => watch(!watching, false),
    xray: () => watch(false, !xraying),
    busy: () => panel.busy(),
  });

  function build(setup: Setup): void {
    hand.letGo();
    client.build(setup);
  }

  function built(world: Built): void {
    const first = bodies === null;
    bodies = new Bodies(world.sizes, world.poses, world.place);
    verdict = new Verdict(world.poses);
    stiffness = world.stiffness;
    panel.setStiffness(stiffness);
    form = world.form;
    springs = world.springs;
    panel.setForm(form, springs);
    lattices.arrive(null);
    forces.restart();
    state = 'standing';
    last = null;
    slow = false;
    slowSince = 0;
    hand.begin(bodies);
    view.begin(bodies);
    forgetXRay();
    orbit.frame(bodies.top(), first ? FIRST_AZIMUTH : undefined);
    if (paused) setPaused(false);
  }

  function arrive(frame: Frame): void {
    if (!bodies || !verdict) return;
    bodies.arrive(frame.poses, frame.lattices);
    lattices.arrive(frame.lattices);
    takeForm(frame);
    blend.arrive(performance.now() / 1000);
    for (const body of frame.quarantined)
      if (!last?.quarantined.includes(body)) notice.say(`Block ${body} ran away and was frozen where it was.`, 8);
    last = frame;
    hand.arrive(frame);
    const held = hand.hold?.body ?? hand.poking;
    const before = state;
    state = verdict.judge(frame.poses, frame.time, frame.maxSpeed, held, squash(bodies, verdict.heights));
    if (state === 'fallen' && before !== 'fallen') notice.say('The tower fell.', 6);
    watchSpeed(frame);
  }

  /** Blocks change only where the player has them changed, and on the way there their springs go through what is between. */
  function takeForm(frame: Frame): void {
    springs = frame.springs;
    if (frame.form === form.value) return;
    form = { value: frame.form, chosen: false };
    panel.setForm(form, springs);
  }

  /** Springs are seen in glass and the X-ray on wood: there is one of them at a time. */
  function watch(springs: boolean, through: boolean): void {
    watching = springs;
    xraying = through;
    forgetXRay();
    client.watch(watching, xraying);
    panel.setWatching(watching);
    showLegend();
    view.invalidate();
  }

  function showLegend(): void {
    legend.show(watching, form.value === 'lattice' ? forces.end : null);
    const asked = hand.hold ? null : (pointers.hovered ?? hand.selected);
    xrayLegend.show({ on: xraying, readings: xray, paused, asked, cramped: labels.cramped });
  }

  function forgetXRay(): void {
    xray = null;
    labels.set(null);
    view.stain(null);
  }

  /** Takes in what the X-ray says; while the tower moves its figures are gone and its colours fade. */
  function showXRay(next: Reading[] | null): void {
    if (!xraying) return;
    const known = next ?? xray;
    const colours = known?.map(({ pull }) => (pull === null ? channels(NO_COLOUR) : colourOf(pull))) ?? null;
    view.stain(colours, next ? STAIN.known : STAIN.past);
    const written = next?.map(reading =>
      reading.pull === null
        ? null
        : { text: forceText(reading.pull), dark: isDark(reading.pull), marked: isLoose(reading) },
    );
    labels.set(written ?? null);
    xray = next;
    showLegend();
  }

  /** Says so when time has been slow for a second, and when it no longer is. */
  function watchSpeed(frame: Frame): void {
    const isSlow = frame.factor < SLOW;
    if (!isSlow) slowSince = 0;
    else if (slowSince === 0) slowSince = performance.now();
    const lasting = isSlow && performance.now() - slowSince > 1500;
    if (lasting && !slow) notice.say(`Slow motion, ${frame.factor.toFixed(1)}×: this device cannot keep up.`);
    slow = isSlow && (slow || lasting);
  }

  function setPaused(next: boolean): void {
    paused = next;
    hand.frozen = paused;
    client.pause(paused || document.hidden);
    panel.setPaused(paused);
    if (paused && hand.hold) notice.say('Time stands still. Look around; the block stays in your hand.');
  }

  document.addEventListener('visibilitychange', () => client.pause(paused || document.hidden));
  const dark = matchMedia('(prefers-color-scheme: dark)');
  const applyDark = () => view.setDark(dark.matches);
  dark.addEventListener('change', applyDark);
  applyDark();

  let drawnAt = 0;
  let drewLast = false;
  let longestPicture = 0;
  let readAt = 0;
  let resized = true;
  new ResizeObserver(() => (resized = true)).observe(canvas);

  function fit(): void {
    resized = false;
    const { clientWidth: width, clientHeight: height } = canvas;
    orbit.resize(width, height);
    hand.resize(width, height);
    view.resize(width, height, quality.tier);
    if (bodies && drawnAt === 0) orbit.frame(bodies.top(), FIRST_AZIMUTH);
  }

  let tickedAt = performance.now() / 1000;
  function tick(): void {
    requestAnimationFrame(tick);
    const now = performance.now() / 1000;
    const since = now - tickedAt;
    tickedAt = now;
    pictures.add(now);
    // Only the time between two drawn pictures tells what drawing costs.
    if (drewLast && quality.judge(since)) resized = true;
    drewLast = false;
    if (resized) fit();
    if (!bodies) return;
    if (hand.hold && !hand.frozen) orbit.halt();
    const moved = orbit.update(Math.min(since, 0.1));
    const change = bodies.blend(blend.at(now));
    if (lattices.blend(blend.at(now)) && watching) tensed = true;
    const inside = watching ? lattices.shown : null;
    if (inside) forces.follow(greatest(inside), since);
    view.showSprings(inside, forces.end);
    const holders = hand.holders();
    const marked = view.marks.show(bodies, {
      hovered: pointers.active ? null : pointers.hovered,
      held: hand.hold?.body ?? hand.poking,
      selected: hand.selected,
      holders: holders?.bodies ?? [],
      slots: hand.slots,
      chosen: hand.hold?.slot ?? null,
      slotSize: hand.hold ? bodies.size(hand.hold.body) : null,
    });
    ring.show(bodies && ringOf(hand, last?.hand ?? null, bodies, orbit, canvas));
    if (now - readAt > READOUT) {
      readAt = now;
      showReadouts();
      showLegend();
      panel.setPlaceable(hand.canPlace());
    }
    panel.setCarrying(hand.hold?.grip === 'carry' && !hand.hold.placing);
    if (options.render === 'once' && now - drawnAt < 1) return;
    const followed = view.follow(bodies, change);
    labels.follow(bodies, orbit, { width: canvas.clientWidth, height: canvas.clientHeight }, followed || moved, now);
    if (!followed && !moved && !marked && !tensed && drawnAt > 0) return;
    tensed = false;
    const before = performance.now();
    view.draw();
    longestPicture = Math.max(longestPicture, performance.now() - before);
    drawnAt = now;
    drewLast = true;
  }

  function showReadouts(): void {
    panel.show({
      state: paused ? 'paused' : state,
      fallen: verdict?.count ?? 0,
      blocks: bodies?.count ?? 0,
      awake: last?.awake ?? 0,
      time: last?.time ?? 0,
      fps: pictures.perSecond(),
      factor: last?.factor ?? 1,
      capacity: last?.capacity ?? 1,
      overlap: last?.penetration ?? 0,
      quality: quality.tier.name,
    });
  }

  const inspect: Inspect = {
    get ready() {
      return bodies !== null && last !== null && drawnAt > 0;
    },
    get time() {
      return last?.time ?? 0;
    },
    get factor() {
      return last?.factor ?? 0;
    },
    get capacity() {
      return last?.capacity ?? 0;
    },
    get fps() {
      return pictures.perSecond();
    },
    get awake() {
      return last?.awake ?? 0;
    },
    get state() {
      return state;
    },
    get paused() {
      return paused;
    },
    get count() {
      return bodies?.count ?? 0;
    },
    get stiffness() {
      return stiffness;
    },
    get form() {
      return form;
    },
    get springs() {
      return springs;
    },
    get view() {
      return { springs: watching, shown: view.springsShown, scale: forces.end };
    },
    get xray() {
      return {
        on: xraying,
        pulls: xray?.map(r => r.pull) ?? null,
        loads: xray?.map(r => r.load) ?? null,
        shown: labels.shown,
      };
    },
    get quality() {
      return quality.tier.name;
    },
    get poses() {
      return Array.from(bodies?.newest ?? []);
    },
    get sizes() {
      return Array.from(bodies?.sizes ?? []);
    },
    get camera() {
      return { azimuth: orbit.azimuth, elevation: orbit.elevation, position: orbit.camera.position.toArray() };
    },
    get hand() {
      const hold = hand.hold;
      if (!hold) return null;
      const { body, grip, force, capped, placing } = hold;
      return {
        body,
        grip,
        force,
        capped,
        placing,
        slot: hold.slot?.position.toArray() ?? null,
        holders: hand.holders()?.bodies ?? [],
      };
    },
    get slots() {
      return hand.slots.map(s => s.position.toArray());
    },
    get quarantined() {
      return last?.quarantined ?? [];
    },
    get longest() {
      return { physics: client.longestMessage, picture: longestPicture };
    },
    hash: () => client.ask({ what: 'hash' }),
    contacts: body => client.ask({ what: 'contacts', body }),
    screenOf(body, local = [0, 0, 0]) {
      return inspect.project(bodies!.surface(body, new Vector3(...local), bodies!.newest).toArray());
    },
    project: point => orbit.project(new Vector3(...point), canvas.clientWidth, canvas.clientHeight),
    blockAt: (x, y) => pointers.pickAt(x, y)?.body ?? null,
  };
  window.teeter = Object.freeze(inspect);
  panel.setMode(hand.mode);
  requestAnimationFrame(tick);

  // A tap asks what holds the block that was tapped.
  canvas.addEventListener('pointerup', () => {
    const body = hand.poking;
    if (body === null) return;
    void client.ask({ what: 'contacts', body }).then(contacts => {
      const carried = holding(contacts.filter(c => c.normal[2] < -0.5));
      notice.say(carried.bodies.length === 0 ? 'Loose: nothing presses on it.' : `${capital(heldBy(carried))}.`);
    });
  });
}

function capital(text: string): string {
  return text.charAt(0).toUpperCase() + text.slice(1);
}

start();

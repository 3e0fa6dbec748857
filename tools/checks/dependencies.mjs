// Third parties: which crates and packages the programs contain, and the notices that their
// licences ask for. Which licences, sources and versions are accepted is in deny.toml.
import { execFileSync } from 'node:child_process';
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';

/** Targets whose programs the notices cover, with the packages and features built for them. */
const SHELL = {
  roots: ['teeter-cli', 'teeter-python'],
  target: 'x86_64-unknown-linux-gnu',
  features: 'teeter-cli/page',
};
const PAGE = { roots: ['teeter-wasm', 'teeter-museum'], target: 'wasm32-unknown-unknown', features: '' };

/** Runs cargo metadata. */
function metadata({ target, features }) {
  const args = ['metadata', '--format-version', '1', '--locked', '--filter-platform', target];
  if (features) args.push('--features', features);
  return JSON.parse(execFileSync('cargo', args, { encoding: 'utf8', maxBuffer: 2 ** 28 }));
}

/**
 * Returns the packages that are linked into programs: the roots and what they depend on, without
 * tests, build scripts and macros.
 */
export function linked({ packages, resolve }, roots) {
  const byId = new Map(packages.map(found => [found.id, found]));
  const nodes = new Map(resolve.nodes.map(node => [node.id, node]));
  const isMacro = found => found.targets.some(target => target.kind.includes('proc-macro'));
  const queue = packages.filter(found => found.source === null && roots.includes(found.name)).map(found => found.id);
  const seen = new Set(queue);
  while (queue.length > 0) {
    for (const { pkg, dep_kinds } of nodes.get(queue.pop()).deps) {
      const isNormal = dep_kinds.some(({ kind }) => kind === null);
      if (!isNormal || seen.has(pkg) || isMacro(byId.get(pkg))) continue;
      seen.add(pkg);
      queue.push(pkg);
    }
  }
  return packages.filter(found => seen.has(found.id) && found.source !== null);
}

/**
 * Returns the texts of licences and notices in a folder, MIT alone where a choice includes it, and
 * those of a library in another language that the package contains.
 */
function texts(folder, licence) {
  const upstream = join(folder, 'upstream');
  return [...textsIn(folder, licence), ...(existsSync(upstream) ? textsIn(upstream, licence) : [])];
}

function textsIn(folder, licence) {
  const names = readdirSync(folder)
    .filter(name => /^(licen[cs]e|copying|notice|unlicense|copyright)/i.test(name))
    .filter(name => !/\.(rs|html|spdx)$/i.test(name))
    .sort();
  const notices = names.filter(name => /^notice/i.test(name));
  const mit = names.filter(name => /mit/i.test(name));
  const chosen = /\bOR\b|\//.test(licence) && /\bMIT\b/.test(licence) && mit.length > 0 ? [...mit, ...notices] : names;
  const read = name => {
    const path = join(folder, name);
    try {
      return readFileSync(path, 'utf8').replaceAll('\r', '').trim();
    } catch {
      // A folder of licences.
      return readdirSync(path)
        .sort()
        .map(inner => readFileSync(join(path, inner), 'utf8').trim())
        .join('\n\n');
    }
  };
  return chosen.map(read).filter(text => text !== '');
}

/** Returns notices about parts: `{ name, version, licence, folder, home }`, equal texts once. */
export function notices(title, parts) {
  const groups = new Map();
  for (const part of parts) {
    const key = texts(part.folder, part.licence).join('\n\n');
    groups.set(key, [...(groups.get(key) ?? []), part]);
  }
  const line = ({ name, version, licence, home }) => `* ${name} ${version} (${licence})${home ? `, ${home}` : ''}`;
  const sections = [...groups].map(([text, group]) => {
    const whole = text || 'The package names its licence and has no text of it.';
    return `${group.map(line).join('\n')}\n\n${whole}\n`;
  });
  const rule = `\n${'-'.repeat(80)}\n\n`;
  return `${title}\n${rule}${sections.join(rule)}`;
}

function crates(programs) {
  return linked(metadata(programs), programs.roots).map(found => ({
    name: found.name,
    version: found.version,
    licence: found.license ?? 'see the text',
    folder: dirname(found.manifest_path),
    home: found.repository,
  }));
}

function packages(folder) {
  const { dependencies } = JSON.parse(readFileSync('web/package.json', 'utf8'));
  return Object.keys(dependencies).map(name => {
    const path = join(folder, name);
    const { version, license, homepage } = JSON.parse(readFileSync(join(path, 'package.json'), 'utf8'));
    return { name, version, licence: license, folder: path, home: homepage };
  });
}

const OWN =
  'Teeter is licensed as MIT OR Apache-2.0. It contains the standard library of Rust, which has the same licences,\nand the parts below under their own.';

/** Returns the notices as files: path and text. */
export function files() {
  if (!existsSync('web/node_modules')) throw new Error('the packages of the page are missing: tools/setup packages');
  const page = [...packages('web/node_modules'), ...crates(PAGE)];
  const shell = crates(SHELL);
  const has = ({ name, version }) => shell.some(other => other.name === name && other.version === version);
  const both = [...shell, ...page.filter(part => !has(part))];
  return [
    ['crates/cli/licences.txt', notices(OWN, both)],
    ['web/public/licences.txt', notices(OWN, page)],
  ];
}

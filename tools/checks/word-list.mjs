// Words that this project does not use, and the field's word for each.
//
// `prose` is tried on comments, texts and documents. `name` is tried on the parts of an identifier:
// `furthestBut` and `FURTHEST_BUT` are both [furthest, but]. `langs` limits a rule to some
// languages.

const has =
  (...words) =>
  parts =>
    parts.some(part => words.includes(part));
const first =
  (...words) =>
  parts =>
    parts.length > 1 && words.includes(parts[0]);
const run =
  (...words) =>
  parts =>
    parts.some((_, i) => words.every((word, k) => parts[i + k] === word));
const either =
  (...tests) =>
  (...args) =>
    tests.some(test => test(...args));
const but =
  (test, ...excluded) =>
  (...args) =>
    test(...args) && !excluded.some(not => not(...args));

const SUPERLATIVES = ['least', 'most', 'strongest', 'longest', 'furthest'];

/** True for a name that is a sentence, as those of tests are. */
const sentence = parts => parts.length > 4;

/** `place` as a verb: `place(`, `placeBlock`, `canPlace`. */
function placeVerb(parts, context) {
  const at = parts.indexOf('place');
  if (at < 0) return false;
  if (['can', 'could', 'may', 'must', 'to', 'set', 'on', 'try', 'i'].includes(parts[at - 1])) return true;
  if (parts.length === 1) return context.after === '(' || context.lang === 'html' || context.lang === 'css';
  return at === 0 && parts[1] !== 'of';
}

/** `place` as a noun: after a word that a noun follows, or as a plural that is no verb. */
const PLACE = new RegExp(
  [
    '\\b(the|a|an|its|their|his|her|our|each|every|one|first|same|other|another|this|that|these|those|of|no|whose|last|own|two',
    'three|four|several|many|new|old|free|empty|some|any|all|right|good|narrow|straight|wrong|what|which|whatever|both|only|real',
    "exact|next|home|between|from|at|block's|player's|for|with|by) places?\\b(?! (it|them|a|an|the|blocks?)\\b)",
  ].join('|') +
    '|\\bin places?(?= of\\b)|(?<!decimal )(?<!(it|which|that|who|hand|player) )\\bplaces\\b(?! (it|them|a|an|the|blocks?)\\b)',
  'i',
);

const types =
  (...names) =>
  (parts, { ident }) =>
    names.includes(ident);

export const RULES = [
  {
    word: 'way',
    use: 'displacement, travel, path; or say how',
    name: but(has('way', 'ways'), run('one', 'way'), run('two', 'way'), run('half', 'way')),
    prose: /(?<![-\w])ways?(?![-\w])/i,
  },
  {
    word: 'reckon',
    use: 'compute',
    name: has('reckon', 'reckons', 'reckoned', 'reckoning'),
    prose: /\breckon(s|ed|ing)?\b/i,
  },
  { word: 'anew', use: 'again, re-', name: has('anew'), prose: /\banew\b/i },
  {
    word: 'tell',
    use: 'report, event, message, send',
    name: has('tell', 'tells', 'told'),
    prose: /\b(tells?|told|telling)\b/i,
  },
  { word: 'wish', use: 'command, target', name: has('wish', 'wishes', 'wished', 'wisher'), prose: /\bwish(es|ed)?\b/i },
  { word: 'usual', use: 'default', name: has('usual'), prose: /\busual\b/i },
  {
    word: 'superlative',
    use: 'min, max',
    name: but(first(...SUPERLATIVES), sentence, run('least', 'squares'), run('most', 'significant')),
  },
  {
    word: 'place',
    use: 'index, offset, position, inset, slot',
    name: but(has('place', 'places'), placeVerb, run('decimal', 'places'), sentence),
    prose: PLACE,
    langs: ['rust', 'ts', 'html', 'markdown', 'shell', 'toml', 'package'],
  },
  {
    word: 'ease',
    use: 'inverse mass',
    name: has('ease'),
    prose: /\bease\b/i,
    langs: ['rust', 'ts', 'html', 'markdown'],
  },
  {
    word: 'look',
    use: 'test, query, read',
    name: but(has('look', 'looks', 'looked', 'looking'), run('look', 'at'), run('look', 'up')),
    prose: /\b(look|looks|looked|looking)\b(?! (like|alike|up|around|down|from|the same)\b)/i,
  },
  { word: 'rouse', use: 'wake', name: has('rouse', 'rouses', 'roused'), prose: /\brous(e|es|ed|ing)\b/i },
  {
    word: 'forget',
    use: 'reset, clear',
    name: has('forget', 'forgets', 'forgot'),
    prose: /\b(forgets?|forgot|forgotten|forgetting)\b/i,
  },
  { word: 'sane', use: 'valid', name: has('sane'), prose: /\bsane\b/i },
  { word: 'put away', use: 'spill', prose: /\bput(s|ting)? away\b/i },
  { word: 'put in its place', use: 'inline', prose: /\bput(s|ting)? in (its|their) (own )?places?\b/i },
  {
    word: 'what_',
    use: 'a noun',
    name: but(first('what', 'who', 'whose', 'whatever', 'whoever'), ({ length }) => length < 2),
  },
  {
    word: 'face',
    use: 'binding, interface',
    prose:
      /\bthin face\b|\b(a|the|its) face (for|of) (the )?(page|python|javascript|dissertation|library)\b|\bpage's face\b/i,
  },
  { word: 'ask nobody', use: 'make no requests', prose: /\basks? (nobody|no one)\b/i },
  {
    word: 'kept',
    use: 'a noun with its unit',
    name: (parts, { ident }) => /^[A-Z][A-Z0-9_]*$/.test(ident) && has('kept', 'held', 'few')(parts),
  },
  {
    word: 'want',
    use: 'command, target, expected',
    name: either(parts => parts.length === 1 && parts[0] === 'want', first('want', 'wants')),
    langs: ['ts'],
  },
  { word: 'starting force', use: 'breakaway force', name: run('starting', 'force'), prose: /\bstarting forces?\b/i },
  { word: 'leash', use: 'target limiter', name: has('leash', 'leashed'), prose: /\bleash(ed)?\b/i },
  { word: 'squash', use: 'settlement, stiffness ramp', name: has('squash', 'squashed'), prose: /\bsquash(es|ed)?\b/i },
  { word: 'stillness', use: 'rest, rest detector', name: has('stillness'), prose: /\bstillness\b/i },
  { word: 'verdict', use: 'fall detector, result', name: has('verdict', 'verdicts'), prose: /\bverdicts?\b/i },
  { word: 'glide', use: 'stiffness ramp', name: has('glide', 'glides'), prose: /\bglid(e|es|ed|ing)\b/i },
  { word: 'yank', use: 'collapse, sudden pull', name: has('yank', 'yanks', 'yanked'), prose: /\byank(s|ed|ing)?\b/i },
  { word: 'Ways', use: 'TangentialRefine', name: types('Ways') },
  { word: 'Acts', use: 'ClusterInput', name: types('Acts', 'Act') },
  { word: 'Moved', use: 'SyncSet', name: types('Moved'), langs: ['rust'] },
  { word: 'Taken', use: 'BodyDelta', name: types('Taken'), langs: ['rust'] },
  { word: 'Loading', use: 'KernelBody', name: types('Loading'), langs: ['rust'] },
  { word: 'Turning', use: 'RigidMotion', name: types('Turning'), langs: ['rust'] },
  { word: 'Straining', use: 'AffineMotion', name: types('Straining'), langs: ['rust'] },
  { word: 'Moments', use: 'AffineWrench', name: types('Moments'), langs: ['rust'] },
  { word: 'Meeting', use: 'PairStatus', name: types('Meeting'), langs: ['rust'] },
  { word: 'Places', use: 'ReferencePositions', name: types('Places'), langs: ['rust'] },
  { word: 'NoAnswer', use: 'LimitError', name: types('NoAnswer'), langs: ['rust'] },
  { word: 'Fault', use: 'Error', name: types('Fault', 'fault', 'faults'), langs: ['rust', 'ts'] },
];

/**
 * Words that a doc comment does not open with: it opens with a noun phrase or a verb in the third
 * person.
 */
export const OPENING = /^(What|Whether|How|Where|Those|The same|One|Who|When)\b/;

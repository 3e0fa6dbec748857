//! Constants of the method, each with its unit and what breaks if it is changed.

use glam::DVec3;

/// Contact area for which the stiffness of a scene holds, m²: two crossed nominal blocks.
pub const REFERENCE_AREA: f64 = 0.0268 * 0.0268;
/// Contact area over [`REFERENCE_AREA`] above which stiffness is proportional to area: a sliver has
/// some stiffness.
pub const MIN_AREA: f64 = 0.1;
/// Largest face over [`REFERENCE_AREA`] that bounds the substep; a nominal block lying flat on
/// another has 3.02. Contacts of larger faces are softened where their bodies are light.
pub const STEP_AREA: f64 = 3.2;
/// Area of two edges that touch over the square of the middle edge of the smaller block.
pub const EDGE_AREA: f64 = 0.25;

/// Part of the stability limit of the explicit step, 4, that one contact between two bodies may
/// use. Each body has contacts on all sides: towers lean wrongly from 1.2 on.
pub const STEP_LIMIT: f64 = 1.0;
/// Part of the stability limit that one contact with the floor may use, which has contacts on one
/// side only.
pub const FLOOR_STEP_LIMIT: f64 = 2.0;
/// Inverse effective mass of two nominal blocks that cross at their ends, times their mass:
/// 2 (1 + d² m / I) with d = 27.1 mm. This contact takes the substep to [`STEP_LIMIT`].
pub const CROSSED_MOBILITY: f64 = 4.56;
/// Mass of the nominal block, kg.
pub const NOMINAL_MASS: f64 = 0.0196;
/// Factor by which the strain of a block accelerates more slowly than its particles alone would.
///
/// The motion of a block as a whole is unaffected, so statics and rigid motion stay exact; a block
/// then vibrates at a third of its own rate, which is beyond hearing for wood. Without the factor
/// the mobility of a corner would be 10 / m, against 6 / m of a rigid block, and the substep 0.6
/// times as long.
pub const STRAIN_INERTIA: f64 = 8.0;
/// Squared spin times mass over the stiffness of a block's springs above which its strain by the
/// spin is exact. Below, its energy is less than 1e-4 of that of the rotation.
pub const SPIN_STRAIN: f64 = 1e-6;
/// Smallest extent of a strained block over its rest extent, along any axis.
pub const MIN_STRETCH: DVec3 = DVec3::splat(0.05);

/// Most substeps of a frame: at 60 frames a second 6 million a second, a tenth of real time for one
/// block.
pub const MAX_SUBSTEPS: usize = 100_000;
/// Longest time between two syncs of a moving body, s; a body at rest is synced once a frame.
pub const SYNC_TIME: f64 = 1.0 / 240.0;
/// Rotation of a body since the last sync that requires the next, rad. Gaps are integrated to first
/// order in between, with an error of 40 mm * rotation² / 2.
pub const SYNC_ROTATION: f64 = 4e-3;
/// Shortest time between syncs that [`SYNC_ROTATION`] requires of a spinning body, s.
pub const SPIN_SYNC_TIME: f64 = 5e-4;
/// Largest error of a gap between two syncs over the depth of an impact. A larger one gives small
/// blocks that spin energy at each sync.
pub const GAP_ERROR: f64 = 0.05;
/// Smallest rotation that requires a sync, rad.
pub const MIN_SYNC_ROTATION: f64 = 1e-5;
/// Rotation that requires a sync of a body without contacts, rad: it bounds the error of the
/// orientation.
pub const FREE_SYNC_ROTATION: f64 = 2e-2;
/// Used share of its budget of travel or rotation from which a body is synced along with others.
pub const SYNC_SHARE: f64 = 0.5;
/// Smallest travel budget of a body between two syncs, m.
pub const MIN_TRAVEL_BUDGET: f64 = 2e-6;
/// Budget of a body that needs none, m; its square is within single precision.
pub const UNLIMITED: f64 = 1e15;
/// Number of substeps between two checks of the budgets.
pub const BUDGET_CHECK_INTERVAL: usize = 4;

/// Relaxation time of the Maxwell element, s. It damps the slow sway of a tower; a shorter time
/// softens impacts.
pub const MAXWELL_TIME: f64 = 0.01;
/// Speed of the bodies of a contact from which they part in an impact, m/s: far above that of
/// blocks at rest.
pub const PARTING_SPEED: f64 = 2e-3;
/// Tangential over normal stiffness.
pub const TANGENTIAL_STIFFNESS: f64 = 0.8;
/// Tangential over normal damping.
pub const TANGENTIAL_DAMPING: f64 = 0.9;
/// Gap of points that count as touching when the first ones do, over the smallest edge of the
/// blocks: friction acts at the centre of these points.
pub const FIRST_TOUCH: f64 = 0.01;
/// Sliding speed at which friction is halfway between static and kinetic, m/s.
pub const STRIBECK_SPEED: f64 = 1e-3;

/// Range of the margin by which the bounds of a body are grown, m. Within it the margin is speed
/// times [`MARGIN_TIME`].
pub const MARGIN_RANGE: (f64, f64) = (5e-5, 1e-2);
/// Margin over the speed of a body, and reach over that of a pair, s.
pub const MARGIN_TIME: f64 = 8e-3;
/// Range of the separation up to which a pair gets a manifold, m. Within it that is the speed
/// against each other times [`MARGIN_TIME`].
pub const REACH_RANGE: (f64, f64) = (1e-4, 3e-3);
/// Smallest ratio of the reach of the last test of a pair to the one that it would have now; it is
/// tested again where they differ by more.
pub const MIN_REACH_SHARE: f64 = 0.5;
/// Smallest travel against each other before the next detection of two bodies that are near but not
/// in front of any of their faces, m: it bounds the penetration at which such bodies are detected.
pub const MIN_NEAR_TRAVEL: f64 = 1e-4;
/// Share of its margin that a body may travel before its bounds are renewed, and of its limit that
/// a pair may before it is tested again.
pub const MARGIN_SHARE: f64 = 0.7;
/// Deviation from uniform motion that requires a sync of a body, over the travel that is left to a
/// pair of it: an impact changes how fast its bodies move against each other.
pub const DEVIATION_SHARE: f64 = 0.25;
/// Radius of the edges of sharp blocks over the middle edge of a block: the normal of edges that
/// meet follows from the rounding. A larger radius moves the edges on which a tilted block stands,
/// a smaller one makes a wall of a seam that gives by less.
pub const SHARP_RADIUS: f64 = 7.5e-4;
/// Largest radius of the edges of a block over its smallest edge.
pub const MAX_RADIUS: f64 = 0.3;
/// Travel for which the normal of rounded edges holds, over the sum of their radii. A longer one
/// makes a block lose speed at a seam.
pub const ROUND_TRAVEL: f64 = 0.05;
/// Largest sine of the angle between two faces that meet as faces.
pub const FLAT_SINE: f64 = 0.03;
/// Largest sine of the angle between two faces that bear on their whole patch, roundings included.
pub const LEVEL_SINE: f64 = 0.01;
/// Smallest sine of the angle between two edges that gives an edge axis. For nearly parallel edges
/// the face axes suffice.
pub const MIN_EDGE_SINE: f64 = 0.02;
/// Smallest sine of the angle between an edge axis and the best face axis. Below it two blocks are
/// nearly flat on each other: an edge axis would give one point, although other points of the patch
/// may close before the next detection, as when a block rocks.
pub const MIN_EDGE_TILT: f64 = 0.05;
/// Separation by which an edge axis must exceed a face axis to be preferred, m.
pub const EDGE_PREFERENCE: f64 = 1e-4;
/// Separation by which an axis must exceed that of the last detection to replace it, m.
pub const AXIS_HYSTERESIS: f64 = 5e-5;
/// Distance below which two corners of a patch are merged, m.
pub const CORNER_MERGE: f64 = 1e-4;

/// Depth of a contact that is never free of force, over the smallest edge of its blocks.
pub const MIN_FREE_DEPTH: f64 = 1e-6;
/// Difference of a gap and its first order between two syncs that exerts no force, over the
/// smallest edge of the blocks; smaller ones are rounding.
pub const MIN_SUNK_DEPTH: f64 = 1e-6;
/// Speed at which a free depth fades over the smallest edge of the blocks, 1/s: slow against an
/// impact, so that fading does little work.
pub const FREE_DEPTH_RATE: f64 = 0.05;

/// Depth to which the weight on a contact may press it, over the smallest edge of its blocks. What
/// drops onto a contact presses it twice as deep.
pub const MAX_SAG: f64 = 0.1;
/// Gap up to which blocks touch at the start, m: the rounding of files with five digits.
pub const TOUCH_GAP: f64 = 2e-5;
/// Time over which gravity grows while a new world settles, s.
pub const START_RAMP: f64 = 0.1;
/// Longest time for which a new world settles, s.
pub const START_TIME: f64 = 3.0;
/// Share of its velocity that a body keeps at the end of each frame in which gravity grows.
pub const START_DAMPING: f64 = 0.5;
/// Travel of a block against one that it touches, over the middle edge of the smaller, from which
/// it does not settle but falls or slides: more than [`MAX_SAG`], by which soft contacts give. A
/// loose block of a tower rocks by a thirtieth of it, a card of a house by half its thickness.
pub const START_REACH: f64 = 0.12;
/// Speed below which a body has settled, m/s.
pub const START_SPEED: f64 = 1e-5;
/// Speed up to which a body that has not settled in time begins where it is, m/s.
pub const SWAY_SPEED: f64 = 1e-3;

/// Time at rest after which a body may sleep, s.
pub const REST_TIME: f64 = 0.25;
/// Largest travel of a point of a body since the start of its rest, m.
pub const REST_TRAVEL: f64 = 2.5e-6;
/// Largest mean acceleration of a body at rest, m/s².
pub const REST_ACCELERATION: f64 = 0.01;

/// Natural frequency of the hand, rad/s: 1 kN/m for the nominal block, so that a lead of 4 mm gives
/// 4 N.
pub const HAND_RATE: f64 = 225.0;
/// Natural frequency of the hand's control of orientation, rad/s. The weight of a block held by its
/// end rotates it by less than a milliradian; with a softer control a block that is half out tips,
/// and its inner end presses on the blocks above.
pub const HAND_ROTATION_RATE: f64 = 900.0;
/// Share of a block's weight that a hand carries while it draws the block out: a loose block then
/// drags its tower along by a fifth of its friction. The remaining weight of a block that is half
/// out tips it by the give of the hand: with a share of a half by a tenth of a milliradian, and its
/// inner end wedges under a block that is 8 um above it.
pub const HAND_LIFT: f64 = 0.8;
/// Speed of a body's points from which its energy is checked, m/s.
pub const RUNAWAY_SPEED: f64 = 100.0;
/// Energy of a fast body over that of its cluster from which it has run away. Impacts at high speed
/// are some substeps long, and so are their errors.
pub const BOOK_FACTOR: f64 = 2.0;
/// Speed of a body's points at which the range of the method ends, m/s: a fall of 5000 km. A body
/// moves by its own size in less than a substep.
pub const MAX_SPEED: f64 = 1e4;
/// Maximum speed of a body's points that an input may ask for, m/s.
pub const MAX_INPUT_SPEED: f64 = 1e3;
/// Maximum acceleration of a body's points by each input, m/s²: a block moves by 8 mm between two
/// checks of the budgets.
pub const MAX_ACCELERATION: f64 = 1e5;
/// Maximum distance from the origin of a point that an input names, and maximum lever arm, m.
pub const MAX_INPUT_DISTANCE: f64 = 1e6;
/// Maximum gravity of an input, m/s²: that of scenes.
pub const MAX_GRAVITY: f64 = 100.0;
/// Maximum distance of the point that a hand holds from the centre of the body, over the distance
/// of a corner.
pub const MAX_ANCHOR: f64 = 2.0;

/// Maximum number of pairs of bodies of which the bounds overlap at the start: about 300 MB.
pub const MAX_PAIRS: usize = 10_000_000;
/// Smallest sweep of a body in a frame, m: free fall from rest for 1/60 s (1.4 mm), and the largest
/// margin.
pub const MIN_SWEEP: f64 = 3e-3;
/// Sweep of a body in a frame over the travel of the fastest point of its cluster. Impacts can make
/// a body faster than the one that hit it.
pub const SWEEP_FACTOR: f64 = 1.5;
/// Margin added to swept bounds that are renewed, m, so that slow motion does not renew them in
/// each frame.
pub const SWEEP_SLACK: f64 = 2e-3;
/// Excess of swept bounds above which they are shrunk, m.
pub const SWEEP_EXCESS: f64 = 1e-2;

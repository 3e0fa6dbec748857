//! The constants of the method, each with its unit and what breaks if it is changed.

/// Area of contact for which the stiffness of a scene holds, m²: two crossed nominal blocks.
pub const REFERENCE_AREA: f64 = 0.0268 * 0.0268;
/// Range of the area of contact over [`REFERENCE_AREA`] that stiffness follows. A block lying flat on another has 3.02; the
/// lower end keeps a sliver from being a hole, the upper one bounds the step.
pub const AREA_RANGE: (f64, f64) = (0.1, 3.2);
/// Area over [`REFERENCE_AREA`] that an edge crossing an edge counts as.
pub const EDGE_AREA: f64 = 0.25;

/// Part of the stability limit of the explicit step, 4, that one contact between two bodies may use. Each body has contacts on all
/// sides: towers lean wrongly from 1.2 on.
pub const STEP_LIMIT: f64 = 1.0;
/// The same for a contact with the floor, which has but one side.
pub const FLOOR_STEP_LIMIT: f64 = 2.0;
/// How easily two nominal blocks give way where they cross at their ends, times their mass: 2 (1 + d² m / I) with d = 27.1 mm. This
/// contact takes the substep to [`STEP_LIMIT`].
pub const CROSSED_MOBILITY: f64 = 4.56;
/// Mass of the nominal block, kg.
pub const NOMINAL_MASS: f64 = 0.0196;
/// Longest time between two syncs of a body that moves, s; one that does not is synced once a frame.
pub const SYNC_TIME: f64 = 1.0 / 240.0;
/// Turn of a body since the last sync that asks for the next, rad: gaps are integrated to first order in between, an error of
/// 40 mm * turn² / 2.
pub const SYNC_TURN: f64 = 4e-3;
/// Time between syncs of a spinning body that [`SYNC_TURN`] does not go below, s.
pub const SPIN_SYNC_TIME: f64 = 5e-4;
/// The same for a body that touches nothing, rad: it only bounds the error of the orientation.
pub const FREE_SYNC_TURN: f64 = 2e-2;
/// Share of what a body may travel or turn from which it is synced along with others.
pub const SYNC_SHARE: f64 = 0.5;
/// Least travel that a body is granted until the next sync, m.
pub const LEAST_BOUND: f64 = 2e-6;
/// Substeps between two looks at the travel of the bodies.
pub const GUARD_SUBSTEPS: usize = 4;

/// Relaxation time of the Maxwell element, s. It is what damps the slow sway of a tower; a shorter one makes impacts softer.
pub const MAXWELL_TIME: f64 = 0.01;
/// Tangential over normal stiffness.
pub const TANGENTIAL_STIFFNESS: f64 = 0.8;
/// Tangential over normal damping.
pub const TANGENTIAL_DAMPING: f64 = 0.9;
/// Sliding speed at which friction has fallen half way from static to kinetic, m/s.
pub const STRIBECK_SPEED: f64 = 1e-3;

/// Detection margin of a body: its speed times [`MARGIN_TIME`], within [`MARGIN_RANGE`], m.
pub const MARGIN_RANGE: (f64, f64) = (5e-5, 1.5e-3);
/// See [`MARGIN_RANGE`], s.
pub const MARGIN_TIME: f64 = 8e-3;
/// Least travel granted to a body that is near another but not before any of its faces, m: how deep such bodies may be in each
/// other when they are found.
pub const LEAST_NEAR: f64 = 1e-4;
/// Share of its margin that a body may travel before its contacts are detected again.
pub const MARGIN_SHARE: f64 = 0.7;
/// Edge axes of nearly parallel edges say nothing that the face axes do not: least sine of the angle.
pub const LEAST_EDGE_SINE: f64 = 0.02;
/// Least sine of the angle between an edge axis and the best face axis: nearer to it two blocks are all but flat on each other. They have one point
/// on an edge axis and all points of their patch on the face axis, of which others may close before the next detection, as when a block rocks.
pub const LEAST_EDGE_TILT: f64 = 0.05;
/// By how much an edge axis must separate better than a face axis to be taken, m.
pub const EDGE_PREFERENCE: f64 = 1e-4;
/// By how much another axis must separate better than the one of the last detection to be taken, m.
pub const AXIS_HYSTERESIS: f64 = 5e-5;
/// Corners of a patch closer together than this are one, m.
pub const CORNER_MERGE: f64 = 1e-4;

/// How long a body must be at rest before it may sleep, s.
pub const REST_TIME: f64 = 0.25;
/// How far the points of a body at rest may be from their place at the start of the rest, m.
pub const REST_TRAVEL: f64 = 2.5e-6;
/// Largest mean acceleration of a body at rest, m/s².
pub const REST_ACCELERATION: f64 = 0.01;

/// Natural frequency of the hand, rad/s: for the nominal block 1 kN/m, so that a lead of 4 mm gives 4 N.
pub const HAND_RATE: f64 = 225.0;
/// The same of its hold on the orientation, rad/s: the weight of a block held by its end turns it by less than a milliradian. A softer hold lets a block that is
/// half out tip, and its inner end presses on what lies above.
pub const HAND_TURN_RATE: f64 = 900.0;
/// Share of the weight that a hand takes off what bears the block that it draws out: a loose block drags its tower along by half as much.
pub const HAND_LIFT: f64 = 0.5;
/// Speed at which a body has run away, m/s.
pub const RUNAWAY_SPEED: f64 = 100.0;

/// What a body is expected to sweep in a frame: [`SWEEP_LEAST`] and [`SWEEP_SPEED`] times what the fastest point of its cluster does.
/// Least reach, m: free fall from rest in a frame of 1/60 s (1.4 mm), and the largest margin.
pub const SWEEP_LEAST: f64 = 3e-3;
/// See [`SWEEP_LEAST`]. Impacts can make a body faster than the one that hit it.
pub const SWEEP_SPEED: f64 = 1.5;
/// What is granted beyond it, so that slow motion does not ask for more in each frame, m.
pub const SWEEP_SLACK: f64 = 2e-3;
/// What is taken back again when it is no longer needed, m.
pub const SWEEP_EXCESS: f64 = 1e-2;

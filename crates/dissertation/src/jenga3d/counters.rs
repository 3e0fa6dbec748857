//! Counters of tests (Table 5.2).

use serde::Serialize;

/// Potential collisions that remain after each kind of test.
///
/// ```
/// use teeter_dissertation::jenga3d::counters::Counters;
///
/// let mut sum = Counters::default();
/// sum += Counters { potential: 336, ..Counters::default() };
/// assert_eq!(sum.potential, 336);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct Counters {
    /// Before any test: 336 a pair of blocks, 8 x 12 points and faces in both directions and 12 x
    /// 12 edges.
    pub potential: u64,
    /// Those of pairs whose boxes are compared: cached pairs that cannot meet are not.
    pub near: u64,
    /// After the boxes of blocks.
    pub after_blocks: u64,
    /// After the boxes of faces, edges and particles.
    pub after_boxes: u64,
    /// After the tests of planes and lines.
    pub after_planes: u64,
    /// Collisions found.
    pub collisions: u64,
}

impl std::ops::AddAssign for Counters {
    fn add_assign(&mut self, other: Self) {
        self.potential += other.potential;
        self.near += other.near;
        self.after_blocks += other.after_blocks;
        self.after_boxes += other.after_boxes;
        self.after_planes += other.after_planes;
        self.collisions += other.collisions;
    }
}

impl Counters {
    /// Returns the counts since earlier ones.
    pub fn since(&self, earlier: &Self) -> Self {
        Self {
            potential: self.potential - earlier.potential,
            near: self.near - earlier.near,
            after_blocks: self.after_blocks - earlier.after_blocks,
            after_boxes: self.after_boxes - earlier.after_boxes,
            after_planes: self.after_planes - earlier.after_planes,
            collisions: self.collisions - earlier.collisions,
        }
    }
}

/// Tests of one pair of blocks: 2 (8 x 12) + 12 x 12.
pub const TESTS_OF_PAIR: u64 = 336;

/// Returns the number of tests of `blocks` blocks without culling, each pair once: 168 n (n - 1) of
/// section 4.4.3.
pub fn tests(blocks: u64) -> u64 {
    blocks * blocks.saturating_sub(1) * 168
}

/// Number of bins of [`Rounds::calls_by_rounds`].
pub const ROUND_BINS: usize = 10;

/// Rounds over the pairs in the calls of `CollideBlocks`: the "couple of iterations" after which
/// all collisions are said to be resolved (section 6.2.2).
///
/// ```
/// use teeter_dissertation::jenga3d::{Constants, Jenga3D};
///
/// let scene = teeter_scene::named("test-6").expect("the list has it");
/// let mut simulator = Jenga3D::new(&scene, Constants::default()).expect("a valid scene");
/// let rounds = simulator.frame(None).rounds;
/// assert_eq!(rounds.calls, 2 * 160); // two calls in each of the steps (appendix 2.4)
/// assert_eq!(rounds.unresolved, 0);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct Rounds {
    /// Number of calls.
    pub calls: u64,
    /// Number of rounds in all calls. The last round of a call finds nothing, unless it is at the
    /// limit.
    pub total: u64,
    /// Maximum number of rounds in a call.
    pub max: u32,
    /// Calls that ended at the limit of rounds with collisions left.
    pub unresolved: u64,
    /// Steps with such a call.
    pub unresolved_steps: u64,
    /// Frames with such a call.
    pub unresolved_frames: u64,
    /// Number of calls by their rounds: entry i counts those of i + 1 rounds, the last entry those
    /// of more as well.
    pub calls_by_rounds: [u64; ROUND_BINS],
}

impl Rounds {
    /// Adds a call of a number of rounds.
    pub fn add_call(&mut self, rounds: u32, resolved: bool) {
        self.calls += 1;
        self.total += u64::from(rounds);
        self.max = self.max.max(rounds);
        self.unresolved += u64::from(!resolved);
        self.calls_by_rounds[(rounds as usize).clamp(1, ROUND_BINS) - 1] += 1;
    }

    /// Mean number of rounds in a call; 0 without calls.
    pub fn mean(&self) -> f64 {
        if self.calls == 0 { 0.0 } else { self.total as f64 / self.calls as f64 }
    }
}

impl std::ops::AddAssign for Rounds {
    fn add_assign(&mut self, other: Self) {
        self.calls += other.calls;
        self.total += other.total;
        self.max = self.max.max(other.max);
        self.unresolved += other.unresolved;
        self.unresolved_steps += other.unresolved_steps;
        self.unresolved_frames += other.unresolved_frames;
        for (sum, n) in self.calls_by_rounds.iter_mut().zip(other.calls_by_rounds) {
            *sum += n;
        }
    }
}

/// Counters of one step of integrating and colliding.
///
/// ```
/// use teeter_dissertation::jenga3d::{Constants, Jenga3D};
///
/// let scene = teeter_scene::named("column").expect("the list has it");
/// let mut simulator = Jenga3D::new(&scene, Constants::default()).expect("a valid scene");
/// assert_eq!(simulator.step(None).first.potential, 336 * 45); // 45 pairs
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct StepCounts {
    /// Tests of the first round of each call of `CollideBlocks`.
    pub first: Counters,
    /// Tests of all rounds.
    pub all: Counters,
    /// Maximum number of rounds over the pairs in a call; the last finds nothing.
    pub sweeps: u32,
    /// Calls that ended with collisions left.
    pub unresolved: u32,
    /// Rounds of both calls.
    pub rounds: Rounds,
}

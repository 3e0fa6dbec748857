//! Definition of a fall, for a tower that nobody touches and for one in play.
//!
//! A block has fallen when it is no longer borne where it was. There are two signs of that:
//!
//! * **dropped**: its centre came down by more than a sixth of a height;
//! * **tipped**: corners of its underside came apart vertically by more than half of a height, or
//!   half of the underside's width where that is less.
//!
//! Both are relative to what bears it. The *bearers* of a block are the blocks beneath it that it
//! touches or almost touches; with them the block may sink, as on soft contacts, and lean. A bearer
//! that has itself fallen, or that a hand has taken, is replaced by its own bearers, down to the
//! floor. So a block whose support was drawn out has fallen once it lies on the next, and a tower
//! that topples as one falls with its lowest block.
//!
//! The height is that of the block or of its lowest bearer, whichever is less, so the definition
//! has no length of its own and holds for blocks of any size. It asks for nothing sideways: a block
//! that slides on its bearers has not fallen before it leaves them.

use std::collections::BTreeSet;

use glam::DVec3;
use serde::{Deserialize, Serialize};
use teeter_physics::{BodyId, World};
use teeter_scene::Scene;

use crate::cuboid::Cuboid;

/// Share of the height by which a block that has fallen dropped. A block on contacts that give, or
/// that a hand moves, drops by far less; one that loses its support drops by a whole height.
const DROPPED: f64 = 1.0 / 6.0;
/// Share of the height by which the corners of a block that has fallen came apart. A long block
/// that rocks on an uneven row stays below it; one that tips over an edge goes beyond.
const TIPPED: f64 = 0.5;
/// Share of the height by which a block that slid moved on its bearers.
const SLIPPED: f64 = 0.28;

/// Block that bears another.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Bearer {
    body: u32,
    /// Position of the bearer when the other came to lie on it.
    at: Cuboid,
}

impl Bearer {
    /// Displacement of the point of the bearer that was nearest to a point of the world, m.
    fn displacement(&self, now: &[Cuboid], point: DVec3) -> DVec3 {
        let nearest = self.at.nearest(point);
        now[self.body as usize].point(nearest) - self.at.point(nearest)
    }
}

/// Block as it stood when it came to lie on its bearers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Stance {
    at: Cuboid,
    bearers: Vec<Bearer>,
    /// True when the block is on the floor, or nothing is beneath it.
    is_grounded: bool,
    /// Least height of the block and its bearers, m.
    height: f64,
    /// Distance that corners of a block that has fallen came apart, m.
    max_spread: f64,
}

impl Stance {
    fn new(blocks: &[Cuboid], body: usize) -> Self {
        let at = blocks[body];
        let height = at.height();
        let bears = |other: &usize| {
            let max_gap = DROPPED * height.min(blocks[*other].height());
            *other != body && at.lies_on(&blocks[*other], max_gap)
        };
        let bearers: Vec<Bearer> =
            (0..blocks.len()).filter(bears).map(|other| Bearer { body: other as u32, at: blocks[other] }).collect();
        let is_grounded = bearers.is_empty() || at.bottom() <= DROPPED * height;
        let height = bearers.iter().map(|bearer| bearer.at.height()).fold(height, f64::min);
        let max_spread = TIPPED * height.min(width(&at));
        Self { at, bearers, is_grounded, height, max_spread }
    }

    fn lies_on(&self, body: u32) -> bool {
        self.bearers.iter().any(|bearer| bearer.body == body)
    }

    /// Corners of the underside, by their coordinates along the edges.
    fn underside(&self) -> impl Iterator<Item = DVec3> {
        let foot = self.at.foot();
        let face = (0..3).find(|&k| foot[k].abs() == 1.0).unwrap_or(2);
        (0..4).map(move |i| {
            let mut corner = DVec3::splat(foot[face].signum());
            corner[(face + 1) % 3] = if i & 1 == 1 { 1.0 } else { -1.0 };
            corner[(face + 2) % 3] = if i & 2 == 2 { 1.0 } else { -1.0 };
            corner
        })
    }
}

/// Lesser horizontal length of the two edges of the underside of a block, m.
fn width(at: &Cuboid) -> f64 {
    let foot = at.foot().abs();
    let edges = (0..3).filter(|&k| foot[k] < 1.0);
    edges.map(|k| 2.0 * at.half_edges.col(k).truncate().length()).fold(f64::INFINITY, f64::min)
}

/// Positions of the blocks of a tower, and what bears each: the reference of falls.
///
/// ```
/// use teeter_physics::{Params, World};
/// use teeter_study::Footing;
///
/// let scene = teeter_scene::named("column").unwrap();
/// let mut tower = World::new(&scene, Params::default())?;
/// let footing = Footing::of_scene(&scene);
/// tower.run_for(1.0);
/// assert!(!footing.any_fallen(&tower));
///
/// let scene = teeter_scene::named("test-4").unwrap();
/// let mut falling = World::new(&scene, Params::default())?;
/// let footing = Footing::of_scene(&scene);
/// falling.run_for(2.0);
/// assert!(footing.any_fallen(&falling));
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Footing {
    stances: Vec<Stance>,
    /// Indices of the blocks, each after its bearers.
    order: Vec<u32>,
}

impl Footing {
    /// Footing of the blocks where they are.
    pub fn new(blocks: &[Cuboid]) -> Self {
        let mut order: Vec<u32> = (0..blocks.len() as u32).collect();
        // bearers have their centres below
        order.sort_by(|a, b| blocks[*a as usize].center.z.total_cmp(&blocks[*b as usize].center.z));
        Self { stances: (0..blocks.len()).map(|body| Stance::new(blocks, body)).collect(), order }
    }

    /// Footing of the blocks of a scene as built: a world of a scene that cannot stand may begin
    /// with its blocks moved.
    pub fn of_scene(scene: &Scene) -> Self {
        Self::new(&scene.blocks.iter().map(Cuboid::of_block).collect::<Vec<_>>())
    }

    /// Footing of the blocks of a world where they are.
    pub fn of(world: &World) -> Self {
        Self::new(&Cuboid::all(world))
    }

    /// Number of blocks.
    pub fn len(&self) -> usize {
        self.stances.len()
    }

    /// Returns true if there is no block.
    pub fn is_empty(&self) -> bool {
        self.stances.is_empty()
    }

    /// Returns true if every index is that of one of the blocks: the footing comes from outside.
    pub fn is_valid(&self) -> bool {
        let count = self.stances.len();
        let mut order: Vec<usize> = self.order.iter().map(|body| *body as usize).collect();
        let is_before = |bearer: &Bearer, body: usize| {
            let at = |body: usize| order.iter().position(|other| *other == body);
            at(bearer.body as usize).zip(at(body)).is_some_and(|(first, second)| first < second)
        };
        let is_sorted = |(body, stance): (usize, &Stance)| stance.bearers.iter().all(|bearer| is_before(bearer, body));
        let sorted = self.stances.iter().enumerate().all(is_sorted);
        order.sort_unstable();
        sorted && order.into_iter().eq(0..count)
    }

    /// Gives a block the footing that it has now. It bears none of the others any longer: they
    /// are borne by what bore it.
    ///
    /// # Panics
    /// When there is no such block.
    pub fn renew(&mut self, body: BodyId, now: &[Cuboid]) {
        let index = body.index();
        let before = std::mem::replace(&mut self.stances[index], Stance::new(now, index));
        for stance in self.stances.iter_mut().filter(|stance| stance.lies_on(body.0)) {
            stance.bearers.retain(|bearer| bearer.body != body.0);
            for bearer in &before.bearers {
                if !stance.lies_on(bearer.body) {
                    stance.bearers.push(*bearer);
                }
            }
            stance.is_grounded |= before.is_grounded;
        }
        // it bears nothing now
        self.order.retain(|other| *other != body.0);
        self.order.push(body.0);
    }

    /// Sets the mark of each block that has fallen, from the marks of those that fell before;
    /// leaves the other marks. Blocks of which `absent` is true bear nothing and are not judged.
    ///
    /// A block whose position is not finite has fallen.
    ///
    /// # Panics
    /// When there are not as many blocks as in the footing.
    pub fn mark_fallen(&self, now: &[Cuboid], absent: impl Fn(BodyId) -> bool, fallen: &mut [bool]) {
        let mut gone: Vec<bool> = (0..).map(BodyId).zip(&*fallen).map(|(body, fell)| *fell || absent(body)).collect();
        for &body in &self.order {
            let index = body as usize;
            if !gone[index] && self.has_fallen(index, now, &gone) {
                (gone[index], fallen[index]) = (true, true);
            }
        }
    }

    /// Returns true if any block has fallen.
    pub fn any_fallen(&self, world: &World) -> bool {
        self.any_fallen_of(&Cuboid::all(world))
    }

    /// Returns true if any block has fallen: the blocks as they are now, also those of another
    /// engine.
    ///
    /// # Panics
    /// When there are not as many blocks as in the footing.
    pub fn any_fallen_of(&self, now: &[Cuboid]) -> bool {
        self.any(now, |_| false, Self::has_fallen)
    }

    /// Returns true if any block but `body` has fallen, which a hand has taken.
    pub fn any_fallen_except(&self, world: &World, body: BodyId) -> bool {
        self.any(&Cuboid::all(world), |other| other == body, Self::has_fallen)
    }

    /// Returns true if any block has fallen, or slid on its bearers by more than a share of
    /// a height: on a floor that is tilted a tower collapses in both manners.
    pub fn any_fallen_or_slid(&self, world: &World) -> bool {
        self.any_fallen_or_slid_of(&Cuboid::all(world))
    }

    /// Returns true if any block has fallen or slid, as [`Footing::any_fallen_or_slid`]: the blocks
    /// as they are now, also those of another engine.
    ///
    /// # Panics
    /// When there are not as many blocks as in the footing.
    pub fn any_fallen_or_slid_of(&self, now: &[Cuboid]) -> bool {
        let has_moved = |footing: &Self, body: usize, now: &[Cuboid], gone: &[bool]| {
            footing.has_fallen(body, now, gone) || footing.has_slid(body, now, gone)
        };
        self.any(now, |_| false, has_moved)
    }

    fn any(
        &self,
        now: &[Cuboid],
        absent: impl Fn(BodyId) -> bool,
        is_sign: impl Fn(&Self, usize, &[Cuboid], &[bool]) -> bool,
    ) -> bool {
        assert_eq!(now.len(), self.len(), "a footing is of as many blocks");
        let gone: Vec<bool> = (0..now.len() as u32).map(BodyId).map(absent).collect();
        (0..self.len()).any(|body| !gone[body] && is_sign(self, body, now, &gone))
    }

    fn has_fallen(&self, body: usize, now: &[Cuboid], gone: &[bool]) -> bool {
        let stance = &self.stances[body];
        let supports = self.supports(body, gone);
        // Of a block at rest no point can have moved that far against a support: the bound spares
        // the search for the nearest points.
        let travel = now[body].max_travel(&stance.at) + supports.max_travel(now);
        if 2.0 * travel <= stance.max_spread.min(DROPPED * stance.height) {
            return false;
        }
        // the part of a point's rise that those of its supports do not explain
        let rise = |local: DVec3| {
            let start = stance.at.point(local);
            let rise = now[body].point(local).z - start.z;
            let (low, high) = supports.rises(now, start);
            rise - rise.max(low).min(high)
        };
        let foot = stance.at.foot();
        // the loss of half of its own height brings a strained block down as well
        let strain = (stance.at.half_edges * foot).length() - (now[body].half_edges * foot).length();
        let drop = -rise(DVec3::ZERO) - strain;
        let corners: Vec<f64> = stance.underside().map(rise).collect();
        let extreme = |of: fn(f64, f64) -> f64| corners.iter().copied().fold(f64::NAN, of);
        let spread = extreme(f64::max) - extreme(f64::min);
        let is_borne = drop <= DROPPED * stance.height && spread <= stance.max_spread;
        // comparisons with NaN are false
        !(is_borne && now[body].center.is_finite())
    }

    fn has_slid(&self, body: usize, now: &[Cuboid], gone: &[bool]) -> bool {
        let stance = &self.stances[body];
        let start = stance.at.center;
        let moved = now[body].center - start;
        self.supports(body, gone).min_slip(now, start, moved) > SLIPPED * stance.height
    }

    /// Supports of a block where the blocks that are `gone` bear none.
    fn supports(&self, body: usize, gone: &[bool]) -> Supports<'_> {
        let mut supports = Supports { bearers: Vec::new(), is_grounded: false, replaced: BTreeSet::new() };
        self.collect_supports(body, gone, &mut supports);
        supports
    }

    fn collect_supports<'a>(&'a self, body: usize, gone: &[bool], supports: &mut Supports<'a>) {
        let stance = &self.stances[body];
        supports.is_grounded |= stance.is_grounded;
        for bearer in &stance.bearers {
            if gone[bearer.body as usize] {
                // Rows that cross bear each other on many paths: each block is passed once.
                if supports.replaced.insert(bearer.body) {
                    self.collect_supports(bearer.body as usize, gone, supports);
                }
            } else if supports.bearers.iter().all(|other| other.body != bearer.body) {
                supports.bearers.push(bearer);
            }
        }
    }
}

/// Supports of a block.
struct Supports<'a> {
    bearers: Vec<&'a Bearer>,
    is_grounded: bool,
    /// Bearers that are gone and were replaced by their own.
    replaced: BTreeSet<u32>,
}

impl Supports<'_> {
    /// Displacement of each support at a point of the world, m.
    fn displacements<'a>(&'a self, now: &'a [Cuboid], point: DVec3) -> impl Iterator<Item = DVec3> + 'a {
        let floor = self.is_grounded.then_some(DVec3::ZERO);
        self.bearers.iter().map(move |bearer| bearer.displacement(now, point)).chain(floor)
    }

    /// Smallest and largest rise of the supports at a point of the world, m.
    fn rises(&self, now: &[Cuboid], point: DVec3) -> (f64, f64) {
        let rises = self.displacements(now, point).map(|displacement| displacement.z);
        rises.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), rise| (low.min(rise), high.max(rise)))
    }

    /// Upper bound of the displacement of any point of a support, m.
    fn max_travel(&self, now: &[Cuboid]) -> f64 {
        let travels = self.bearers.iter().map(|bearer| now[bearer.body as usize].max_travel(&bearer.at));
        travels.fold(0.0, f64::max)
    }

    /// Slip of a displacement against the support that moved most like it, m.
    fn min_slip(&self, now: &[Cuboid], point: DVec3, moved: DVec3) -> f64 {
        let slips = self.displacements(now, point).map(|displacement| moved.distance(displacement));
        slips.fold(f64::INFINITY, f64::min)
    }
}

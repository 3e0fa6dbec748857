//! The exact answer for rigid blocks, by linear programming.
//!
//! *Where they lie.* The blocks come down as far as they can: min sum m g z over heights and small tilts, subject to no overlap at the corners of
//! each region in which two blocks overlap in plan. The normal forces are the duals of that; here the dual itself is solved: of all forces that hold
//! every block in equilibrium, those that do the least work against the gaps. Where there are none the tower falls. Heights that differ at random
//! leave one answer for what each block carries, but faces that lie flat on each other leave it open how their corners share a load; of these answers
//! the one is taken that springs come to as they grow stiff ([`crate::stiff`]).
//!
//! *When a block slides.* With those normal forces N there are two answers. *Straight*: it slides on what is below it, and what is above either
//! slides on it or goes along and slides on the rest of its row. *Turning*: the largest force along the long axis for which friction of at most mu N
//! at each corner can keep every block from sliding and turning in the plane (limit analysis, exact for normal forces that stay as they are). Within a
//! patch the corners stand for a pressure that is spread: around its centre they hold with the lever of [`crate::torsion`].
//!
//! *When the tower tips instead.* The blocks above a row with the pulled one among them are held by what bears them where their weight and the pull come
//! down within the hull of the loaded corners. Beyond that they rock, until what was loose bears as well.
//!
//! Where nothing lies on a block, or nothing can turn, the first two agree, and where the tower does not tip before that the answer is exact. Elsewhere
//! none is the last word: friction tilts blocks and so shifts normal
//! forces, and what it held back while the tower settled stays in it.

use glam::{DVec2, DVec3};
use microlp::{ComparisonOp, LinearExpr, OptimizationDirection, Problem, Variable};
use serde::Serialize;
use teeter_physics::REFERENCE_AREA;
use teeter_scene::{Block, Scene};

use crate::plan::{area, bottom, center, corners, hull, long_axis, overlap, top, way_within};
use crate::stiff::{self, Spring};
use crate::torsion::lever;

/// Blocks nearer than this above one another may touch, m.
const NEAR: f64 = 2e-3;
/// Lengths in the programmes are in this unit, m, so that all their numbers are near 1.
const UNIT: f64 = 1e-2;
/// Corners of the polygon that stands for the circle of friction: the forces are at most 0.5 % low.
const DIRECTIONS: usize = 32;
/// A force below this is none, N.
const NONE: f64 = 1e-9;
/// Share of its height by which a tower is pressed together where the search for its forces begins.
const PRESSED: f64 = 0.05;
/// The two answers agree where they differ by less than this share, which is twice what [`DIRECTIONS`] leaves open.
const AGREE: f64 = 0.01;

/// Why there is no exact answer for a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum NoAnswer {
    /// No forces hold every block in equilibrium.
    #[error("rigid blocks do not rest like this: the tower falls")]
    Falls,
    /// The solver gave up.
    #[error("the linear programme was not solved")]
    Unsolved,
}

/// What mechanics says of the force that starts a block sliding along its long axis, the same both ways.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Answer {
    /// If what lies on the block can slide on it or go along, but not turn, N.
    pub straight_n: f64,
    /// If it can turn about the vertical as well, with the normal forces of rest, N.
    pub turning_n: f64,
    /// The force at which the tower begins to rock about the edge of what bears it, N; none where the block is too low for any to do so.
    pub tipping_n: Option<f64>,
}

impl Answer {
    /// Whether the first two agree and the tower does not rock before: then it is exact.
    pub fn is_exact(&self) -> bool {
        self.straight_n - self.turning_n <= AGREE * self.straight_n && !self.rocks()
    }

    /// Whether the tower rocks before the block slides.
    pub fn rocks(&self) -> bool {
        self.tipping_n.is_some_and(|tipping| tipping < self.straight_n)
    }

    /// How far a force is outside the range between the two, N.
    pub fn error(&self, force: f64) -> f64 {
        let low = self.turning_n.min(self.straight_n);
        (low - force).max(force - self.straight_n).max(0.0)
    }
}

/// A corner at which two blocks, or a block and the floor, may touch.
#[derive(Debug, Clone, Copy)]
struct Point {
    below: Option<usize>,
    above: usize,
    place: DVec2,
    gap: f64,
    /// Share of the area of the region, m².
    area: f64,
    /// Which region, and the lever of its torsional friction.
    region: usize,
    lever: f64,
}

/// A region in which two blocks, or a block and the floor, touch.
#[derive(Debug, Clone, PartialEq)]
pub struct Patch {
    /// Index of the lower block; none for the floor.
    pub below: Option<usize>,
    /// Index of the upper block.
    pub above: usize,
    /// Lever of its torsional friction, see [`crate::torsion`].
    pub lever: f64,
    /// Places of the corners (m), anticlockwise, and the normal forces there (N).
    pub corners: Vec<(DVec2, f64)>,
}

impl Patch {
    /// The load on `cells` by `cells` parts of a patch that is a parallelogram, as springs under a flat face spread it: along each side the pressure varies evenly
    /// and is nowhere negative, and its centre is where that of the corners is. Places (m) and forces (N). A patch of another number of corners keeps them.
    pub fn mesh(&self, cells: usize) -> Vec<(DVec2, f64)> {
        let &[a, b, c, d] = &self.corners[..] else { return self.corners.clone() };
        let load = a.1 + b.1 + c.1 + d.1;
        if load < NONE {
            return self.corners.clone();
        }
        let along = spread(((b.1 + c.1) - (a.1 + d.1)) / load, cells);
        let across = spread(((c.1 + d.1) - (a.1 + b.1)) / load, cells);
        let place = |u: f64, v: f64| a.0 + (b.0 - a.0) * (0.5 * (1.0 + u)) + (d.0 - a.0) * (0.5 * (1.0 + v));
        along.iter().flat_map(|&(u, f)| across.iter().map(move |&(v, g)| (place(u, v), load * f * g))).collect()
    }
}

/// Places from -1 to 1 and shares of a load whose centre is at `center`, on `cells` parts: 1 + 3 center u while that is nowhere negative, beyond it a triangle
/// on the last 3 (1 - |center|) before the end.
fn spread(center: f64, cells: usize) -> Vec<(f64, f64)> {
    let side = center.signum();
    let center = center.abs().min(1.0);
    let length = (3.0 * (1.0 - center)).clamp(1e-9, 2.0);
    let pressure = |u: f64| if center <= 1.0 / 3.0 { 1.0 + 3.0 * center * u } else { u - (1.0 - length) };
    let places: Vec<f64> = (0..cells).map(|i| 1.0 - length * (1.0 - (i as f64 + 0.5) / cells as f64)).collect();
    let total: f64 = places.iter().map(|&u| pressure(u)).sum();
    places.iter().map(|&u| (side * u, pressure(u) / total)).collect()
}

/// A tower of rigid blocks at rest.
#[derive(Debug, Clone)]
pub struct Rigid<'a> {
    scene: &'a Scene,
    points: Vec<Point>,
    /// Normal force at each point, N.
    forces: Vec<f64>,
    /// The optimum of the programme, J.
    work: f64,
}

impl<'a> Rigid<'a> {
    /// The tower of `scene`.
    ///
    /// # Errors
    /// When rigid blocks cannot rest like this.
    pub fn new(scene: &'a Scene) -> Result<Self, NoAnswer> {
        let (points, work) = held(scene)?;
        let forces = shared(scene, &points, stiff::RIGID).ok_or(NoAnswer::Unsolved)?;
        Ok(Self { scene, points, forces, work })
    }

    /// The same blocks on contacts as stiff as those of the scene, which give by N / k: where heights differ by less than that, a block carries load that
    /// would be none if nothing gave.
    ///
    /// # Errors
    /// When the solver gives up.
    pub fn on_springs(&self) -> Result<Self, NoAnswer> {
        let stiffness = self.scene.stiffness * largest_area(&self.points) / REFERENCE_AREA;
        let forces = shared(self.scene, &self.points, stiffness).ok_or(NoAnswer::Unsolved)?;
        Ok(Self { forces, ..self.clone() })
    }

    /// Whether the tower of `scene` can rest at all.
    ///
    /// # Errors
    /// When it cannot.
    pub fn stands(scene: &Scene) -> Result<(), NoAnswer> {
        held(scene).map(|_| ())
    }

    /// The least work against the gaps, J: by duality how far the weights have come down, sum m g times distance.
    pub fn work(&self) -> f64 {
        self.work
    }

    /// How far each centre is above where it was built, and its tilts along x and y: m, 1, 1.
    ///
    /// # Errors
    /// When the solver gives up.
    pub fn settled(&self) -> Result<Vec<DVec3>, NoAnswer> {
        let blocks = &self.scene.blocks;
        let mut problem = Problem::new(OptimizationDirection::Minimize);
        let free = (f64::NEG_INFINITY, f64::INFINITY);
        let unknowns: Vec<[Variable; 3]> = blocks
            .iter()
            .map(|b| [b.mass * self.scene.gravity, 0.0, 0.0].map(|weight| problem.add_var(weight, free)))
            .collect();
        for point in &self.points {
            let mut row = LinearExpr::empty();
            point.acts(|body, sign| {
                let lever = point.lever(&blocks[body]);
                for (&unknown, factor) in unknowns[body].iter().zip([1.0, lever.x, lever.y]) {
                    row.add(unknown, sign * factor);
                }
            });
            problem.add_constraint(row, ComparisonOp::Ge, -point.gap / UNIT);
        }
        let solution = solve(problem)?;
        let values =
            unknowns.iter().map(|u| DVec3::from(u.map(|v| solution.var_value(v))) * DVec3::new(UNIT, 1.0, 1.0));
        Ok(values.collect())
    }

    /// Height of the highest corner, m.
    ///
    /// # Errors
    /// When the solver gives up.
    pub fn top(&self) -> Result<f64, NoAnswer> {
        let corner = |(block, moved): (&Block, DVec3)| {
            let tilt = DVec2::new(moved.y, moved.z);
            let rise = corners(block).into_iter().map(|p| tilt.dot(p - center(block))).fold(0.0, f64::max);
            top(block) + moved.x + rise
        };
        Ok(self.scene.blocks.iter().zip(self.settled()?).map(corner).fold(0.0, f64::max))
    }

    /// The regions in which blocks touch, with their loads.
    pub fn patches(&self) -> Vec<Patch> {
        let mut patches: Vec<Patch> = Vec::new();
        for (point, &force) in self.points.iter().zip(&self.forces) {
            if patches.len() <= point.region {
                patches.push(Patch { below: point.below, above: point.above, lever: point.lever, corners: Vec::new() });
            }
            patches[point.region].corners.push((point.place, force));
        }
        patches
    }

    /// Normal force on the lower face of a block, N.
    pub fn force_below(&self, block: usize) -> f64 {
        self.sum(|p| p.above == block)
    }

    /// Normal force on the upper face of a block, N.
    pub fn force_above(&self, block: usize) -> f64 {
        self.sum(|p| p.below == Some(block))
    }

    fn sum(&self, of: impl Fn(&Point) -> bool) -> f64 {
        self.points.iter().zip(&self.forces).filter(|(p, _)| of(p)).map(|(_, f)| f).sum()
    }

    /// Both answers for a block.
    ///
    /// # Errors
    /// When the solver gives up.
    pub fn answer(&self, block: usize) -> Result<Answer, NoAnswer> {
        let straight_n = self.straight_pull(block);
        // nothing that lies on it can turn
        let turning_n = if self.force_above(block) < NONE { straight_n } else { self.turning_pull(block)? };
        Ok(Answer { straight_n, turning_n, tipping_n: self.tipping_pull(block) })
    }

    /// The least force along its long axis, either way, at which the tower begins to rock, N.
    pub fn tipping_pull(&self, block: usize) -> Option<f64> {
        let blocks = &self.scene.blocks;
        let (axis, pulled) = (long_axis(&blocks[block]), &blocks[block]);
        let mut least: Option<f64> = None;
        for cut in blocks.iter().map(bottom).filter(|&cut| cut < pulled.pos[2]) {
            let above = |i: usize| bottom(&blocks[i]) > cut - NEAR;
            let bears = |p: &Point| above(p.above) && !p.below.is_some_and(above);
            let (mut weight, mut moment) = (0.0, DVec2::ZERO);
            for block in blocks.iter().filter(|b| bottom(b) > cut - NEAR) {
                weight += block.mass;
                moment += block.mass * center(block);
            }
            let loaded =
                self.points.iter().zip(&self.forces).filter(|&(p, &f)| bears(p) && f > NONE).map(|(p, _)| p.place);
            let region = hull(&loaded.collect::<Vec<_>>());
            for direction in [axis, -axis] {
                let way = way_within(&region, moment / weight, direction).unwrap_or(0.0);
                let force = way * weight * self.scene.gravity / (pulled.pos[2] - cut);
                least = Some(least.map_or(force, |l| l.min(force)));
            }
        }
        least
    }

    /// The force along its long axis that starts a block sliding when what lies on it may turn, N.
    ///
    /// # Errors
    /// When the solver gives up.
    pub fn turning_pull(&self, block: usize) -> Result<f64, NoAnswer> {
        let blocks = &self.scene.blocks;
        let mut problem = Problem::new(OptimizationDirection::Maximize);
        let pull = problem.add_var(1.0, (0.0, f64::INFINITY));
        // force along x, along y, moment about z
        let mut rows: Vec<[LinearExpr; 3]> =
            blocks.iter().map(|_| std::array::from_fn(|_| LinearExpr::empty())).collect();
        let axis = long_axis(&blocks[block]);
        rows[block][0].add(pull, axis.x);
        rows[block][1].add(pull, axis.y);
        let places = self.friction_places();
        for ((point, &force), place) in self.points.iter().zip(&self.forces).zip(places) {
            let most = self.scene.friction * force;
            if most < NONE {
                continue;
            }
            let point = Point { place, ..*point };
            let mut share = LinearExpr::empty();
            for i in 0..DIRECTIONS {
                let (sin, cos) = libm::sincos(std::f64::consts::TAU * i as f64 / DIRECTIONS as f64);
                let direction = DVec2::new(cos, sin);
                let friction = problem.add_var(0.0, (0.0, f64::INFINITY));
                share.add(friction, 1.0);
                point.acts(|body, sign| {
                    let turn = point.lever(&blocks[body]).perp_dot(direction);
                    for (row, factor) in rows[body].iter_mut().zip([direction.x, direction.y, turn]) {
                        row.add(friction, sign * factor);
                    }
                });
            }
            problem.add_constraint(share, ComparisonOp::Le, most);
        }
        for row in rows.into_iter().flatten() {
            problem.add_constraint(row, ComparisonOp::Eq, 0.0);
        }
        Ok(solve(problem)?.var_value(pull))
    }

    /// Where the friction of each point acts, m: around the centre of pressure of its region, nearer by the lever of torsion.
    fn friction_places(&self) -> Vec<DVec2> {
        let count = self.points.last().map_or(0, |p| p.region + 1);
        let mut sums = vec![(0.0, DVec2::ZERO); count];
        for (point, &force) in self.points.iter().zip(&self.forces) {
            let (total, moment) = &mut sums[point.region];
            *total += force;
            *moment += point.place * force;
        }
        let place = |point: &Point| {
            let (total, moment) = sums[point.region];
            if total < NONE {
                return point.place;
            }
            let center = moment / total;
            center + (point.place - center) * point.lever
        };
        self.points.iter().map(place).collect()
    }

    /// The same if it cannot turn: mu (N below + the lesser of N above and of N above its row mates), N.
    pub fn straight_pull(&self, block: usize) -> f64 {
        let blocks = &self.scene.blocks;
        let mates =
            (0..blocks.len()).filter(|&j| j != block && (bottom(&blocks[j]) - bottom(&blocks[block])).abs() < NEAR);
        self.scene.friction
            * (self.force_below(block) + self.force_above(block).min(mates.map(|j| self.force_above(j)).sum()))
    }
}

impl Point {
    /// Calls `act` for each body that the force acts on, with its sign: up on the upper one.
    fn acts(&self, mut act: impl FnMut(usize, f64)) {
        act(self.above, 1.0);
        if let Some(below) = self.below {
            act(below, -1.0);
        }
    }

    /// From the centre of a block, in units of the programme.
    fn lever(&self, block: &Block) -> DVec2 {
        (self.place - center(block)) / UNIT
    }
}

fn solve(problem: Problem) -> Result<microlp::Solution, NoAnswer> {
    let solved = problem
        .solve()
        .map_err(|e| if e == microlp::Error::Infeasible { NoAnswer::Falls } else { NoAnswer::Unsolved })?;
    solved.into_solution().map_err(|_| NoAnswer::Unsolved)
}

/// The points at which blocks may touch, and the least work of forces that hold every block in equilibrium, J.
fn held(scene: &Scene) -> Result<(Vec<Point>, f64), NoAnswer> {
    let points = touching(&scene.blocks);
    let mut problem = Problem::new(OptimizationDirection::Minimize);
    let forces: Vec<Variable> = points.iter().map(|p| problem.add_var(p.gap / UNIT, (0.0, f64::INFINITY))).collect();
    let mut rows: Vec<[LinearExpr; 3]> =
        scene.blocks.iter().map(|_| std::array::from_fn(|_| LinearExpr::empty())).collect();
    for (point, &force) in points.iter().zip(&forces) {
        point.acts(|body, sign| {
            let lever = point.lever(&scene.blocks[body]);
            for (row, factor) in rows[body].iter_mut().zip([1.0, lever.x, lever.y]) {
                row.add(force, sign * factor);
            }
        });
    }
    for (block, rows) in scene.blocks.iter().zip(rows) {
        for (row, load) in rows.into_iter().zip([block.mass * scene.gravity, 0.0, 0.0]) {
            problem.add_constraint(row, ComparisonOp::Eq, load);
        }
    }
    let solution = solve(problem)?;
    Ok((points, UNIT * solution.objective()))
}

/// Largest area of a point, m².
fn largest_area(points: &[Point]) -> f64 {
    points.iter().map(|p| p.area).fold(0.0, f64::max)
}

/// Normal forces at the points, N, as springs share them of which that on the largest area has the `stiffness`, N/m.
fn shared(scene: &Scene, points: &[Point], stiffness: f64) -> Option<Vec<f64>> {
    let weights: Vec<f64> = scene.blocks.iter().flat_map(|b| [b.mass * scene.gravity, 0.0, 0.0]).collect();
    let reference = largest_area(points);
    let spring = |point: &Point| {
        let mut acts = Vec::new();
        point.acts(|body, sign| {
            let lever = point.lever(&scene.blocks[body]);
            acts.extend([(3 * body, sign), (3 * body + 1, sign * lever.x), (3 * body + 2, sign * lever.y)]);
        });
        Spring { acts, gap: point.gap, share: point.area / reference }
    };
    // each block lower than where it was built, and against the one below it by more than heights differ
    let start = scene.blocks.iter().flat_map(|b| [-PRESSED * top(b), 0.0, 0.0]).collect();
    stiff::forces(&points.iter().map(spring).collect::<Vec<_>>(), &weights, start, stiffness)
}

/// Every point at which blocks may touch.
fn touching(blocks: &[Block]) -> Vec<Point> {
    let mut points = Vec::new();
    let mut regions = 0;
    for (above, block) in blocks.iter().enumerate() {
        let lower =
            (0..blocks.len()).filter(|&i| i != above && (bottom(block) - top(&blocks[i])).abs() < NEAR).map(Some);
        let floor = (bottom(block) < NEAR).then_some(None);
        for below in lower.chain(floor) {
            let (region, base) = match below.map(|i| &blocks[i]) {
                Some(other) => (overlap(block, other), top(other)),
                None => (corners(block), 0.0),
            };
            let gap = bottom(block) - base;
            if region.is_empty() {
                continue;
            }
            let (area, lever, number) = (area(&region) / region.len() as f64, lever(&region), regions);
            regions += 1;
            points.extend(region.into_iter().map(|place| Point {
                below,
                above,
                place,
                gap,
                area,
                region: number,
                lever,
            }));
        }
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;
    use teeter_scene::{BlockPreset, NAMED, Stability, TowerOptions, config, named, tower};

    /// Near the end the energies of two steps are the same number, and a search that compares them stopped short in one official tower of twelve.
    #[test]
    fn a_full_tower_is_solved_whatever_its_seed() {
        let official = [4, 8, 29, 39, 52].map(|seed| (BlockPreset::Official, seed));
        for (block, seed) in official.into_iter().chain([(BlockPreset::Dissertation, 54)]) {
            let scene = tower(&TowerOptions { block, seed, ..TowerOptions::default() }).unwrap();
            let rigid = Rigid::new(&scene).unwrap();
            let weight: f64 = scene.blocks[3..].iter().map(|b| b.mass * scene.gravity).sum();
            let borne: f64 = (0..3).map(|i| rigid.force_above(i)).sum();
            assert!(
                (borne / weight - 1.0).abs() < 1e-5,
                "{block}, seed {seed}: the lowest row bears {borne} of {weight} N"
            );
        }
    }

    /// A block 1 µm lower than its neighbours carries nothing under rigid blocks, and its share of the load, less 1 µm of stiffness, on springs.
    #[test]
    fn a_block_lower_by_less_than_contacts_give_bears_on_springs() {
        let mut scene = config("(111)-(111)", &TowerOptions::exact()).unwrap();
        let low = 1e-6;
        scene.blocks[1].size[2] -= low;
        scene.blocks[1].pos[2] -= 0.5 * low;
        let rigid = Rigid::new(&scene).unwrap();
        assert!(rigid.force_above(1) < 1e-6);
        for k in [3e5, 3e6] {
            let scene = Scene { stiffness: k, ..scene.clone() };
            let rigid = Rigid::new(&scene).unwrap();
            let springs = rigid.on_springs().unwrap();
            let weight = 3.0 * scene.blocks[0].mass * scene.gravity;
            // three springs under the weight of a row, of which the middle is shorter; 9 patches above, and as much give on the floor, three times the area
            let own = 1.0
                / (1.0 / (3.0 * k) + 1.0 / (k * scene.blocks[1].size[0] * scene.blocks[1].size[1] / REFERENCE_AREA));
            let expected = ((weight - 2.0 * own * low) / 3.0).max(0.0);
            let force = springs.force_above(1);
            assert!((force - expected).abs() < 0.01 * weight, "{k:e}: {force} instead of {expected}");
            let all = springs.force_above(0) + force + springs.force_above(2);
            assert!((all / weight - 1.0).abs() < 1e-4);
        }
    }

    #[test]
    fn a_block_of_a_column_takes_all_above_it_along() {
        let scene = named("column").unwrap();
        let weight = scene.blocks[0].mass * scene.gravity;
        let rigid = Rigid::new(&scene).unwrap();
        for i in 0..10 {
            let expected = scene.friction * weight * (10 - i) as f64;
            let answer = rigid.answer(i).unwrap();
            // forces balance to 1e-7 of a block's weight
            assert!((answer.straight_n / expected - 1.0).abs() < 1e-6);
            // pulls along x, which is a corner of the polygon
            assert!((answer.turning_n / expected - 1.0).abs() < 1e-6, "{i}: {answer:?} instead of {expected}");
            // 7 mu m g at the middle of the fourth block against m g times half a length at the lowest
            let tipping = 10.0 * weight * 0.0405 / (0.018 * (i as f64 + 0.5));
            let tipping = (0..i)
                .map(|j| (10 - j) as f64 * weight * 0.0405 / (0.018 * ((i - j) as f64 + 0.5)))
                .fold(tipping, f64::min);
            assert!((answer.tipping_n.unwrap() / tipping - 1.0).abs() < 1e-6, "{i}: {answer:?} instead of {tipping}");
            assert_eq!(answer.is_exact(), tipping > expected);
        }
        assert!((rigid.top().unwrap() - 0.18).abs() < 1e-9);
    }

    #[test]
    fn forces_and_places_of_the_tower_are_duals() {
        let scene = tower(&TowerOptions::default()).unwrap();
        let rigid = Rigid::new(&scene).unwrap();
        let come_down: f64 =
            scene.blocks.iter().zip(rigid.settled().unwrap()).map(|(b, moved)| -b.mass * scene.gravity * moved.x).sum();
        assert!(come_down > 1e-5 && (come_down / rigid.work() - 1.0).abs() < 1e-6);
        // what the springs make of it is another of the optimal answers
        let work: f64 = rigid.points.iter().zip(&rigid.forces).map(|(p, f)| p.gap * f).sum();
        assert!((work / rigid.work() - 1.0).abs() < 1e-5, "{work:e} instead of {:e} J", rigid.work());
    }

    #[test]
    fn turning_makes_a_pull_easier_never_harder() {
        let scene = tower(&TowerOptions::default()).unwrap();
        let rigid = Rigid::new(&scene).unwrap();
        for i in (0..54).step_by(5) {
            let Answer { turning_n: pull, straight_n: straight, .. } = rigid.answer(i).unwrap();
            assert!(pull < straight + 1e-6 && pull > 0.3 * straight, "{i}: {pull} against {straight}");
        }
        // a block of the top row holds only itself
        let own = scene.friction * scene.blocks[53].mass * scene.gravity;
        assert!((rigid.answer(53).unwrap().straight_n / own - 1.0).abs() < 1e-9);
        assert!((rigid.turning_pull(53).unwrap() / own - 1.0).abs() < 5e-3);
    }

    #[test]
    fn forces_on_each_block_hold_its_weight() {
        let scene = named("midgame").unwrap();
        let rigid = Rigid::new(&scene).unwrap();
        for (i, block) in scene.blocks.iter().enumerate() {
            let lift = rigid.force_below(i) - rigid.force_above(i);
            assert!((lift / (block.mass * scene.gravity) - 1.0).abs() < 1e-6);
        }
    }

    #[test]
    fn what_falls_has_no_answer() {
        for entry in NAMED.iter().filter(|n| n.expect.is_some()) {
            let scene = entry.scene();
            let rests = Rigid::new(&scene);
            assert_eq!(
                rests.err(),
                (entry.expect == Some(Stability::Unstable)).then_some(NoAnswer::Falls),
                "{}",
                entry.name
            );
        }
    }

    #[test]
    fn two_of_three_carry_what_lies_on_them_half_and_half() {
        let scene = config("(1L1)-(010)", &TowerOptions::exact()).unwrap();
        let rigid = Rigid::new(&scene).unwrap();
        let weight = scene.blocks[0].mass * scene.gravity;
        for (block, above) in [(0, 0.5), (1, 0.0), (2, 0.5)] {
            assert!((rigid.force_above(block) - above * weight).abs() < 1e-9);
        }
        assert!((rigid.straight_pull(0) / (scene.friction * weight) - 2.0).abs() < 1e-9);
    }
}

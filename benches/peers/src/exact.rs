//! The exact answer for rigid blocks, by linear programming.
//!
//! *Where they lie.* The blocks come down as far as they can: min sum m g z over heights and small tilts, subject to no overlap at the corners of
//! each overlap rectangle. The normal forces are the duals of that; here the dual itself is solved: of all forces that hold every block in
//! equilibrium, those that do the least work against the gaps.
//!
//! *When a block slides.* With those normal forces N, the pull is the largest force along the long axis for which friction of at most mu N at each
//! corner can keep every block from sliding and turning in the plane (limit analysis; exact for normal forces that stay as they are).
//!
//! Tight blocks have no single answer: friction can turn what lies on them or keep it straight, it tilts blocks and so shifts normal forces, and what
//! it held back while the tower settled stays in it. Loose ones have: nothing presses on them.

use glam::{DVec2, DVec3};
use microlp::{ComparisonOp, LinearExpr, OptimizationDirection, Problem, Variable};
use teeter_scene::{Block, Scene};

/// Blocks nearer than this above one another may touch, m.
const NEAR: f64 = 2e-3;
/// Lengths in the programmes are in this unit, m, so that all their numbers are near 1.
const UNIT: f64 = 1e-2;
/// Corners of the polygon that stands for the circle of friction: the forces are at most 0.5 % low.
const DIRECTIONS: usize = 32;

/// A corner at which two blocks, or a block and the floor, may touch.
struct Point {
    below: Option<usize>,
    above: usize,
    place: DVec2,
    gap: f64,
}

/// A tower of rigid blocks at rest.
pub struct Rigid<'a> {
    scene: &'a Scene,
    points: Vec<Point>,
    /// Normal force at each point, N.
    forces: Vec<f64>,
}

impl<'a> Rigid<'a> {
    /// The tower of `scene`, whose blocks lie along x or y.
    ///
    /// # Panics
    /// When it cannot stand: the bench is about towers that do.
    pub fn new(scene: &'a Scene) -> Self {
        let points = touching(&scene.blocks);
        let mut problem = Problem::new(OptimizationDirection::Minimize);
        let forces: Vec<Variable> = points.iter().map(|p| problem.add_var(p.gap / UNIT, (0.0, f64::INFINITY))).collect();
        let mut rows: Vec<[LinearExpr; 3]> = scene.blocks.iter().map(|_| std::array::from_fn(|_| LinearExpr::empty())).collect();
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
        let solution = solve(problem);
        let forces = forces.into_iter().map(|f| solution.var_value(f).max(0.0)).collect();
        Self { scene, points, forces }
    }

    /// Work of the forces against the gaps, J: how far the weights have come down, by duality.
    #[cfg(test)]
    fn work(&self) -> f64 {
        self.points.iter().zip(&self.forces).map(|(p, f)| p.gap * f).sum()
    }

    /// How far each centre is above where it was built, and its tilts along x and y: m, 1, 1.
    fn settled(&self) -> Vec<DVec3> {
        let blocks = &self.scene.blocks;
        let mut problem = Problem::new(OptimizationDirection::Minimize);
        let free = (f64::NEG_INFINITY, f64::INFINITY);
        let unknowns: Vec<[Variable; 3]> =
            blocks.iter().map(|b| [b.mass * self.scene.gravity, 0.0, 0.0].map(|weight| problem.add_var(weight, free))).collect();
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
        let solution = solve(problem);
        let values = unknowns.iter().map(|u| DVec3::from(u.map(|v| solution.var_value(v))) * DVec3::new(UNIT, 1.0, 1.0));
        values.collect()
    }

    /// Height of the highest corner, m.
    pub fn top(&self) -> f64 {
        let corner = |(block, moved): (&Block, DVec3)| {
            let tilt = moved.y.abs() * half(block).x + moved.z.abs() * half(block).y;
            top(block) + moved.x + tilt
        };
        self.scene.blocks.iter().zip(self.settled()).map(corner).fold(0.0, f64::max)
    }

    /// The force along its long axis that starts a block sliding, N.
    pub fn pull(&self, block: usize) -> f64 {
        let blocks = &self.scene.blocks;
        let mut problem = Problem::new(OptimizationDirection::Maximize);
        let pull = problem.add_var(1.0, (0.0, f64::INFINITY));
        // force along x, along y, moment about z
        let mut rows: Vec<[LinearExpr; 3]> = blocks.iter().map(|_| std::array::from_fn(|_| LinearExpr::empty())).collect();
        let axis = long_axis(&blocks[block]);
        rows[block][0].add(pull, axis.x);
        rows[block][1].add(pull, axis.y);
        for (point, &force) in self.points.iter().zip(&self.forces) {
            let most = self.scene.friction * force;
            if most < 1e-9 {
                continue;
            }
            let mut share = LinearExpr::empty();
            for i in 0..DIRECTIONS {
                let direction = DVec2::from_angle(std::f64::consts::TAU * i as f64 / DIRECTIONS as f64);
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
        solve(problem).var_value(pull)
    }

    /// The same if what lies on the block could only slide along, not turn: mu (N below + the lesser of N above and of N above its row mates), N.
    pub fn straight_pull(&self, block: usize) -> f64 {
        let blocks = &self.scene.blocks;
        let on = |i: usize, side: fn(&Point) -> Option<usize>| -> f64 {
            self.points.iter().zip(&self.forces).filter(|(p, _)| side(p) == Some(i)).map(|(_, f)| f).sum()
        };
        let above = |i: usize| on(i, |p| p.below);
        let mates = (0..blocks.len()).filter(|&j| j != block && (bottom(&blocks[j]) - bottom(&blocks[block])).abs() < NEAR);
        self.scene.friction * (on(block, |p| Some(p.above)) + above(block).min(mates.map(above).sum()))
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

/// Direction of the long axis of a block.
pub fn long_axis(block: &Block) -> DVec3 {
    DVec3::new(block.yaw.cos(), block.yaw.sin(), 0.0)
}

fn solve(problem: Problem) -> microlp::Solution {
    let solved = problem.solve().expect("the programme has an answer if the tower stands");
    solved.into_solution().expect("nothing limits the time of the solver")
}

/// Every point at which blocks may touch.
fn touching(blocks: &[Block]) -> Vec<Point> {
    let mut points = Vec::new();
    for (above, block) in blocks.iter().enumerate() {
        let lower = (0..blocks.len()).filter(|&i| (bottom(block) - top(&blocks[i])).abs() < NEAR).map(Some);
        let floor = (bottom(block) < NEAR).then_some(None);
        for below in lower.chain(floor) {
            let (mut low, mut high) = (center(block) - half(block), center(block) + half(block));
            let mut gap = bottom(block);
            if let Some(other) = below.map(|i| &blocks[i]) {
                (low, high) = (low.max(center(other) - half(other)), high.min(center(other) + half(other)));
                gap -= top(other);
            }
            if (high - low).cmpgt(DVec2::splat(1e-6)).all() {
                let corners = [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)];
                points.extend(corners.map(|place| Point { below, above, place, gap }));
            }
        }
    }
    points
}

fn center(block: &Block) -> DVec2 {
    DVec3::from(block.pos).truncate()
}

/// Half of the lengths of a block along x and y.
fn half(block: &Block) -> DVec2 {
    let along = long_axis(block).truncate();
    assert!(along.abs().max_element() > 1.0 - 1e-9, "a block lies askew");
    along.abs().round() * 0.5 * block.size[0] + along.perp().abs().round() * 0.5 * block.size[1]
}

fn top(block: &Block) -> f64 {
    block.pos[2] + 0.5 * block.size[2]
}

fn bottom(block: &Block) -> f64 {
    block.pos[2] - 0.5 * block.size[2]
}

#[cfg(test)]
mod tests {
    use super::*;
    use teeter_scene::{TowerOptions, named, tower};

    #[test]
    fn a_block_of_a_column_takes_all_above_it_along() {
        let scene = named("column").unwrap();
        let weight = scene.blocks[0].mass * scene.gravity;
        let rigid = Rigid::new(&scene);
        for i in 0..10 {
            let expected = scene.friction * weight * (10 - i) as f64;
            assert!((rigid.straight_pull(i) / expected - 1.0).abs() < 1e-9);
            // pulls along x, which is a corner of the polygon
            let pull = rigid.pull(i);
            assert!((pull / expected - 1.0).abs() < 1e-6, "{i}: {pull} instead of {expected}");
        }
        assert!((rigid.top() - 0.18).abs() < 1e-9);
    }

    #[test]
    fn forces_and_places_of_the_tower_are_duals() {
        let scene = tower(&TowerOptions::default()).unwrap();
        let rigid = Rigid::new(&scene);
        let come_down: f64 = scene.blocks.iter().zip(rigid.settled()).map(|(b, moved)| -b.mass * scene.gravity * moved.x).sum();
        assert!(come_down > 1e-5 && (come_down / rigid.work() - 1.0).abs() < 1e-6);
    }

    #[test]
    fn turning_makes_a_pull_easier_never_harder() {
        let scene = tower(&TowerOptions::default()).unwrap();
        let rigid = Rigid::new(&scene);
        for i in (0..54).step_by(5) {
            let (pull, straight) = (rigid.pull(i), rigid.straight_pull(i));
            assert!(pull < straight + 1e-6 && pull > 0.3 * straight, "{i}: {pull} against {straight}");
        }
        // a block of the top row holds only itself
        let own = scene.friction * scene.blocks[53].mass * scene.gravity;
        assert!((rigid.pull(53) / own - 1.0).abs() < 5e-3);
    }
}

//! Equilibrium of rigid blocks with friction at each point, on a level or a tilted floor.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};
use microlp::{ComparisonOp, LinearExpr, OptimizationDirection, Problem, Variable};
use teeter_scene::{Block, Scene};

use super::contact_point::{ContactPoint, contact_points};
use super::equilibrium::{MAX_GAP, require_upright};
use super::error::LimitError;
use super::program::{UNIT, solve};
use super::tower::RigidTower;
use crate::plan::bottom;

/// Corners of the polygon inscribed in the circle of friction of a tilted tower, one of them in the
/// direction of the tilt, so that sliding along it is exact; elsewhere forces are at most 2 % low.
const INSCRIBED: usize = 16;
/// Corners of the polygon around the circle of friction of a level tower: forces are at most 8 %
/// high.
const AROUND: usize = 8;
/// Tangent of the largest tilt, 60 degrees.
const MAX_TANGENT: f64 = 1.732_050_807_568_877_2;

impl RigidTower<'_> {
    /// Returns the angle, in degrees, at which the blocks of `scene` can no longer rest on a floor
    /// that is tilted towards `azimuth`, rad about z from x; 60 where they always can.
    ///
    /// Blocks that touch as built bear each other. The angle is exact where they topple and an
    /// upper bound where they slide.
    ///
    /// # Errors
    /// When the tower does not rest on a level floor, a block is tilted or fixed in the air, or the
    /// solver gives up.
    ///
    /// ```
    /// # use teeter_study::RigidTower;
    /// let scene = teeter_scene::named("block").unwrap();
    /// let angle = RigidTower::tilt(&scene, 0.3)?;
    /// // the block slides at the angle of friction
    /// assert!((angle.to_radians().tan() - scene.friction).abs() < 1e-6);
    /// # Ok::<(), teeter_study::LimitError>(())
    /// ```
    pub fn tilt(scene: &Scene, azimuth: f64) -> Result<f64, LimitError> {
        require_upright(scene)?;
        let directions = directions(azimuth, INSCRIBED);
        let mut programme = Programme::new(scene, scene.friction, &directions, 0.0);
        let tangent = programme.problem.add_var(1.0, (0.0, MAX_TANGENT));
        let DVec2 { x, y } = directions[0];
        // Gravity over the cosine of the tilt: weight down, and weight times the tangent downhill.
        let load = |weight| ([weight * x, weight * y, 0.0, 0.0, 0.0, 0.0], [0.0, 0.0, weight, 0.0, 0.0, 0.0]);
        programme.hold(scene, load, tangent);
        Ok(libm::atan(solve(programme.problem)?.var_value(tangent)).to_degrees())
    }
}

/// Returns true if no friction and normal forces hold every block of an upright tower, on edges of
/// support moved inwards by `inset`, m.
///
/// Forces can be scaled, so a tower that bears any share of its weight bears all of it. The cone of
/// friction is a pyramid around it: what falls with more friction falls.
///
/// # Errors
/// When the solver gives up.
pub(super) fn falls(scene: &Scene, inset: f64) -> Result<bool, LimitError> {
    let friction = scene.friction / libm::cos(PI / AROUND as f64);
    let mut programme = Programme::new(scene, friction, &directions(0.0, AROUND), inset);
    let share = programme.problem.add_var(1.0, (0.0, 1.0));
    programme.hold(scene, |weight| ([0.0, 0.0, -weight, 0.0, 0.0, 0.0], [0.0; 6]), share);
    Ok(solve(programme.problem)?.var_value(share) < 0.5)
}

/// Unit vectors evenly around the circle, the first at `azimuth`, rad.
fn directions(azimuth: f64, count: usize) -> Vec<DVec2> {
    let direction = |i: usize| {
        let (sin, cos) = libm::sincos(azimuth + TAU * i as f64 / count as f64);
        DVec2::new(cos, sin)
    };
    (0..count).map(direction).collect()
}

/// Forces of a programme: a normal force a point, and friction along each direction.
struct PointForces {
    normal: Variable,
    friction: Vec<Variable>,
}

/// Linear programme of the forces that hold a tower.
struct Programme {
    problem: Problem,
    /// Force and moment of the contacts on each block.
    rows: Vec<[LinearExpr; 6]>,
}

impl Programme {
    fn new(scene: &Scene, friction: f64, directions: &[DVec2], inset: f64) -> Self {
        let mut points = contact_points(&scene.blocks, inset);
        points.retain(|point| point.gap.abs() <= MAX_GAP);
        let mut problem = Problem::new(OptimizationDirection::Maximize);
        let free = (0.0, f64::INFINITY);
        let forces: Vec<PointForces> = points
            .iter()
            .map(|_| PointForces {
                normal: problem.add_var(0.0, free),
                friction: directions.iter().map(|_| problem.add_var(0.0, free)).collect(),
            })
            .collect();
        for force in &forces {
            let mut sum = LinearExpr::empty();
            force.friction.iter().for_each(|&friction| sum.add(friction, 1.0));
            sum.add(force.normal, -friction);
            problem.add_constraint(sum, ComparisonOp::Le, 0.0);
        }
        let rows = balance(&scene.blocks, &points, &forces, directions);
        Self { problem, rows }
    }

    /// Requires that the forces on each block that can move balance a load: by its weight (N),
    /// coefficients of the `unknown` and a constant.
    fn hold(&mut self, scene: &Scene, load: impl Fn(f64) -> ([f64; 6], [f64; 6]), unknown: Variable) {
        let rows = std::mem::take(&mut self.rows);
        for (block, rows) in scene.blocks.iter().zip(rows).filter(|(block, _)| !block.fixed) {
            let (coefficients, constants) = load(block.mass * scene.gravity);
            for ((mut row, coefficient), constant) in rows.into_iter().zip(coefficients).zip(constants) {
                row.add(unknown, coefficient);
                self.problem.add_constraint(row, ComparisonOp::Eq, constant);
            }
        }
    }
}

/// Force and moment of the contacts on each block: along x, y and z, and about them.
fn balance(
    blocks: &[Block],
    points: &[ContactPoint],
    forces: &[PointForces],
    directions: &[DVec2],
) -> Vec<[LinearExpr; 6]> {
    let mut rows: Vec<[LinearExpr; 6]> = blocks.iter().map(|_| std::array::from_fn(|_| LinearExpr::empty())).collect();
    for (point, force) in points.iter().zip(forces) {
        let height = bottom(&blocks[point.above]);
        point.for_each_body(|body, sign| {
            let arm = point.lever_arm(&blocks[body]).extend((height - blocks[body].pos[2]) / UNIT);
            let mut add = |variable: Variable, direction: DVec3| {
                let moment = arm.cross(direction);
                for (row, factor) in
                    rows[body].iter_mut().zip(direction.to_array().into_iter().chain(moment.to_array()))
                {
                    if factor != 0.0 {
                        row.add(variable, sign * factor);
                    }
                }
            };
            add(force.normal, DVec3::Z);
            for (&friction, direction) in force.friction.iter().zip(directions) {
                add(friction, direction.extend(0.0));
            }
        });
    }
    rows
}

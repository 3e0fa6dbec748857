//! Limit analysis of friction in the plane.

use glam::DVec2;
use microlp::{ComparisonOp, LinearExpr, OptimizationDirection, Problem};

use super::contact_point::{ContactPoint, MIN_FORCE};
use super::error::LimitError;
use super::program::{balance_rows, solve};
use super::tower::RigidTower;
use crate::plan::long_axis;

/// Corners of the polygon inscribed in the circle of friction: forces are at most 0.5 % low.
const DIRECTIONS: usize = 32;

impl RigidTower<'_> {
    /// Returns the force along its long axis that starts a block sliding when blocks may turn, N.
    ///
    /// # Errors
    /// When the solver gives up.
    ///
    /// # Panics
    /// When the tower has no block of that index.
    pub fn turning_force(&self, block: usize) -> Result<f64, LimitError> {
        let blocks = &self.scene.blocks;
        let mut problem = Problem::new(OptimizationDirection::Maximize);
        let pull = problem.add_var(1.0, (0.0, f64::INFINITY));
        // force along x, force along y, moment about z
        let mut rows = balance_rows(blocks.len());
        let axis = long_axis(&blocks[block]);
        rows[block][0].add(pull, axis.x);
        rows[block][1].add(pull, axis.y);
        let positions = self.friction_positions();
        for ((point, &force), position) in self.points.iter().zip(&self.forces).zip(positions) {
            let max_friction = self.scene.friction * force;
            if max_friction < MIN_FORCE {
                continue;
            }
            let point = ContactPoint { position, ..*point };
            let mut sum = LinearExpr::empty();
            for i in 0..DIRECTIONS {
                let (sin, cos) = libm::sincos(std::f64::consts::TAU * i as f64 / DIRECTIONS as f64);
                let direction = DVec2::new(cos, sin);
                let friction = problem.add_var(0.0, (0.0, f64::INFINITY));
                sum.add(friction, 1.0);
                point.for_each_body(|body, sign| {
                    let moment = point.lever_arm(&blocks[body]).perp_dot(direction);
                    for (row, factor) in rows[body].iter_mut().zip([direction.x, direction.y, moment]) {
                        row.add(friction, sign * factor);
                    }
                });
            }
            problem.add_constraint(sum, ComparisonOp::Le, max_friction);
        }
        for row in rows.into_iter().flatten() {
            problem.add_constraint(row, ComparisonOp::Eq, 0.0);
        }
        Ok(solve(problem)?.var_value(pull))
    }

    /// Position of the friction of each point, m: drawn towards the centre of pressure of its
    /// region by the torsion ratio.
    fn friction_positions(&self) -> Vec<DVec2> {
        let count = self.points.last().map_or(0, |p| p.region + 1);
        let mut sums = vec![(0.0, DVec2::ZERO); count];
        for (point, &force) in self.points.iter().zip(&self.forces) {
            let (total, moment) = &mut sums[point.region];
            *total += force;
            *moment += point.position * force;
        }
        let position = |point: &ContactPoint| {
            let (total, moment) = sums[point.region];
            if total < MIN_FORCE {
                return point.position;
            }
            let center = moment / total;
            center + (point.position - center) * point.torsion_ratio
        };
        self.points.iter().map(position).collect()
    }
}

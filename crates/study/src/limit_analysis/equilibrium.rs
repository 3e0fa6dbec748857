//! Equilibrium of rigid blocks: normal forces and displacements.

use glam::DVec3;
use microlp::{ComparisonOp, LinearExpr, OptimizationDirection, Problem, Variable};
use teeter_scene::Scene;

use super::contact_point::{ContactPoint, contact_points, max_area};
use super::error::LimitError;
use super::program::{UNIT, balance_rows, solve};
use crate::plan::{bottom, is_upright, top};
use crate::stiff_limit::{self, Spring};

/// Share of its height by which a tower is compressed where the search for its forces begins: more
/// than heights differ, so that all springs push.
const COMPRESSION: f64 = 0.05;

/// Gap up to which a block stands on the floor, m.
pub(super) const MAX_GAP: f64 = 2e-5;

/// Checks that no block is tilted, or fixed in the air.
///
/// # Errors
/// Names the first one that is.
pub(super) fn require_upright(scene: &Scene) -> Result<(), LimitError> {
    for block in &scene.blocks {
        // On the floor a fixed block bears its load as one that can move does.
        let hangs = block.fixed && bottom(block) > MAX_GAP;
        if hangs || !is_upright(block) {
            let state = if hangs { "fixed above the floor" } else { "tilted" };
            return Err(LimitError::Unsuitable { id: block.id, state });
        }
    }
    Ok(())
}

/// Returns the points at which blocks may touch, and the minimum work of forces that hold every
/// block in equilibrium, J. The edges of support are moved inwards by `inset`, m.
///
/// # Errors
/// When a block is tilted or fixed in the air, no forces do so, or the solver gives up.
pub(super) fn equilibrium(scene: &Scene, inset: f64) -> Result<(Vec<ContactPoint>, f64), LimitError> {
    require_upright(scene)?;
    let points = contact_points(&scene.blocks, inset);
    let mut problem = Problem::new(OptimizationDirection::Minimize);
    let forces: Vec<Variable> = points.iter().map(|p| problem.add_var(p.gap / UNIT, (0.0, f64::INFINITY))).collect();
    let mut rows = balance_rows(scene.blocks.len());
    for (point, &force) in points.iter().zip(&forces) {
        point.for_each_body(|body, sign| {
            let arm = point.lever_arm(&scene.blocks[body]);
            for (row, factor) in rows[body].iter_mut().zip([1.0, arm.x, arm.y]) {
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

/// Returns the rise of each centre and its tilts along x and y: m, 1, 1.
///
/// # Errors
/// When the solver gives up.
pub(super) fn displacements(scene: &Scene, points: &[ContactPoint]) -> Result<Vec<DVec3>, LimitError> {
    let blocks = &scene.blocks;
    let mut problem = Problem::new(OptimizationDirection::Minimize);
    let free = (f64::NEG_INFINITY, f64::INFINITY);
    let unknowns: Vec<[Variable; 3]> =
        blocks.iter().map(|b| [b.mass * scene.gravity, 0.0, 0.0].map(|weight| problem.add_var(weight, free))).collect();
    for point in points {
        let mut row = LinearExpr::empty();
        point.for_each_body(|body, sign| {
            let arm = point.lever_arm(&blocks[body]);
            for (&unknown, factor) in unknowns[body].iter().zip([1.0, arm.x, arm.y]) {
                row.add(unknown, sign * factor);
            }
        });
        problem.add_constraint(row, ComparisonOp::Ge, -point.gap / UNIT);
    }
    let solution = solve(problem)?;
    let values = unknowns.iter().map(|u| DVec3::from(u.map(|v| solution.var_value(v))) * DVec3::new(UNIT, 1.0, 1.0));
    Ok(values.collect())
}

/// Returns the normal forces (N) of springs at the points; that on the largest area has the
/// `stiffness`, N/m. None where the search does not converge.
pub(super) fn spring_forces(scene: &Scene, points: &[ContactPoint], stiffness: f64) -> Option<Vec<f64>> {
    let weights: Vec<f64> = scene.blocks.iter().flat_map(|b| [b.mass * scene.gravity, 0.0, 0.0]).collect();
    let reference = max_area(points);
    let spring = |point: &ContactPoint| {
        let mut coefficients = Vec::new();
        point.for_each_body(|body, sign| {
            let arm = point.lever_arm(&scene.blocks[body]);
            coefficients.extend([(3 * body, sign), (3 * body + 1, sign * arm.x), (3 * body + 2, sign * arm.y)]);
        });
        Spring { coefficients, gap: point.gap, share: point.area / reference }
    };
    let start = scene.blocks.iter().flat_map(|b| [-COMPRESSION * top(b), 0.0, 0.0]).collect();
    stiff_limit::forces(&points.iter().map(spring).collect::<Vec<_>>(), &weights, start, stiffness)
}

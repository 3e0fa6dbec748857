//! The tower as a player estimates it: with errors of heights, friction and positions.
//!
//! P. W. Battaglia, J. B. Hamrick, J. B. Tenenbaum, "Simulation as an engine of physical scene
//! understanding", PNAS 110, 2013: people predict towers as if they simulated a noisy estimate of
//! them a few times.

use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};
use teeter_physics::{BuildError, World};
use teeter_scene::{Form, Random, Scene, overlap};

/// Deviations beyond which an error is drawn again, in standard deviations.
const MAX_DEVIATION: f64 = 2.0;
/// Parts of the errors that are tried, one after the other.
const PARTS: [f64; 4] = [1.0, 0.5, 0.25, 0.125];
/// Overlap that a scene may have, m: half of what is refused.
const MAX_OVERLAP: f64 = 1e-5;
/// Number of times that blocks are made smaller.
const MAX_SHRINKS: usize = 8;
/// Largest coefficient of friction of a scene.
const MAX_FRICTION: f64 = 2.0;

/// Standard deviations of the errors of an estimate.
///
/// ```
/// use teeter_game::EstimateErrors;
///
/// assert_eq!(EstimateErrors::none().height, 0.0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EstimateErrors {
    /// Of the height of a block relative to others of its row, m.
    pub height: f64,
    /// Of the friction of a block, over its friction. At most 0.4.
    pub friction: f64,
    /// Of the position of a row along each horizontal axis, m.
    pub position: f64,
}

impl EstimateErrors {
    /// An estimate without errors.
    pub fn none() -> Self {
        Self { height: 0.0, friction: 0.0, position: 0.0 }
    }
}

impl Default for EstimateErrors {
    /// An attentive player: 0.03 mm, a tenth, and 0.3 mm.
    fn default() -> Self {
        Self { height: 3e-5, friction: 0.1, position: 3e-4 }
    }
}

/// Builds the world that a player believes to see: rigid blocks at rest with the errors of a seed.
///
/// Of each row one block keeps its height and the others lose some, so blocks never overlap; what
/// bears and what is loose is then another. Where blocks at an angle overlap all the same, the
/// errors of heights and positions are halved until none does. Soft blocks that are pressed into
/// each other are made smaller.
///
/// # Errors
/// When no world can be built of it.
///
/// ```
/// use teeter_game::{EstimateErrors, estimate};
/// use teeter_physics::{Params, World};
///
/// let world = World::new(&teeter_scene::named("tower").unwrap(), Params::default())?;
/// let believed = estimate(&world, &EstimateErrors::default(), 1)?;
/// assert_eq!(believed.len(), world.len());
/// assert_ne!(believed.hash(), estimate(&world, &EstimateErrors::default(), 2)?.hash());
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
pub fn estimate(world: &World, errors: &EstimateErrors, seed: u64) -> Result<World, BuildError> {
    let scenes = PARTS.iter().map(|part| {
        let EstimateErrors { height, friction, position } = *errors;
        believed(world, &EstimateErrors { height: height * part, friction, position: position * part }, seed)
    });
    let mut scene = believed(world, &EstimateErrors { height: 0.0, position: 0.0, ..*errors }, seed);
    if let Some(valid) = scenes.into_iter().find(|scene| overlap::first_pair(scene, MAX_OVERLAP).is_none()) {
        scene = valid;
    }
    shrink_overlaps(&mut scene);
    World::new(&scene, *world.params())
}

/// The world with errors as a scene.
fn believed(world: &World, errors: &EstimateErrors, seed: u64) -> Scene {
    let mut scene = Scene { form: Form::Rigid, ..world.to_scene() };
    let mut random = Random::new(seed);
    for row in rows(&scene) {
        let mut error = |size: f64| size * random.clipped_normal(MAX_DEVIATION);
        let shift = DVec3::new(error(errors.position), error(errors.position), 0.0);
        let heights: Vec<f64> = row.iter().map(|_| error(errors.height)).collect();
        let tallest = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        for (&index, height) in row.iter().zip(&heights) {
            let block = &mut scene.blocks[index];
            let lost = tallest - height;
            block.size[2] -= lost;
            let up = DQuat::from_array(block.rotation()) * DVec3::Z;
            block.pos = (DVec3::from(block.pos) + shift - up * (0.5 * lost)).to_array();
        }
    }
    for block in &mut scene.blocks {
        let friction = block.friction.unwrap_or(scene.friction);
        let factor = 1.0 + errors.friction * random.clipped_normal(MAX_DEVIATION);
        block.friction = Some((friction * factor).clamp(0.0, MAX_FRICTION));
        (block.velocity, block.spin) = ([0.0; 3], [0.0; 3]);
    }
    scene
}

/// Indices of the blocks, row by row from the bottom: those beside each other are in one row, also
/// where one leans or two share a cell.
fn rows(scene: &Scene) -> Vec<Vec<usize>> {
    let mut indices: Vec<usize> = (0..scene.blocks.len()).collect();
    indices.sort_by(|a, b| scene.blocks[*a].pos[2].total_cmp(&scene.blocks[*b].pos[2]).then(a.cmp(b)));
    let mut rows: Vec<Vec<usize>> = Vec::new();
    for index in indices {
        let block = &scene.blocks[index];
        let is_beside = |row: &&mut Vec<usize>| block.pos[2] - scene.blocks[row[0]].pos[2] < 0.5 * block.size[2];
        match rows.last_mut().filter(is_beside) {
            Some(row) => row.push(index),
            None => rows.push(vec![index]),
        }
    }
    rows.iter_mut().for_each(|row| row.sort_unstable());
    rows
}

/// Makes blocks that overlap smaller, until none does.
fn shrink_overlaps(scene: &mut Scene) {
    for _ in 0..MAX_SHRINKS {
        let pairs = overlap::pairs(scene, MAX_OVERLAP);
        if pairs.is_empty() {
            break;
        }
        for pair in pairs {
            for index in [pair.first, pair.second] {
                scene.blocks[index].size = scene.blocks[index].size.map(|edge| edge - pair.depth.min(0.1 * edge));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use teeter_physics::{BodyId, Params};
    use teeter_scene::{TowerOptions, tower};

    use super::*;

    fn world() -> World {
        let options = TowerOptions { rows: 5, ..TowerOptions::exact() };
        let mut world = World::new(&tower(&options).unwrap(), Params::default()).unwrap();
        world.run_for(1.0);
        world
    }

    #[test]
    fn an_estimate_without_errors_is_the_tower() {
        let world = world();
        let believed = estimate(&world, &EstimateErrors::none(), 3).unwrap();
        for body in world.bodies() {
            assert_eq!(believed.size(body), world.size(body));
            assert!(believed.pose(body).position.distance(world.pose(body).position) < 1e-6);
        }
    }

    #[test]
    fn an_estimate_stands_and_loads_other_blocks() {
        let world = world();
        let loads = |world: &World| teeter_study::xray(world, 0.4).iter().map(|load| load.above_n).collect::<Vec<_>>();
        let errors = EstimateErrors { height: 1e-4, ..EstimateErrors::default() };
        let mut believed = estimate(&world, &errors, 3).unwrap();
        believed.run_for(1.0);
        for body in world.bodies() {
            let moved = believed.pose(body).position.distance(world.pose(body).position);
            assert!(moved < 3e-3, "{body}: {moved} m");
        }
        let differs = loads(&world).iter().zip(loads(&believed)).filter(|(a, b)| (*a - b).abs() > 0.05).count();
        assert!(differs >= 3, "{differs} blocks bear another load");
    }

    #[test]
    fn the_friction_of_an_estimate_scatters_by_its_share() {
        let errors = EstimateErrors { friction: 0.2, ..EstimateErrors::none() };
        let believed = estimate(&world(), &errors, 1).unwrap();
        let factors: Vec<f64> = believed.scene().blocks.iter().map(|block| block.friction.unwrap() / 0.4).collect();
        assert!(factors.iter().all(|factor| (0.6..=1.4).contains(factor)), "{factors:?}");
        let deviation = factors.iter().map(|f| (f - 1.0) * (f - 1.0)).sum::<f64>() / factors.len() as f64;
        assert!((0.08..0.3).contains(&deviation.sqrt()), "{factors:?}");
        assert_eq!(believed.body(0), Some(BodyId(0)));
    }

    /// Rows that are at an angle come into each other where they are shifted. Without an estimate
    /// an opponent has nothing to choose from.
    #[test]
    fn an_opponent_does_not_give_up_before_a_tower_that_leans() {
        let mut scene = tower(&TowerOptions { rows: 5, ..TowerOptions::exact() }).unwrap();
        let lean = DQuat::from_rotation_x(0.03);
        for block in &mut scene.blocks[3..] {
            let raised = DVec3::from(block.pos) + DVec3::Z * 0.0015;
            (block.pos, block.orientation) =
                ((lean * raised).to_array(), Some((lean * DQuat::from_rotation_z(block.yaw)).to_array()));
            block.yaw = 0.0;
        }
        let world = World::new(&scene, Params::default()).unwrap();
        let errors = EstimateErrors { height: 1e-4, friction: 0.2, position: 1e-3 };
        let seeds = 0..20;
        let overlaps = |seed: &u64| overlap::first_pair(&believed(&world, &errors, *seed), 2.0 * MAX_OVERLAP).is_some();
        assert!(seeds.clone().filter(overlaps).count() >= 5);
        for seed in seeds {
            let estimate = estimate(&world, &errors, seed).unwrap();
            assert!(estimate.bodies().any(|body| estimate.pose(body).position != world.pose(body).position));
        }
    }

    #[test]
    fn a_tower_of_soft_blocks_that_sank_into_each_other_has_an_estimate() {
        let scene = tower(&TowerOptions { rows: 6, ..TowerOptions::default() }).unwrap();
        let soft = Scene { form: Form::Lattice, stiffness: 2e4, ..scene };
        let mut world = World::new(&soft, Params::default()).unwrap();
        world.run_for(1.0);
        for seed in 0..4 {
            let believed = estimate(&world, &EstimateErrors::default(), seed).unwrap();
            assert_eq!(believed.form(), Form::Rigid);
        }
    }
}

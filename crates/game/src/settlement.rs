//! Distance by which strain lets a tower of soft blocks sink: a settlement is no fall.

use glam::DVec3;
use teeter_physics::BodyId;

use crate::blocks::Blocks;
use crate::tower_map::rows_by_height;

/// Returns by how much each block is lower than it would be if no block were strained, m; none
/// where the blocks are rigid.
///
/// A block is lower by what the rows beneath have lost in height, and by half of its own loss.
/// `heights` are those of the centres when no block was strained, m.
///
/// ```
/// use teeter_game::{Blocks, settlement};
/// use teeter_physics::{Params, World};
///
/// let scene = teeter_scene::named("tower").unwrap();
/// let blocks = Blocks::of(&World::new(&scene, Params::default())?);
/// let heights: Vec<f64> = blocks.positions().iter().map(|position| position.z).collect();
/// assert_eq!(settlement(&blocks, &heights), None);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
pub fn settlement(blocks: &Blocks, heights: &[f64]) -> Option<Vec<f64>> {
    if !blocks.is_strained() {
        return None;
    }
    let loss =
        |body: BodyId| 2.0 * (blocks.half_extent_unstrained(body, DVec3::Z) - blocks.half_extent(body, DVec3::Z));
    let mut settled = vec![0.0; blocks.len()];
    let mut beneath = 0.0;
    let bodies: Vec<BodyId> = blocks.bodies().collect();
    for row in rows_by_height(bodies.iter().map(|body| (heights[body.index()], blocks.size(*body).z))) {
        let mut sum = 0.0;
        for &index in &row {
            let own = loss(bodies[index]);
            settled[index] = beneath + 0.5 * own;
            sum += own;
        }
        beneath += sum / row.len() as f64;
    }
    Some(settled)
}

//! Room above a block: whether it can be lifted.

use glam::DVec3;
use teeter_physics::BodyId;

use crate::blocks::Blocks;

/// Height above a block in which nothing may be if it is to be lifted, m.
const HEADROOM: f64 = 0.012;

/// Returns true if the block can be lifted: nothing is above it within 12 mm.
///
/// Load alone cannot decide this: a loose block carries nothing and still has the tower above it.
///
/// ```
/// use teeter_game::{Blocks, is_free};
/// use teeter_physics::{BodyId, Params, World};
///
/// let scene = teeter_scene::named("tower").unwrap();
/// let blocks = Blocks::of(&World::new(&scene, Params::default())?);
/// assert!(is_free(&blocks, BodyId(53)) && !is_free(&blocks, BodyId(0)));
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
pub fn is_free(blocks: &Blocks, body: BodyId) -> bool {
    let size = blocks.size(body);
    let centre = blocks.position(body);
    let above: Vec<BodyId> = blocks
        .bodies()
        .filter(|&other| {
            let offset = blocks.position(other) - centre;
            let near = 0.5 * size.length() + 0.5 * blocks.size(other).length() + HEADROOM;
            other != body && offset.z > 0.0 && offset.length() < near
        })
        .collect();
    if above.is_empty() {
        return true;
    }
    let top = centre.z + blocks.half_extent(body, DVec3::Z);
    // Points over the block's top, whichever of its faces that is.
    for x in [-0.48, -0.24, 0.0, 0.24, 0.48] {
        for y in [-0.48, 0.0, 0.48] {
            for z in [-0.48, 0.0, 0.48] {
                let point = blocks.surface(body, DVec3::new(x, y, z) * size);
                for height in [0.25 * HEADROOM, HEADROOM] {
                    let over = point.with_z(top + height);
                    if above.iter().any(|&other| contains(blocks, other, over)) {
                        return false;
                    }
                }
            }
        }
    }
    true
}

/// Returns true if a point of the world is inside a block.
fn contains(blocks: &Blocks, body: BodyId, point: DVec3) -> bool {
    let local = blocks.axes(body).inverse() * (point - blocks.position(body));
    local.abs().cmplt(0.5 * blocks.size(body)).all()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::blocks::samples::{moved, tower};

    #[test]
    fn only_blocks_with_nothing_above_them_can_be_lifted() {
        let blocks = tower(&["xxx", "xxx", "x.."], 0.0);
        assert!((0..3).all(|body| !is_free(&blocks, BodyId(body))));
        // The block on the third row lies across all of the second.
        assert!((3..6).all(|body| !is_free(&blocks, BodyId(body))));
        assert!(is_free(&blocks, BodyId(6)));
    }

    #[test]
    fn a_block_is_free_once_it_has_come_out_of_the_tower_and_not_before() {
        let blocks = tower(&["xxx", "xxx", "xxx"], 0.0);
        let free_at = |x: f64| is_free(&moved(&blocks, 1, DVec3::X * x), BodyId(1));
        assert!(!free_at(0.04));
        assert!(!free_at(0.075));
        assert!(free_at(0.083));
    }
}

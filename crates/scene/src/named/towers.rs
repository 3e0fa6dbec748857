//! Towers of the game and of the dissertation.

use crate::error::SceneError;
use crate::overlap;
use crate::random::Random;
use crate::scene::Scene;
use crate::tower::{self, TowerOptions};

/// Scene that was built for the list.
pub fn valid(built: Result<Scene, SceneError>) -> Scene {
    built.expect("every scene of the list is valid")
}

/// Configuration of identical blocks.
pub fn exact(text: &str) -> Scene {
    valid(tower::config(text, &TowerOptions::exact()))
}

/// Second static test of the dissertation with its top block moved outwards by `out`, m.
///
/// The middle block and the top one balance on the inner edge of the bottom one, 13.7 mm from the
/// axis; their centre of mass is 27.1 / 2 = 13.55 mm from it. The dissertation reports that the
/// real tower stood, and not where its blocks lay: a top block 0.3 mm further out would balance.
pub fn test_2(out: f64) -> Scene {
    let mut scene = exact("(001)-(010)-(001)");
    scene.blocks[2].pos[1] += out;
    scene
}

/// Maximum apparent penetration of touching blocks, m.
const ROUNDING: f64 = 1e-12;

/// Tower with blocks moved from the lower rows to the top, none of them quite straight.
pub fn midgame() -> Scene {
    let text = "(111)-(101)-(111)-(110)-(101)-(011)-(111)-(010)-(111)-(101)-(111)-(110)-(101)-(111)-(011)-(111)-(101)-(111)-(111)-(111)-(011)";
    let mut scene = valid(tower::config(text, &TowerOptions { seed: 2, ..TowerOptions::default() }));
    let mut random = Random::new(2);
    for i in 0..scene.blocks.len() {
        let straight = scene.blocks[i].clone();
        let along_x = straight.yaw == 0.0;
        let mut scatter = 1.0;
        loop {
            let (along, across, turn) =
                (random.clipped_normal(2.0), random.clipped_normal(2.0), random.clipped_normal(2.0));
            let (along, across) = (1e-3 * scatter * along, 0.5e-3 * scatter * across);
            let (dx, dy) = if along_x { (along, across) } else { (across, along) };
            let block = &mut scene.blocks[i];
            block.pos = [straight.pos[0] + dx, straight.pos[1] + dy, straight.pos[2]];
            block.yaw = straight.yaw + 0.01 * scatter * turn;
            // Must clear the straight poses of later blocks too, so that theirs remain free.
            let moved = &scene.blocks[i];
            if scene.blocks.iter().all(|other| other.id == moved.id || overlap::depth(other, moved) < ROUNDING) {
                break;
            }
            // Straighten until the gap is wide enough.
            scatter *= 0.9;
        }
    }
    scene
}

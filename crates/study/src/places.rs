//! How far the blocks of a world have gone, and how high it stands.

use teeter_physics::{BodyId, World};

/// A block has fallen when its centre has moved further than this, m,
pub const FELL_MOVED: f64 = 5e-3;
/// or has come down by more than this, m.
pub const FELL_DROPPED: f64 = 3e-3;

/// Centres of the blocks at one time, m.
#[derive(Debug, Clone)]
pub struct Places(Vec<[f64; 3]>);

impl Places {
    /// Where the blocks are now.
    pub fn of(world: &World) -> Self {
        Self(world.bodies().map(|body| world.pose(body).position.to_array()).collect())
    }

    /// How far each block is now from where it was, and how much lower, m.
    fn moves<'a>(&'a self, world: &'a World) -> impl Iterator<Item = (f64, f64)> + 'a {
        self.0.iter().zip(world.bodies()).map(|(was, body)| {
            let now = world.pose(body).position;
            let d = [now[0] - was[0], now[1] - was[1], now[2] - was[2]];
            ((d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt(), -d[2])
        })
    }

    /// How far the block that has gone furthest is from where it was, m.
    pub fn furthest(&self, world: &World) -> f64 {
        // Written so that a distance that is no number counts as far.
        self.moves(world).fold(0.0, |most, (moved, _)| if moved <= most { most } else { moved })
    }

    /// The same without one block.
    pub fn furthest_but(&self, world: &World, body: BodyId) -> f64 {
        let others = self.moves(world).enumerate().filter(|(i, _)| *i != body.index());
        others.fold(0.0, |most, (_, (moved, _))| if moved <= most { most } else { moved })
    }

    /// Whether any block but one has fallen.
    pub fn any_fallen_but(&self, world: &World, body: BodyId) -> bool {
        self.moves(world).enumerate().any(|(i, (moved, dropped))| i != body.index() && has_fallen(moved, dropped))
    }

    /// Whether any block has come down by more than [`FELL_DROPPED`].
    pub fn any_dropped(&self, world: &World) -> bool {
        self.moves(world).any(|(_, dropped)| has_fallen(0.0, dropped))
    }

    /// Marks the blocks that have fallen.
    pub fn mark_fallen(&self, world: &World, fallen: &mut [bool]) {
        for (mark, (moved, dropped)) in fallen.iter_mut().zip(self.moves(world)) {
            *mark |= has_fallen(moved, dropped);
        }
    }

    /// Whether any block has fallen.
    pub fn any_fallen(&self, world: &World) -> bool {
        self.moves(world).any(|(moved, dropped)| has_fallen(moved, dropped))
    }
}

/// Distances that are no numbers count as fallen: nothing can be said for a block without a place.
fn has_fallen(moved: f64, dropped: f64) -> bool {
    !(moved <= FELL_MOVED && dropped <= FELL_DROPPED)
}

/// Height of the highest corner of any block above the floor, m.
pub fn top(world: &World) -> f64 {
    let height = |body| {
        let pose = world.pose(body);
        let [x, y, z, w] = pose.orientation.to_array();
        // The bottom row of the rotation matrix: how far each of the block's axes points up.
        let up = [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)];
        let size = world.size(body);
        pose.position.z + 0.5 * (up[0].abs() * size.x + up[1].abs() * size.y + up[2].abs() * size.z)
    };
    world.bodies().map(height).fold(f64::NEG_INFINITY, f64::max)
}

//! Pointer that pulls a block by a damped spring.

use glam::DVec2;

use super::world::World;

/// Stiffness of the pointer's spring, N/m.
pub const STIFFNESS: f64 = 40.0;
/// Damping of the pointer's spring, N s/m.
const DAMPING: f64 = 0.8;
/// Maximum force of the pointer, N: the weight of a dozen blocks.
const MAX_FORCE: f64 = 2.5;
/// Maximum distance from a block at which a pointer takes it, m.
const MAX_DISTANCE: f64 = 0.004;

/// Pointer that holds a block.
#[derive(Debug, Clone, Copy)]
pub struct Pointer {
    block: usize,
    /// Held point, as fractions of the block's edges from its lower left corner.
    at: DVec2,
    /// Position of the pointer, m.
    pub target: DVec2,
}

impl Pointer {
    /// Takes the block nearest to a position (m); `None` where all are too far away.
    pub fn take(world: &World, sizes: &[DVec2], position: DVec2) -> Option<Self> {
        let nearest = |block: usize| {
            let (centre, rotation) = world.pose(block);
            let local = DVec2::from_angle(-rotation).rotate(position - centre);
            let half = 0.5 * sizes[block];
            let distance = (local.abs() - half).max(DVec2::ZERO).length();
            (distance, Self { block, at: (local.clamp(-half, half) + half) / sizes[block], target: position })
        };
        let best = (0..sizes.len()).map(nearest).min_by(|a, b| a.0.total_cmp(&b.0));
        best.filter(|(distance, _)| *distance <= MAX_DISTANCE).map(|(_, pointer)| pointer)
    }

    /// Position of the held point, m.
    pub fn held_point(&self, world: &World) -> DVec2 {
        world.point(self.block, self.at).0
    }

    /// Applies the force of the pointer over one step.
    pub fn pull(&self, world: &mut World) {
        let (position, velocity) = world.point(self.block, self.at);
        let force = (STIFFNESS * (self.target - position) - DAMPING * velocity).clamp_length_max(MAX_FORCE);
        world.apply_impulse(self.block, self.at, force * world.step_time());
    }
}

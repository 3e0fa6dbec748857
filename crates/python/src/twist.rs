//! Velocities and spins as rows of numbers.

use teeter_physics::World;

/// Numbers a body: velocity (3), spin (3).
pub const TWIST_STRIDE: usize = 6;

/// Writes velocity and spin of all bodies.
pub fn write_twists(world: &World, to: &mut [f64]) {
    for (body, to) in world.bodies().zip(to.chunks_exact_mut(TWIST_STRIDE)) {
        let twist = world.twist(body);
        to[..3].copy_from_slice(&twist.velocity.to_array());
        to[3..].copy_from_slice(&twist.spin.to_array());
    }
}

//! Arrays of numbers that describe a world, as the page reads them.

use teeter_physics::World;
use teeter_study::{Load, xray};

/// Replaces `target` by the particles and springs of all bodies: 52 numbers a body, the positions
/// of its 8 particles (m, in the world) and the forces of its 28 springs (N, tension is positive;
/// between particles 0 and 1, 0 and 2, ... 6 and 7). Nothing where the blocks are rigid.
pub fn write_lattices(world: &World, target: &mut Vec<f32>) {
    target.clear();
    for report in world.bodies().filter_map(|body| world.lattice(body)) {
        target.extend(report.particles.iter().flat_map(|at| at.as_vec3().to_array()));
        target.extend(report.forces.iter().map(|&force| force as f32));
    }
}

/// Normal force on the upper face of each body and the force that starts it sliding straight, N,
/// two numbers a body. The second is not a number where nothing bears the body.
pub fn loads(world: &World, friction: f64) -> Vec<f64> {
    let pull = |load: &Load| if load.below_n > 0.0 { load.tightness_n } else { f64::NAN };
    xray(world, friction).iter().flat_map(|load| [load.above_n, pull(load)]).collect()
}

/// Edge lengths of all bodies, three numbers each, m.
pub fn sizes(world: &World) -> Vec<f64> {
    world.bodies().flat_map(|body| world.size(body).to_array()).collect()
}

//! Long rest: creep and energy of a tower that stands for minutes or hours.

use serde::Serialize;
use teeter_physics::{Input, World};

use crate::reference_positions::ReferencePositions;

/// Time between two samples, s.
const INTERVAL: f64 = 60.0;

/// Record of a long rest, sampled every minute and at the end.
///
/// ```
/// # use teeter_physics::Params;
/// # use teeter_study::{long_rest, settled};
/// let scene = teeter_scene::named("block").unwrap();
/// let world = settled(&scene, Params { sleep: false, ..Params::default() })?;
/// let rest = long_rest(world.clone(), 2.0, scene.gravity, || ());
/// assert!(rest.seconds == 2.0 && rest.kinetic_j < 1e-12);
/// // the same world rests in the same bits
/// assert_eq!(rest, long_rest(world, 2.0, scene.gravity, || ()));
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LongRest {
    /// Simulated time, s.
    pub seconds: f64,
    /// Largest displacement of any block from the start, m.
    pub creep_m: f64,
    /// Largest kinetic energy of the centres, J.
    pub kinetic_j: f64,
    /// Largest change of potential energy from the start, J.
    pub potential_j: f64,
    /// Hash of the state at the end.
    pub hash: String,
}

/// Lets a settled world rest for `seconds` under `gravity` (m/s²); calls `sampled` after each
/// sample. Sleep should be off: a sleeping tower does not creep.
///
/// ```
/// use teeter_physics::Params;
/// use teeter_study::{long_rest, settled};
///
/// let scene = teeter_scene::named("column").unwrap();
/// let world = settled(&scene, Params { sleep: false, ..Params::default() })?;
/// let rest = long_rest(world, 5.0, scene.gravity, || ());
/// assert!(rest.creep_m < 1e-8 && rest.potential_j < 1e-9);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
pub fn long_rest(mut world: World, seconds: f64, gravity: f64, sampled: impl Fn()) -> LongRest {
    let (positions, start) = (ReferencePositions::of(&world), energies(&world, gravity));
    let mut rest = LongRest { seconds, creep_m: 0.0, kinetic_j: 0.0, potential_j: 0.0, hash: String::new() };
    let (frames, interval) = (world.frames(seconds), world.frames(INTERVAL));
    for i in 1..=frames {
        world.step(&Input::default());
        if i % interval == 0 || i == frames {
            let now = energies(&world, gravity);
            rest.creep_m = rest.creep_m.max(positions.max_displacement(&world));
            rest.kinetic_j = rest.kinetic_j.max(now.0);
            rest.potential_j = rest.potential_j.max((now.1 - start.1).abs());
            sampled();
        }
    }
    LongRest { hash: format!("{:016x}", world.hash()), ..rest }
}

/// Kinetic energy of the centres and potential energy, J.
fn energies(world: &World, gravity: f64) -> (f64, f64) {
    let of = |body| {
        let (v, m) = (world.twist(body).velocity.to_array(), world.mass(body));
        (0.5 * m * v.iter().map(|v| v * v).sum::<f64>(), m * gravity * world.pose(body).position.z)
    };
    world.bodies().map(of).fold((0.0, 0.0), |sum, e| (sum.0 + e.0, sum.1 + e.1))
}

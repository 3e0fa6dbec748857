//! Scenes and measurements shared by the tests.

use glam::{DQuat, DVec3};
use teeter_physics::{BodyId, Input, POSE_STRIDE, Params, Pose, Precision, StepReport, Twist, World};
use teeter_scene::{Block, Form, Scene, Springs};

/// Standard gravity, m/s².
pub const G: f64 = 9.81;
/// Size (m) and mass (kg) of the nominal block.
pub const SIZE: [f64; 3] = [0.081, 0.0268, 0.018];
pub const MASS: f64 = 0.0196;

/// Scene of nominal blocks at the given centres (m), with friction 0.4.
pub fn blocks(at: &[[f64; 3]]) -> Scene {
    let blocks = at.iter().enumerate().map(|(id, &pos)| Block::new(id as u32, SIZE, MASS, pos));
    Scene {
        name: "test".into(),
        gravity: G,
        friction: 0.4,
        kinetic_friction: None,
        restitution: 0.5,
        stiffness: 1e6,
        edge_radius: 0.0,
        form: Form::default(),
        springs: Springs::default(),
        blocks: blocks.collect(),
        label: None,
        margin: None,
        tilt_az: None,
    }
}

/// Scene of a single block lying on the floor.
pub fn one() -> Scene {
    blocks(&[[0.0, 0.0, 0.009]])
}

/// Scene of `n` blocks stacked on each other.
pub fn column(n: usize) -> Scene {
    blocks(&(0..n).map(|i| [0.0, 0.0, 0.009 + 0.018 * i as f64]).collect::<Vec<_>>())
}

/// Parameters without sleep.
pub fn awake() -> Params {
    Params { sleep: false, ..Params::default() }
}

/// Parameters without sleep, in both number formats.
pub fn both() -> [Params; 2] {
    [Precision::Single, Precision::Double].map(|precision| Params { precision, ..awake() })
}

/// Steps for `seconds` with the same input; returns the last report.
pub fn run(world: &mut World, seconds: f64, input: &Input) -> StepReport {
    let mut report = StepReport::default();
    for _ in 0..(seconds / world.params().frame).round() as usize {
        report = world.step(input);
        assert!(report.quarantined.is_empty(), "{report:?}");
    }
    report
}

/// Poses of all bodies.
pub fn poses(world: &World) -> Vec<Pose> {
    world.poses().chunks_exact(POSE_STRIDE).map(Pose::from_slice).collect()
}

/// Centre of a body, m.
pub fn position(world: &World, body: usize) -> DVec3 {
    world.pose(BodyId(body as u32)).position
}

/// Orientation of a body.
pub fn orientation(world: &World, body: usize) -> DQuat {
    world.pose(BodyId(body as u32)).orientation
}

/// Velocity and spin of a body, m/s and rad/s.
pub fn motion(world: &World, body: usize) -> (DVec3, DVec3) {
    let Twist { velocity, spin } = world.twist(BodyId(body as u32));
    (velocity, spin)
}

/// Largest displacement of a centre since the poses `before`, m.
pub fn displacement(before: &[Pose], world: &World) -> f64 {
    let moved = |i: usize| (position(world, i) - before[i].position).length();
    (0..world.len()).map(moved).fold(0.0, f64::max)
}

/// Gravity on a ground tilted towards x by an angle of this tangent.
pub fn tilted(tangent: f64) -> Input {
    let c = 1.0 / (1.0 + tangent * tangent).sqrt();
    Input::gravity(DVec3::new(G * tangent * c, 0.0, -G * c))
}

/// Principal moments of inertia of a uniform cuboid, kg m².
pub fn inertia(size: [f64; 3], mass: f64) -> DVec3 {
    let [x, y, z] = size.map(|l| l * l);
    DVec3::new(y + z, z + x, x + y) * (mass / 12.0)
}

/// Distance that the only block of a world slides from 0.5 m/s after settling, m, and the distance
/// by Coulomb's law with friction 0.4.
pub fn stopping_distance(world: &mut World) -> (f64, f64) {
    run(world, 1.0, &Input::default());
    let start = position(world, 0);
    world.set_twist(BodyId(0), Twist::linear(DVec3::new(0.5, 0.0, 0.0)));
    run(world, 1.0, &Input::default());
    (position(world, 0).x - start.x, 0.5 * 0.5 / (2.0 * 0.4 * G))
}

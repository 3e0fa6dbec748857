//! Friction of a block that slides and spins at once, against a fine mesh under uniform pressure.

use crate::common::*;
use glam::{DVec2, DVec3};
use teeter_physics::{BodyId, Input, Twist, World};
use teeter_scene::{Block, Random, Scene};

const MU: f64 = 0.3;
/// Thickness of the plates, m: small, so that braking does not shift the pressure.
const THIN: f64 = 1e-3;

/// Plate on the floor that is given a velocity and a spin.
struct Throw {
    size: [f64; 3],
    yaw: f64,
    speed: f64,
    spin: f64,
}

/// Distance (m) and angle (rad) at which a plate comes to rest.
#[derive(Debug, Clone, Copy)]
struct Stop {
    distance: f64,
    angle: f64,
}

impl Throw {
    fn random(random: &mut Random) -> Self {
        let length = 0.03 + 0.06 * random.uniform();
        let ratio = 1.0 + 3.0 * random.uniform();
        Self {
            size: [length, length / ratio, THIN],
            yaw: std::f64::consts::TAU * random.uniform(),
            speed: 0.05 + 0.45 * random.uniform(),
            spin: (5.0 + 35.0 * random.uniform()) * if random.uniform() < 0.5 { -1.0 } else { 1.0 },
        }
    }

    /// Integrates a uniform pressure over a mesh, with the same friction at every speed.
    fn mesh(&self) -> Stop {
        let [a, b, _] = self.size;
        let (nx, ny) = (40, (40.0 * b / a).ceil().max(8.0) as usize);
        let cell = |i: usize, n: usize, size: f64| ((i as f64 + 0.5) / n as f64 - 0.5) * size;
        let cells: Vec<DVec2> = (0..nx * ny).map(|i| DVec2::new(cell(i % nx, nx, a), cell(i / nx, ny, b))).collect();
        let inertia = (a * a + b * b) / 12.0;
        let step = 1e-4;
        let (mut at, mut turn, mut v, mut w) = (DVec2::ZERO, 0.0, DVec2::new(self.speed, 0.0), self.spin);
        while v.length() + w.abs() * a > 2e-3 {
            let (mut force, mut torque) = (DVec2::ZERO, 0.0);
            let rotation = DVec2::from_angle(self.yaw + turn);
            for &cell in &cells {
                let arm = rotation.rotate(cell);
                let slip = v + w * arm.perp();
                let f = slip * (-MU * G / (cells.len() as f64 * (slip.length() + 1e-4)));
                force += f;
                torque += arm.perp_dot(f);
            }
            v += force * step;
            w += torque / inertia * step;
            at += v * step;
            turn += w * step;
        }
        Stop { distance: at.length(), angle: turn.abs() }
    }

    /// Lets the engine do the same.
    fn run(&self) -> Stop {
        let block = Block { yaw: self.yaw, ..Block::new(0, self.size, 0.02, [0.0, 0.0, 0.5 * self.size[2]]) };
        let scene = Scene { friction: MU, blocks: vec![block], ..one() };
        let mut world = World::new(&scene, awake()).unwrap();
        run(&mut world, 0.6, &Input::default());
        let start = world.pose(BodyId(0));
        let twist = Twist { velocity: DVec3::new(self.speed, 0.0, 0.0), spin: DVec3::new(0.0, 0.0, self.spin) };
        world.set_twist(BodyId(0), twist);
        let (mut angle, mut last) = (0.0, start.orientation);
        for _ in 0..120 {
            world.step(&Input::default());
            let now = world.pose(BodyId(0)).orientation;
            let q = now * last.conjugate();
            angle += 2.0 * libm::atan2(q.z, q.w);
            last = now;
        }
        Stop { distance: (world.pose(BodyId(0)).position - start.position).length(), angle: f64::abs(angle) }
    }
}

/// Relative errors of distance and angle where they go over 5 mm and 10 degrees.
fn errors(throw: &Throw) -> Vec<f64> {
    let (found, right) = (throw.run(), throw.mesh());
    let mut errors = Vec::new();
    if right.distance > 5e-3 {
        errors.push((found.distance / right.distance - 1.0).abs());
    }
    if right.angle > 10f64.to_radians() {
        errors.push((found.angle / right.angle - 1.0).abs());
    }
    errors
}

#[test]
fn a_plate_that_slides_and_spins_stops_where_a_uniform_pressure_stops_it() {
    let mut random = Random::new(15);
    let throws: Vec<Throw> = (0..50).map(|_| Throw::random(&mut random)).collect();
    let mut all: Vec<f64> = throws.iter().flat_map(errors).collect();
    all.sort_by(f64::total_cmp);
    let (median, worst) = (all[all.len() / 2], all[all.len() - 1]);
    assert!(median < 0.03, "median error {median}");
    assert!(worst < 0.06, "worst error {worst}");
}

#[test]
fn a_square_and_a_block_that_slide_and_spin_stop_within_one_percent() {
    for size in [[0.08, 0.08, 0.002], [0.081, 0.0268, 0.002]] {
        let throw = Throw { size, yaw: 0.0, speed: 0.5, spin: 10.0 };
        let (found, right) = (throw.run(), throw.mesh());
        let errors = [found.distance / right.distance - 1.0, found.angle / right.angle - 1.0];
        assert!(errors.iter().all(|error| error.abs() < 0.01), "{size:?}: {errors:?}");
    }
}

#[test]
fn the_floor_bears_a_sliding_block_where_the_block_is() {
    // The load is below the centre, and ahead of it by mu h for a block that friction stops.
    for (friction, speed) in [(0.0, 0.2), (0.0, 2.0), (0.3, 2.0)] {
        let mut world = World::new(&Scene { friction, ..one() }, awake()).unwrap();
        run(&mut world, 0.5, &Input::default());
        world.set_twist(BodyId(0), Twist::linear(DVec3::new(speed, 0.0, 0.0)));
        for frame in 0..30 {
            world.step(&Input::default());
            let load = world.contacts(BodyId(0))[0].point - position(&world, 0);
            let ahead = friction * 0.5 * SIZE[2];
            assert!((load.x - ahead).abs() < 1e-4 && load.y.abs() < 1e-5, "mu {friction}, frame {frame}: {load}");
        }
    }
}

#[test]
fn a_plank_bears_a_sliding_block_where_the_block_is() {
    // The block is the higher or the lower body of the pair, and slides along the plank or askew.
    for (order, yaw, speed) in [([0, 1], 0.0, 0.1), ([1, 0], 0.0, 2.0), ([0, 1], 0.4, 0.5), ([1, 0], 1.2, 0.5)] {
        let plank = Block { fixed: true, ..Block::new(order[0], [2.0, 0.3, 0.02], 1.0, [0.8, 0.0, 0.01]) };
        let block = Block { yaw, ..Block::new(order[1], SIZE, MASS, [0.0, 0.0, 0.02 + 0.5 * SIZE[2]]) };
        let mut list = vec![plank, block];
        list.sort_by_key(|block| block.id);
        let mut world = World::new(&Scene { friction: 0.0, blocks: list, ..one() }, awake()).unwrap();
        run(&mut world, 0.5, &Input::default());
        let id = BodyId(order[1]);
        world.set_twist(id, Twist::linear(DVec3::new(speed, 0.0, 0.0)));
        for frame in 0..30 {
            world.step(&Input::default());
            let load = world.contacts(id)[0].point - world.pose(id).position;
            assert!(load.truncate().length() < 1e-4, "{order:?} {yaw} {speed}, frame {frame}: {load}");
        }
    }
}

#[test]
fn a_small_block_that_tumbles_over_the_floor_does_not_sink() {
    for seed in 0..12 {
        let mut random = Random::new(seed);
        let mut between = |low: f64, high: f64| low + (high - low) * random.uniform();
        let size = [between(0.003, 0.012), between(0.003, 0.012), 0.0035];
        let mass = 700.0 * size.iter().product::<f64>();
        let spin = [between(-60.0, 60.0), between(-60.0, 60.0), between(-20.0, 20.0)];
        let velocity = [between(-1.0, 1.0), between(-1.0, 1.0), -0.5];
        let block = Block { velocity, spin, ..Block::new(0, size, mass, [0.0, 0.0, 0.012]) };
        let scene = Scene { friction: 0.1, restitution: 0.1, stiffness: 2e6, ..blocks(&[]) };
        let mut world = World::new(&Scene { blocks: vec![block], ..scene }, awake()).unwrap();
        for frame in 0..60 {
            let depth = world.step(&Input::default()).penetration / 0.0035;
            assert!(depth < 0.02, "seed {seed}, frame {frame}: {depth:.3} of its thickness");
        }
    }
}

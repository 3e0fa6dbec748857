//! Energy: what nobody puts in, no world gains.

use crate::common::*;
use glam::{DQuat, DVec3};
use proptest::prelude::*;
use teeter_physics::{AppliedForce, BodyId, Drive, Energy, EnergyBalance, Hand, Input, Params, World};
use teeter_scene::{Block, CardsOptions, Form, Scene};

/// Largest growth of the energy in a frame over `seconds`, over the energy at the start.
fn worst_gain(scene: &Scene, seconds: f64) -> f64 {
    let mut world = World::new(scene, awake()).unwrap();
    let start = world.energy().total();
    let (mut last, mut worst) = (start, 0.0f64);
    for _ in 0..world.frames(seconds) {
        let report = world.step(&Input::default());
        assert!(report.quarantined.is_empty(), "{:?}", report.quarantined);
        let now = world.energy().total();
        worst = worst.max(now - last);
        last = now;
    }
    worst / start
}

/// Up to five blocks of 2 to 100 mm in any orientation above each other, thrown at each other.
fn heaps() -> impl Strategy<Value = Scene> {
    let unit = || prop::array::uniform4(-1.0..1.0f64).prop_filter("no direction", |q| q.iter().any(|c| c.abs() > 0.1));
    let block = (prop::array::uniform3(0.2..1.0f64), unit(), prop::array::uniform3(-1.0..1.0f64), -20.0..20.0f64);
    let blocks = prop::collection::vec(block, 2..6);
    let constants = (0.01..0.1f64, 300.0..900.0f64, 0.1..0.8f64, 0.0..0.9f64, 5.5..6.5f64);
    (blocks, constants, any::<bool>(), 0.0..0.02f64).prop_map(|(blocks, constants, lattice, radius)| {
        let (base, density, friction, restitution, exponent) = constants;
        let mut height = 0.0;
        let blocks = blocks.into_iter().enumerate().map(|(i, (size, orientation, velocity, spin))| {
            let size = size.map(|edge| base * edge);
            let reach = 0.51 * (size[0] * size[0] + size[1] * size[1] + size[2] * size[2]).sqrt();
            height += 2.0 * reach;
            let position = [0.2 * base * velocity[1], 0.2 * base * velocity[0], height - reach];
            let orientation = DQuat::from_array(orientation).normalize();
            let mass = density * size[0] * size[1] * size[2];
            let [x, y, z] = velocity;
            Block {
                orientation: Some(orientation.to_array()),
                velocity: [x, y, -z.abs()],
                spin: [spin, 0.0, -spin],
                ..Block::new(i as u32, size, mass, position)
            }
        });
        let blocks = blocks.collect();
        let form = if lattice { Form::Lattice } else { Form::Rigid };
        let (stiffness, edge_radius) = (libm::pow(10.0, exponent), radius * base);
        Scene { blocks, friction, restitution, stiffness, edge_radius, form, ..one() }
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn heaps_of_blocks_gain_no_energy(scene in heaps()) {
        let gain = worst_gain(&scene, 0.6);
        prop_assert!(gain < 1e-3, "{gain:e} in a frame");
    }
}

#[test]
fn a_falling_house_of_cards_is_not_thrown_about() {
    let mut scene = teeter_scene::cards(5, &CardsOptions::default()).unwrap();
    scene.friction = 0.1;
    let gain = worst_gain(&scene, 2.0);
    assert!(gain < 1e-4, "{gain:e} in a frame");
}

#[test]
fn small_blocks_that_meet_deep_inside_each_other_are_not_thrown_apart() {
    let of = |id, size: [f64; 3], z, yaw| Block { yaw, ..Block::new(id, size, 1e-4, [0.0, 0.0, z]) };
    let blocks = vec![of(0, [0.0029, 0.0021, 0.0015], 0.0129, 0.0), of(1, [0.0027, 0.0024, 0.0019], 0.0179, 0.7)];
    for restitution in [0.0, 0.3, 0.57] {
        let scene = Scene { blocks: blocks.clone(), friction: 0.0, restitution, ..one() };
        let gain = worst_gain(&scene, 1.0);
        assert!(gain < 1e-3, "restitution {restitution}: {gain:e} in a frame");
    }
}

/// Block that falls on the floor at 1 m/s without gravity, in frames of 0.1 ms: shows `see` the
/// energies of the start (J) and before and after each frame. Returns the largest energy of springs
/// over that of the start, and the velocity at the end, m/s.
fn bounce(mut scene: Scene, frames: usize, see: impl Fn(usize, f64, [Energy; 2])) -> (f64, f64) {
    scene.blocks[0].velocity = [0.0, 0.0, -1.0];
    let mut world = World::new(&scene, Params { frame: 1e-4, ..awake() }).unwrap();
    let start = world.energy().total();
    let (mut last, mut elastic) = (world.energy(), 0.0f64);
    for frame in 0..frames {
        world.step(&Input::default());
        let now = world.energy();
        see(frame, start, [last, now]);
        (last, elastic) = (now, elastic.max(now.elastic));
    }
    (elastic / start, world.twist(BodyId(0)).velocity.z)
}

#[test]
fn the_energy_of_an_impact_is_seen_at_one_time() {
    for form in [Form::Rigid, Form::Lattice] {
        let mut scene = Scene { restitution: 0.96, form, gravity: 0.0, ..one() };
        scene.blocks[0].pos[2] = 0.0095;
        scene.springs.stiffness = Some(3e7);
        let (elastic, speed) = bounce(scene, 40, |_, start, [last, now]| {
            // The substep in which they meet is the only one that is not resolved.
            let pressed = last.elastic > 0.01 * start && now.elastic > 0.01 * start;
            assert!(!pressed || now.total() < last.total() + 2e-3 * start, "{form:?}: {now:?} after {last:?}");
        });
        // It bounced, and bore all of the energy on its springs.
        assert!(elastic > 0.5 && speed > 0.9, "{form:?}: {elastic}, {speed} m/s");
    }
}

#[test]
fn the_energy_of_an_impact_never_grows() {
    // In frames of a single substep, from several heights: the substep in which they meet ends at
    // different depths.
    for (form, phase) in [Form::Rigid, Form::Lattice].into_iter().flat_map(|form| (0..16).map(move |i| (form, i))) {
        let mut scene = Scene { restitution: 0.9, form, gravity: 0.0, stiffness: 5e4, ..one() };
        scene.blocks[0].pos[2] = 0.0095 + 1e-4 / 16.0 * f64::from(phase);
        scene.springs.stiffness = Some(1.5e6);
        let (elastic, speed) = bounce(scene, 60, |frame, start, [last, now]| {
            let gain = (now.total() - last.total()) / start;
            assert!(gain < 1e-6, "{form:?}, phase {phase}, frame {frame}: {gain:e}, {now:?} after {last:?}");
        });
        // It bounced, and bore all of the energy on its springs.
        assert!(elastic > 0.5 && speed > 0.8, "{form:?}: {elastic}, {speed} m/s");
    }
}

/// Largest difference between the work put in and the change of the energy, over the work, in a
/// world that loses nothing.
fn imbalance(world: &mut World, frames: usize, input: impl Fn(usize) -> Input) -> f64 {
    let start = world.energy().total();
    let put_in: f64 = (0..frames).map(|frame| world.step(&input(frame)).put_in).sum();
    (world.energy().total() - start - put_in).abs() / put_in.abs()
}

#[test]
fn the_work_of_inputs_is_the_energy_of_a_free_block() {
    let body = BodyId(0);
    for form in [Form::Rigid, Form::Lattice] {
        let mut scene = Scene { form, ..one() };
        scene.blocks[0].pos[2] = 5.0;
        scene.springs.stiffness = Some(1e7);
        let build = || World::new(&scene, awake()).unwrap();
        let force = AppliedForce { body, point: DVec3::new(0.01, 0.01, 0.0), force: DVec3::new(0.1, 0.3, 0.5) };
        let error = imbalance(&mut build(), 20, |_| Input::force(force));
        assert!(error < 2e-3, "force, {form:?}: {error:e}");
        let drive = Drive::new(body, DVec3::new(0.3, 0.0, 0.4)).with_max_force(1.0);
        let error = imbalance(&mut build(), 20, |_| Input { drives: vec![drive], ..Input::default() });
        assert!(error < 2e-3, "drive, {form:?}: {error:e}");
        let target = |frame| DVec3::new(4e-3 * frame as f64, 0.0, 5.0 + 2e-3 * frame as f64);
        let hand = |frame| Hand::carry(body, DVec3::new(0.0, 0.0, 0.005), target(frame), DQuat::IDENTITY);
        let error = imbalance(&mut build(), 20, |frame| Input::hand(hand(frame)));
        assert!(error < 2e-3, "hand, {form:?}: {error:e}");
        let gravity = |frame| DVec3::new(0.0, 0.3 * frame as f64, -G);
        let error = imbalance(&mut build(), 20, |frame| Input::gravity(gravity(frame)));
        assert!(error < 1e-6, "gravity, {form:?}: {error:e}");
    }
}

#[test]
fn pushing_a_block_over_the_floor_puts_in_what_friction_takes() {
    let mut world = World::new(&one(), awake()).unwrap();
    let drive = Drive::new(BodyId(0), DVec3::X * 0.1).with_max_force(1.0);
    let mut balance = EnergyBalance::new(&world);
    for _ in 0..60 {
        let report = world.step(&Input { drives: vec![drive], ..Input::default() });
        balance.record(&world, &report);
    }
    let friction = 0.4 * MASS * G * position(&world, 0).x;
    let kinetic = 0.5 * MASS * 0.01;
    assert!((balance.put_in() / (friction + kinetic) - 1.0).abs() < 0.01, "{balance:?}");
    assert!((balance.lost() / friction - 1.0).abs() < 0.01, "{balance:?}");
    assert!(balance.worst_share() < 1e-4, "{balance:?}");
}

//! Lattice blocks: they obey the closed forms of rigid blocks, and converge to rigid blocks as
//! their springs stiffen.

use crate::common::*;
use glam::{DMat3, DVec3};
use teeter_physics::{AppliedForce, BodyId, Drive, Hand, Input, Params, Precision, Twist, Width, World};
use teeter_scene::{Form, NAMED, Particles, Scene, Springs, Stability, TowerOptions, tower};

/// Scene with lattice blocks, with springs as stiff as the contacts.
fn lattice(scene: Scene) -> Scene {
    Scene { form: Form::Lattice, ..scene }
}

/// Scene with lattice blocks, with springs of a given stiffness, N/m.
fn springs_of(stiffness: f64, scene: Scene) -> Scene {
    Scene { springs: Springs { stiffness: Some(stiffness), ..scene.springs }, ..lattice(scene) }
}

fn corners(scene: Scene) -> Scene {
    Scene { springs: Springs { particles: Particles::Corners, ..scene.springs }, ..lattice(scene) }
}

fn in_space(scene: Scene) -> Scene {
    Scene { gravity: 0.0, ..scene }
}

/// Angular acceleration over torque along each axis of a lattice block, 1/(kg m²), for a torque
/// applied as a pair of forces.
fn inverse_inertia(scene: &Scene) -> DVec3 {
    let mut inverse = DVec3::ZERO;
    for k in 0..3 {
        let (along, across) = ((k + 1) % 3, (k + 2) % 3);
        let mut world = World::new(scene, Params { precision: Precision::Double, ..awake() }).unwrap();
        let (mut arm, mut force) = (DVec3::ZERO, DVec3::ZERO);
        arm[along] = 0.01;
        force[across] = 1e-5;
        let pair = [1.0, -1.0].map(|side| AppliedForce { body: BodyId(0), point: arm * side, force: force * side });
        let input = Input { forces: pair.to_vec(), ..Input::default() };
        // The force grows over the first frame; then the spin grows linearly.
        run(&mut world, 1.0 / 60.0, &input);
        let before = motion(&world, 0).1[k];
        run(&mut world, 6.0 / 60.0, &input);
        inverse[k] = (motion(&world, 0).1[k] - before) / (6.0 / 60.0) / (2.0 * arm[along] * force[across]);
    }
    inverse
}

#[test]
fn a_block_has_the_inertia_of_a_uniform_cuboid() {
    let exact = inertia(SIZE, MASS);
    let inside = inverse_inertia(&in_space(lattice(blocks(&[[0.0, 0.0, 1.0]])))).recip() / exact;
    assert!((inside - 1.0).abs().max_element() < 1e-6, "{inside}");
    // Particles at the corners, as in the dissertation, have three times the inertia.
    let corner = inverse_inertia(&in_space(corners(blocks(&[[0.0, 0.0, 1.0]])))).recip() / exact;
    assert!((corner - 3.0).abs().max_element() < 3e-6, "{corner}");
}

/// Kinetic energy (J) and angular momentum about the origin (kg m²/s) of a block, from its rigid
/// motion.
fn energy_and_momentum(world: &World) -> (f64, DVec3) {
    let (v, w) = motion(world, 0);
    let r = DMat3::from_quat(orientation(world, 0));
    let spin = r * (inertia(SIZE, MASS) * (r.transpose() * w));
    (0.5 * MASS * v.length_squared() + 0.5 * w.dot(spin), position(world, 0).cross(MASS * v) + spin)
}

#[test]
fn a_tumbling_block_conserves_energy_and_angular_momentum() {
    for precision in [Precision::Single, Precision::Double] {
        let scene = in_space(lattice(blocks(&[[0.0, 0.0, 5.0]])));
        let mut world = World::new(&scene, Params { precision, ..awake() }).unwrap();
        world.set_twist(BodyId(0), Twist { velocity: DVec3::new(0.3, 0.2, 0.1), spin: DVec3::new(12.0, 14.0, 8.0) });
        // Energy goes into the springs first, as they adapt to the spin.
        run(&mut world, 0.1, &Input::default());
        let (energy, momentum) = energy_and_momentum(&world);
        run(&mut world, 1.0, &Input::default());
        let (later, turned) = energy_and_momentum(&world);
        assert!((later / energy - 1.0).abs() < 1e-4, "{precision:?}: energy {energy} then {later} J");
        assert!((turned - momentum).length() < 1e-4 * momentum.length(), "{precision:?}: {momentum} then {turned}");
    }
}

#[test]
fn a_block_in_free_fall_follows_a_parabola_without_rotation() {
    let mut world = World::new(&lattice(blocks(&[[0.0, 0.0, 10.0]])), Params { ramp: 0.0, ..awake() }).unwrap();
    run(&mut world, 1.0, &Input::default());
    let (v, w) = motion(&world, 0);
    assert!((position(&world, 0) - DVec3::new(0.0, 0.0, 10.0 - 0.5 * G)).length() < 1e-9);
    assert!((v - DVec3::new(0.0, 0.0, -G)).length() < 1e-9 && w.length() < 1e-6, "{v} {w}");
}

/// Two lattice blocks collide in space: their total momentum and angular momentum are conserved.
#[test]
fn a_collision_conserves_momentum_and_angular_momentum() {
    let scene = in_space(lattice(blocks(&[[0.0, 0.0, 1.0], [0.03, 0.012, 1.03]])));
    let mut world = World::new(&scene, Params { ramp: 0.0, ..awake() }).unwrap();
    world.set_twist(BodyId(1), Twist { velocity: DVec3::new(-0.2, 0.0, -0.5), spin: DVec3::new(1.0, -2.0, 3.0) });
    let sums = |world: &World| {
        (0..2).fold((DVec3::ZERO, DVec3::ZERO), |(p, l), i| {
            let (v, w) = motion(world, i);
            let r = DMat3::from_quat(orientation(world, i));
            (p + MASS * v, l + position(world, i).cross(MASS * v) + r * (inertia(SIZE, MASS) * (r.transpose() * w)))
        })
    };
    let (p, l) = sums(&world);
    let report = run(&mut world, 0.25, &Input::default());
    let (p1, l1) = sums(&world);
    assert!(motion(&world, 0).0.length() > 0.1, "they have collided: {report:?}");
    assert!((p1 - p).length() < 1e-5 * p.length(), "{p} then {p1}");
    // About the origin: the error is relative to the lever arm of 1 m.
    assert!((l1 - l).length() < 1e-4 * l.length(), "{l} then {l1}");
}

#[test]
fn blocks_slide_and_stay_as_rigid_ones_do() {
    let mut world = World::new(&lattice(one()), awake()).unwrap();
    run(&mut world, 1.0, &tilted(0.399));
    let before = poses(&world);
    run(&mut world, 5.0, &tilted(0.399));
    let moved = displacement(&before, &world);
    assert!(moved < 1e-9, "{moved:e} m in 5 s");

    let mut world = World::new(&lattice(one()), awake()).unwrap();
    let (distance, expected) = stopping_distance(&mut world);
    assert!((distance / expected - 1.0).abs() < 3e-3, "{distance} instead of {expected} m");
}

#[test]
fn the_full_tower_of_springs_stands_without_sleep() {
    let mut world = World::new(&lattice(tower(&TowerOptions::default()).unwrap()), awake()).unwrap();
    run(&mut world, 2.0, &Input::default());
    let before = poses(&world);
    let report = run(&mut world, 8.0, &Input::default());
    let creep = displacement(&before, &world);
    assert!(creep < 1e-7, "creep {creep:e} m");
    assert!(report.rms_speed < 1e-6, "rms speed {:e} m/s", report.rms_speed);
    assert!(report.penetration < 5e-5, "penetration {:e} m", report.penetration);
}

/// Equal heights load every contact, and unequal masses excite them all: the explicit step is
/// closest to its limit, at both ends of the range of restitution, and whether springs or contacts
/// bound it.
#[test]
fn towers_of_equal_heights_do_not_vibrate() {
    for (rows, restitution, stiffness) in [(6, 0.0, 1e6), (6, 0.6, 1e7), (12, 0.5, 1e6)] {
        let options = TowerOptions { rows, restitution, height_sd: 0.0, ..TowerOptions::default() };
        let mut world = World::new(&springs_of(stiffness, tower(&options).unwrap()), awake()).unwrap();
        let report = run(&mut world, 4.0, &Input::default());
        assert!(report.rms_speed < 1e-7, "{rows} rows, {stiffness:e} N/m: {:e} m/s", report.rms_speed);
    }
}

#[test]
fn the_configurations_stand_or_fall_as_rigid_ones_do() {
    let mut judged = 0;
    for named in NAMED.iter().filter(|n| n.name.starts_with("test-") || n.name == "loose") {
        let Some(expected) = named.expect else { continue };
        let mut world = World::new(&lattice(named.scene()), awake()).unwrap();
        let before = poses(&world);
        run(&mut world, 4.0, &Input::default());
        assert_eq!(displacement(&before, &world) > 5e-3, expected == Stability::Unstable, "{}", named.name);
        judged += 1;
    }
    assert!(judged >= 6);
}

/// From jelly to twice wood: nothing runs away, and softer towers sink more.
#[test]
fn the_whole_range_of_stiffness_is_stable() {
    let mut last = f64::INFINITY;
    for stiffness in [1e3, 1e4, 1e6, 1e8] {
        let scene = tower(&TowerOptions { rows: 4, ..TowerOptions::default() }).unwrap();
        let mut world = World::new(&springs_of(stiffness, scene.clone()), awake()).unwrap();
        let before = scene.blocks[11].pos[2];
        run(&mut world, 1.0, &Input::default());
        let sink = before - position(&world, 11).z;
        assert!(sink < last, "{stiffness:e} N/m: {sink} m, after {last} m");
        last = sink;
        // Knocks a block out of the middle.
        let push = Drive { body: BodyId(7), velocity: DVec3::new(3.0, 1.0, 0.0), max_force: 50.0 };
        run(&mut world, 0.1, &Input::drives(vec![push]));
        for _ in 0..6 {
            let report = run(&mut world, 0.1, &Input::default());
            assert!(report.max_speed < 10.0, "{stiffness:e} N/m: {report:?}");
        }
    }
}

/// Figure 6.21 of the dissertation: soft springs and a full tower.
#[test]
fn soft_springs_compress_a_full_tower_and_stiff_ones_do_not() {
    let sink = |stiffness: f64| {
        let scene = springs_of(stiffness, tower(&TowerOptions::default()).unwrap());
        let mut world = World::new(&scene, awake()).unwrap();
        let top = scene.blocks[53].pos[2];
        run(&mut world, 2.0, &Input::default());
        top - position(&world, 53).z
    };
    let (soft, stiff) = (sink(1e3), sink(1e6));
    assert!(soft > 0.012, "the top of the soft tower is {soft} m lower");
    assert!(stiff < 5e-4, "the top of the stiff tower is {stiff} m lower");
}

/// The rest pose of a tower converges to that of rigid blocks as the springs stiffen.
#[test]
fn stiff_springs_rest_as_rigid_blocks_do() {
    let rest = |scene: &Scene| {
        let mut world = World::new(scene, Params { precision: Precision::Double, ..awake() }).unwrap();
        run(&mut world, 1.5, &Input::default());
        position(&world, 11).z
    };
    let scene = tower(&TowerOptions { rows: 4, ..TowerOptions::exact() }).unwrap();
    let rigid = rest(&scene);
    let [soft, middle, stiff] = [1e5, 1e6, 1e7].map(|stiffness| rigid - rest(&springs_of(stiffness, scene.clone())));
    // Sag is inversely proportional to the stiffness, except for the distribution of the load
    // between blocks: the less that changes, the closer the ratio is to 10.
    let (coarse, fine) = ((soft / middle - 10.0).abs(), (middle / stiff - 10.0).abs());
    assert!(coarse < 0.5 && fine < 0.5 * coarse, "{soft} {middle} {stiff} m");
}

/// An overhanging block tips over like a rigid one, and the difference vanishes as its springs
/// stiffen. Frames are short so that rigid and lattice blocks are synced at the same times.
#[test]
fn stiff_springs_fall_as_rigid_blocks_do() {
    let fall = |scene: &Scene| {
        let mut world =
            World::new(scene, Params { precision: Precision::Double, frame: 5e-4, ramp: 0.3, ..awake() }).unwrap();
        run(&mut world, 0.1, &Input::default());
        position(&world, 1)
    };
    let scene = blocks(&[[0.0, 0.0, 0.009], [0.048, 0.0, 0.027]]);
    let rigid = fall(&scene);
    let [soft, middle, stiff] =
        [1e3, 1e4, 1e5].map(|stiffness| (fall(&springs_of(stiffness, scene.clone())) - rigid).length());
    assert!(middle < 0.2 * soft && stiff < 0.2 * middle && stiff < 1e-6, "{soft} {middle} {stiff} m");
}

#[test]
fn a_hand_pulls_a_loose_block_out() {
    let mut world = World::new(&lattice(teeter_scene::named("loose").unwrap()), awake()).unwrap();
    run(&mut world, 2.0, &Input::default());
    let before = poses(&world);
    // The loose block of the row below the top, pulled along its axis.
    let body = 12;
    let axis = orientation(&world, body) * DVec3::X;
    let anchor = DVec3::new(0.0405, 0.0, 0.0);
    let start = position(&world, body) + orientation(&world, body) * anchor;
    for frame in 0..150 {
        let target = start + axis * (0.05 / 60.0 * f64::from(frame + 1)).min(0.12);
        let hand = Hand::slide(BodyId(body as u32), anchor, target, orientation(&world, body));
        let report = world.step(&Input::hand(hand));
        assert!(report.quarantined.is_empty());
    }
    assert!((position(&world, body) - before[body].position).dot(axis) > 0.09);
    for i in (0..world.len()).filter(|&i| i != body) {
        let moved = (position(&world, i) - before[i].position).length();
        assert!(moved < 1e-4, "block {i} moved by {moved} m");
    }
}

#[test]
fn a_running_tower_changes_its_form_without_a_jump() {
    let mut world = World::new(&tower(&TowerOptions::default()).unwrap(), awake()).unwrap();
    run(&mut world, 2.0, &Input::default());
    for form in [Form::Lattice, Form::Rigid, Form::Lattice] {
        let before = poses(&world);
        world.set_form(form, Springs::default()).unwrap();
        assert_eq!(world.form(), form);
        run(&mut world, 1.0, &Input::default());
        let moved = displacement(&before, &world);
        assert!(moved < 1e-4, "to {form}: {moved} m");
    }
    let error = world.set_form(Form::Lattice, Springs { stiffness: Some(10.0), ..Springs::default() }).unwrap_err();
    assert_eq!(error.to_string(), "`springs.stiffness` is 10, expected 1e3 to 1e8 N/m");
    assert_eq!(world.spring_stiffness(), Some(1e6));
}

#[test]
fn a_snapshot_contains_the_springs() {
    let mut world = World::new(&lattice(column(3)), awake()).unwrap();
    run(&mut world, 0.2, &Input::default());
    let state = world.snapshot();
    let mut other = World::new(&lattice(column(3)), awake()).unwrap();
    other.restore(&state).unwrap();
    assert_eq!(other.lattice(BodyId(1)), world.lattice(BodyId(1)));
    run(&mut world, 0.3, &Input::default());
    run(&mut other, 0.3, &Input::default());
    assert_eq!(world.hash(), other.hash());

    let mut rigid = World::new(&column(3), awake()).unwrap();
    assert_eq!(rigid.restore(&state).unwrap_err().to_string(), "not a snapshot of this world: its blocks have springs");
    let rigid_state = rigid.snapshot();
    assert_eq!(
        world.restore(&rigid_state).unwrap_err().to_string(),
        "not a snapshot of this world: its blocks are rigid"
    );
}

#[test]
fn all_widths_give_the_same_bits() {
    for precision in [Precision::Single, Precision::Double] {
        let hashes = [Width::Portable, Width::Sse2, Width::Avx2, Width::Avx512].map(|width| {
            let scene = lattice(tower(&TowerOptions { rows: 5, ..TowerOptions::default() }).unwrap());
            let mut world = World::new(&scene, Params { precision, width, ..awake() }).unwrap();
            run(&mut world, 0.4, &Input::default());
            let push = Drive { body: BodyId(7), velocity: DVec3::new(1.0, 0.5, 0.0), max_force: 50.0 };
            run(&mut world, 0.2, &Input::drives(vec![push]));
            world.hash()
        });
        assert!(hashes.iter().all(|&hash| hash == hashes[0]), "{precision:?}: {hashes:x?}");
    }
}

/// The springs of a block carry the weight above it.
#[test]
fn the_springs_carry_the_weight_above() {
    let mut world = World::new(&lattice(column(4)), awake()).unwrap();
    run(&mut world, 2.0, &Input::default());
    let report = world.lattice(BodyId(0)).unwrap();
    let mut n = 0;
    let (mut up, mut worst): (f64, f64) = (0.0, 0.0);
    for i in 0..8usize {
        for j in i + 1..8 {
            let force = report.forces[n];
            n += 1;
            worst = worst.max(force.abs());
            // From a lower to an upper particle.
            if (i ^ j) & 4 != 0 {
                let along = (report.particles[j] - report.particles[i]).normalize();
                up -= force * along.z;
            }
        }
    }
    assert!(worst > 0.01);
    // The particles carry the weight above and the upper half of the block's own weight, on a
    // longer lever arm: the surfaces are √3 times as far apart as the particles.
    let above = 3.0 * MASS * G;
    let own = MASS * G;
    let expected = 3f64.sqrt() * (above + own / 2.0);
    assert!((up / expected - 1.0).abs() < 0.01, "{up} N instead of {expected} N");
}

#[test]
fn a_column_is_pulled_apart_at_coulombs_force() {
    // The fourth block slips with all blocks above it.
    let pull = 0.4 * 7.0 * MASS * G;
    let moved = |share: f64| {
        let mut world = World::new(&lattice(column(10)), awake()).unwrap();
        run(&mut world, 2.0, &Input::default());
        let start = position(&world, 3);
        for step in 0..180 {
            let force = DVec3::X * (share * pull * f64::from(step + 1).min(120.0) / 120.0);
            world.step(&Input::force(AppliedForce { body: BodyId(3), point: DVec3::ZERO, force }));
        }
        (position(&world, 3) - start).x
    };
    let (below, above) = (moved(0.995), moved(1.005));
    assert!(below < 1e-5 && above > 1e-3, "{below} and {above} m");
}

#[test]
fn a_spinning_block_is_strained_by_the_forces_that_turn_its_particles() {
    for (stiffness, spin) in [(1e6, 60.0), (1e5, 20.0)] {
        let mut scene = Scene { form: Form::Lattice, gravity: 0.0, ..one() };
        scene.springs.stiffness = Some(stiffness);
        scene.blocks[0].pos[2] = 1.0;
        scene.blocks[0].spin = [0.0, 0.0, spin];
        let mut world = World::new(&scene, awake()).unwrap();
        let momentum = inertia(SIZE, MASS).z * spin;
        run(&mut world, 0.5, &Input::default());
        let (_, w) = motion(&world, 0);
        assert!((inertia(SIZE, MASS).z * w.z / momentum - 1.0).abs() < 1e-5, "{w}");
        // The virial of the springs is twice the energy of the rotation.
        let lattice = world.lattice(BodyId(0)).unwrap();
        let at = lattice.particles;
        let pairs = (0..8).flat_map(|i| (i + 1..8).map(move |j| (i, j)));
        let virial: f64 = pairs.zip(lattice.forces).map(|((i, j), force)| force * (at[j] - at[i]).length()).sum();
        let center = position(&world, 0);
        let squares: f64 = at.iter().map(|x| (*x - center).truncate().length_squared()).sum();
        let expected = MASS / 8.0 * w.z * w.z * squares;
        assert!((virial / expected - 1.0).abs() < 0.01, "{virial} {expected}");
    }
}

#[test]
fn a_soft_block_that_spins_about_any_axis_gains_no_energy() {
    // As fast as the softest springs that a scene may have can turn its particles.
    for spin in [[100.0, 100.0, 100.0], [150.0, 0.0, 120.0], [30.0, 160.0, 90.0]] {
        let mut scene = springs_of(1e3, in_space(one()));
        (scene.blocks[0].pos[2], scene.blocks[0].spin) = (1.0, spin);
        let mut world = World::new(&scene, awake()).unwrap();
        let mut last = world.energy();
        let start = last.total();
        for frame in 0..60 {
            world.step(&Input::default());
            let energy = world.energy();
            let gain = (energy.total() - last.total()) / start;
            assert!(gain < 1e-5, "{spin:?}, frame {frame}: {gain:.1e}, with {:.1e} in springs", energy.elastic / start);
            last = energy;
        }
    }
}

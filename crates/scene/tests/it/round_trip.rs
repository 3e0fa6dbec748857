//! JSON keeps every bit of every field.

use proptest::prelude::*;
use teeter_scene::{Block, Form, Particles, Scene, Springs, named};

fn vector(max: f64) -> impl Strategy<Value = [f64; 3]> {
    prop_oneof![Just([0.0; 3]), Just([0.0, -0.0, 0.0]), prop::array::uniform3(-max..max)]
}

/// Quaternions of a length within the tolerance of a file with few digits.
fn orientation() -> impl Strategy<Value = [f64; 4]> {
    (prop::array::uniform4(-1.0..1.0f64), 0.9991..1.0009f64)
        .prop_filter("a direction", |(q, _)| q.iter().map(|x| x * x).sum::<f64>() > 0.01)
        .prop_map(|(q, length)| {
            let scale = length / q.iter().map(|x| x * x).sum::<f64>().sqrt();
            q.map(|x| x * scale)
        })
}

/// Block within 0.1 m of the point 0.2 m above the floor.
fn block() -> impl Strategy<Value = Block> {
    let rotation = prop_oneof![
        (-12.0..12.0f64).prop_map(|yaw| (yaw, None)),
        Just((-0.0, None)),
        orientation().prop_map(|q| (0.0, Some(q)))
    ];
    let shape = (prop::array::uniform3(0.001..0.1f64), 1e-6..10.0f64, rotation);
    let motion = (vector(50.0), vector(500.0), any::<bool>(), prop::option::of(0.0..2.0f64));
    (any::<u32>(), shape, motion).prop_map(
        |(id, (size, mass, (yaw, orientation)), (velocity, spin, fixed, friction))| {
            let (velocity, spin) = if fixed { ([0.0; 3], [0.0; 3]) } else { (velocity, spin) };
            Block { yaw, orientation, velocity, spin, fixed, friction, ..Block::new(id, size, mass, [0.0, 0.0, 0.2]) }
        },
    )
}

fn springs() -> impl Strategy<Value = (Form, Springs)> {
    let particles = prop_oneof![Just(Particles::Inside), Just(Particles::Corners)];
    let form = prop_oneof![Just(Form::Rigid), Just(Form::Lattice)];
    (form, prop::option::of(1e3..1e8f64), 0.01..0.5f64, particles)
        .prop_map(|(form, stiffness, damping, particles)| (form, Springs { stiffness, damping, particles }))
}

fn scene() -> impl Strategy<Value = Scene> {
    let constants = (0.0..100.0f64, 0.0..2.0f64, prop::option::of(0.0..1.0f64), 0.0..1.0f64, 1e4..1e8f64);
    let label = prop::option::of(prop_oneof![Just("stable".to_owned()), Just("unstable".to_owned())]);
    let answers = (label, prop::option::of(-5.0..5.0f64), prop::option::of(-3.2..3.2f64));
    let radius = prop_oneof![Just(0.0), 0.0..3e-4f64];
    let blocks = prop::collection::vec(block(), 1..8);
    ("[^\\p{C}\\p{Zl}\\p{Zp}]{0,20}", constants, answers, springs(), radius, blocks).prop_map(
        |(name, constants, (label, margin, tilt_az), (form, springs), edge_radius, mut blocks)| {
            let (gravity, friction, kinetic, restitution, stiffness) = constants;
            for (i, block) in blocks.iter_mut().enumerate() {
                // Ids are unique and blocks apart.
                block.id = block.id / 8 * 8 + i as u32;
                block.pos[0] = 0.3 * i as f64 + 0.1 * block.size[0];
            }
            let kinetic_friction = kinetic.map(|share| share * friction);
            Scene {
                name,
                gravity,
                friction,
                kinetic_friction,
                restitution,
                stiffness,
                edge_radius,
                form,
                springs,
                blocks,
                label,
                margin,
                tilt_az,
            }
        },
    )
}

/// Bits of a scene's blocks, in which zeros of both signs differ.
fn bits(scene: &Scene) -> Vec<u64> {
    let numbers = scene.blocks.iter().flat_map(|b| {
        let scalars = [b.mass, b.yaw, b.friction.unwrap_or(-1.0)];
        let vectors = b.size.into_iter().chain(b.pos).chain(b.velocity).chain(b.spin);
        vectors.chain(scalars).chain(b.orientation.unwrap_or_default())
    });
    numbers.map(f64::to_bits).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn json_keeps_every_bit(scene in scene()) {
        let json = scene.to_json();
        let back = Scene::from_json(&json).unwrap();
        prop_assert_eq!(&back, &scene);
        prop_assert_eq!(bits(&back), bits(&scene));
        prop_assert_eq!(back.to_json(), json);
    }

    /// A file with few digits describes the same rotation but for its rounding.
    #[test]
    fn rotations_have_unit_length(block in block()) {
        let q = block.rotation();
        prop_assert!((q.iter().map(|x| x * x).sum::<f64>() - 1.0).abs() < 1e-15);
    }
}

#[test]
fn a_block_is_written_with_yaw_or_with_orientation() {
    let mut scene = named("block").unwrap();
    assert!(scene.to_json().contains("\"yaw\":0.0") && !scene.to_json().contains("orientation"));
    scene.blocks[0].orientation = Some([0.0, 0.0, 0.0, 1.0]);
    assert!(scene.to_json().contains("\"orientation\":[0.0,0.0,0.0,1.0]") && !scene.to_json().contains("yaw"));
    for absent in ["velocity", "spin", "fixed", "edge_radius"] {
        assert!(!scene.to_json().contains(absent), "{absent} has its default");
    }
}

//! Limits that constants set each other: what is accepted stays finite, what is refused does not.

use glam::DVec3;
use teeter_dissertation::jenga3d::{Constants, Disabling, Jenga3D, Method};
use teeter_scene::{Block, Scene, named};

fn alone() -> Scene {
    named("block").unwrap()
}

/// Returns the maximum speed of a particle of a block that is let vibrate in free space for half a
/// second, over that at the start; infinity where the block is torn.
fn growth(constants: &Constants) -> f64 {
    let mut one = Jenga3D::new(&alone(), Constants { row_spacing: 1.0, ..Constants::default() }).unwrap();
    // Past the check, which this measures.
    one.constants = Constants { gravity: 0.0, disabling: Disabling::Off, ..constants.clone() };
    for spring in &mut one.model.springs {
        (spring.stiffness, spring.damping) = (constants.stiffness, constants.damping);
    }
    let centre = one.centres()[0];
    for state in &mut one.curr {
        // The stiffest mode: every spring in proportion to its length.
        state.velocity = (state.position - centre) * 1e-3;
    }
    let speed = |one: &Jenga3D| one.curr.iter().map(|s| s.velocity.length()).fold(0.0, f64::max);
    let start = speed(&one);
    let steps = (0.5 / one.constants.step()).ceil().max(400.0) as u32;
    for _ in 0..steps {
        one.step(None);
        if one.first_non_finite().is_some() || speed(&one) > 1e3 * start {
            return f64::INFINITY;
        }
    }
    speed(&one) / start
}

/// Searches the largest accepted stiffness and damping of each method, and measures both sides.
#[test]
fn the_limit_of_the_springs_is_where_they_diverge() {
    for method in Method::ALL {
        for damping in [0.1, 2.0] {
            let of = |stiffness: f64| Constants { method, damping, stiffness, ..Constants::default() };
            let accepted = |stiffness: f64| Jenga3D::new(&alone(), of(stiffness)).is_ok();
            let (mut low, mut high) = (1.0, 1e9);
            if !accepted(low) {
                panic!("{} at {damping}", method.name());
            }
            for _ in 0..40 {
                let middle = f64::sqrt(low * high);
                if accepted(middle) { low = middle } else { high = middle }
            }
            let (below, above) = (growth(&of(0.97 * low)), growth(&of(1.05 * low)));
            println!("{} damping {damping}: {low:.4e} N/m, {below:.1e} {above:.1e}", method.name());
            assert!(below < 1.0, "{} {damping}: {low} N/m grows by {below}", method.name());
            assert!(above > 1e2, "{} {damping}: {low} N/m is refused and grows by {above}", method.name());
        }
    }
}

/// A message states a limit, and the limit is accepted.
#[test]
fn the_limit_of_a_message_is_accepted() {
    for (name, constants) in [
        ("stiffness", Constants { stiffness: 1e6, ..Constants::default() }),
        ("stiffness", Constants { stiffness: 1e9, method: Method::Rk4, ..Constants::default() }),
        ("damping", Constants { damping: 100.0, ..Constants::default() }),
        ("damping", Constants { damping: 50.0, method: Method::Midpoint, ..Constants::default() }),
        ("mid_loop_count", Constants { mid_loop_count: 10, ..Constants::default() }),
    ] {
        let error = Jenga3D::new(&alone(), constants.clone()).unwrap_err().to_string();
        let limit = error.split(" at most ").last().unwrap().split(" at least ").last().unwrap();
        let limit: String = limit.chars().take_while(|c| !" ,".contains(*c)).collect();
        let mut cured = constants;
        cured.set(name, &limit).unwrap_or_else(|e| panic!("{error}: {e}"));
        assert!(Jenga3D::new(&alone(), cured).is_ok(), "{error}");
    }
}

/// A block too light for its springs is refused, not torn.
#[test]
fn light_blocks_are_refused() {
    let mut scene = alone();
    scene.blocks[0].mass = 1e-9;
    let error = Jenga3D::new(&scene, Constants::default()).unwrap_err().to_string();
    assert!(error.contains("expected"), "{error}");
}

/// Orientation, velocity and spin of a scene reach the particles; a fixed block is refused by name.
#[test]
fn a_scene_keeps_its_motion_or_is_refused() {
    let mut scene = alone();
    let half_turn = std::f64::consts::FRAC_1_SQRT_2;
    scene.blocks[0] = Block {
        pos: [0.0, 0.0, 1.0],
        orientation: Some([0.0, half_turn, 0.0, half_turn]),
        velocity: [0.1, 0.0, 0.0],
        spin: [0.0, 0.0, 2.0],
        ..scene.blocks[0].clone()
    };
    let one = Jenga3D::new(&scene, Constants::default()).unwrap();
    let block = &one.model.blocks[0];
    let (centre, length) = (block.centre(&one.curr), scene.blocks[0].size[0]);
    // The length stands upright.
    assert!((one.top() - centre.z - 0.5 * length).abs() < 1e-12);
    for state in &one.curr {
        let expected = 0.1 * DVec3::X + 2.0 * DVec3::Z.cross(state.position - centre);
        assert!(state.velocity.distance(expected) < 1e-12);
    }
    let mut scene = alone();
    scene.blocks[0].fixed = true;
    let error = Jenga3D::new(&scene, Constants::default()).unwrap_err().to_string();
    assert_eq!(error, "block 0: `fixed` is true, expected false: the method of 2003 has no fixed blocks");
}

/// Section 5.2.2: a frame may cover the time that the last one took, up to the limit of the
/// springs.
#[test]
fn a_frame_covers_the_time_that_is_asked_for() {
    let mut falling = Jenga3D::new(&alone(), Constants { row_spacing: 0.5, ..Constants::default() }).unwrap();
    let start = falling.centres()[0].z;
    for time in [0.01, 0.03, 0.02] {
        falling.frame_over(time, None).unwrap();
    }
    assert!((falling.time - 0.06).abs() < 1e-12);
    assert_eq!(falling.constants.frame_rate, 60.0);
    let fallen = start - falling.centres()[0].z;
    assert!((fallen - 0.5 * 9.81 * 0.06 * 0.06).abs() < 1e-4, "{fallen}");
    let limit = falling.max_frame_time();
    assert!(falling.frame_over(0.99 * limit, None).is_ok());
    let error = falling.frame_over(1.01 * limit, None).unwrap_err().to_string();
    assert!(error.contains("springs diverge"), "{error}");
    // With g = 8 c / m and k = 8 k / m: 2 g h + k h² = 4 for half a step h of the loop.
    let (g, k) = (8.0 * 2.0 / (0.0196 / 8.0), 8.0 * 1e4 / (0.0196 / 8.0));
    let half_step = (-g + f64::sqrt(g * g + 4.0 * k)) / k;
    assert!((limit / (320.0 * half_step) - 1.0).abs() < 1e-9, "{limit}");
    assert!(falling.frame_over(0.0, None).is_err() && falling.frame_over(f64::NAN, None).is_err());
}

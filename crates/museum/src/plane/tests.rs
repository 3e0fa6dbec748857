//! Tests of the binding of the plane.

use serde_json::Value;

use super::*;

const METHODS: [&str; 4] = ["springs", "constraint", "penalty", "micro-collisions"];

fn plane(method: &str, setting: &str, count: u32) -> Plane {
    Plane::new(&format!(r#"{{"method": "{method}", "setting": "{setting}", "count": {count}, "gap": 0.004}}"#)).unwrap()
}

fn seconds(plane: &mut Plane, time: f64) -> Value {
    plane.advance((time / plane.step()) as u32);
    serde_json::from_str(&plane.report().unwrap()).unwrap()
}

fn corners(plane: &mut Plane) -> Vec<DVec2> {
    plane.corners_ptr();
    plane.corners.chunks(2).map(DVec2::from_slice).collect()
}

#[test]
fn a_block_has_four_corners_counter_clockwise() {
    for method in METHODS {
        let mut plane = plane(method, "stack", 3);
        let c = corners(&mut plane);
        assert_eq!((plane.length(), c.len()), (3, 12));
        for block in c.chunks(4) {
            let area: f64 = 0.5 * (0..4).map(|i| block[i].perp_dot(block[(i + 1) % 4])).sum::<f64>();
            assert!((area - 0.081 * 0.018).abs() < 1e-12, "{method}: {area}");
        }
    }
}

/// The contact points on the floor carry the whole weight.
#[test]
fn resting_forces_sum_to_the_weight() {
    for (method, within) in [("constraint", 1e-9), ("penalty", 0.01)] {
        let mut plane = plane(method, "stack", 4);
        seconds(&mut plane, 2.0);
        let floor: f64 = plane.contacts().chunks(5).filter(|c| c[1].abs() < 1e-3).map(|c| c[3].abs() * c[4]).sum();
        let weight = 4.0 * 0.0196 * 9.81;
        assert!((floor / weight - 1.0).abs() < within, "{method}: {floor} of {weight}");
    }
}

/// Figure 3.3: a stack that falls onto itself reaches the limit; springs need a few rounds (Figure
/// 3.5).
#[test]
fn a_falling_stack_reaches_the_limit_unless_it_is_springs() {
    let fallen = seconds(&mut plane("constraint", "falling", 8), 0.5);
    assert!(fallen["cut"].as_u64().unwrap() > 0 && fallen["most"] == 1000, "{fallen}");
    let fallen = seconds(&mut plane("springs", "falling", 8), 0.5);
    assert!(fallen["cut"] == 0 && fallen["most"].as_u64().unwrap() <= 3, "{fallen}");
}

/// The pointer pulls its block by the held point.
#[test]
fn a_pointer_pulls_a_block() {
    for method in METHODS {
        let mut plane = plane(method, "stack", 1);
        assert!(!plane.hold(0.2, 0.2));
        assert!(plane.held().is_empty());
        // At its centre: held at another point it would swing for long.
        assert!(plane.hold(0.0, 0.009));
        plane.drag(0.1, 0.05);
        seconds(&mut plane, 2.0);
        let held = plane.held();
        let (at, pointer) = (DVec2::new(held[0], held[1]), DVec2::new(held[2], held[3]));
        // It hangs on the spring of the pointer, lower by weight over stiffness.
        let sag = DVec2::new(0.0, -0.0196 * 9.81 / pointer::STIFFNESS);
        assert!(at.distance(pointer + sag) < 1e-4, "{method}: {at} {pointer}");
        plane.release();
        seconds(&mut plane, 1.0);
        assert!(plane.world.pose(0).0.y < 0.045, "{method}: {}", plane.world.pose(0).0);
    }
}

/// An added block falls freely: y = y0 - g t²/2.
#[test]
fn an_added_block_falls_freely() {
    for method in METHODS {
        let mut plane = plane(method, "stack", 1);
        plane.add(0.0, 0.5, 0.1, 0.0).unwrap();
        let time = 0.2;
        seconds(&mut plane, time);
        let expected = DVec2::new(0.1 * time, 0.5 - 0.5 * 9.81 * time * time);
        assert!(
            plane.world.pose(1).0.distance(expected) < 9.81 * time * plane.step() + 1e-6,
            "{method}: {}",
            plane.world.pose(1).0
        );
        while plane.length() < MAX_BLOCKS {
            plane.add(0.0, 1.0, 0.0, 0.0).unwrap();
        }
        assert_eq!(plane.add(0.0, 1.0, 0.0, 0.0).unwrap_err().to_string(), "there are 16 blocks, no more fit");
        assert!(plane.add(f64::NAN, 1.0, 0.0, 0.0).is_err());
    }
}

#[test]
fn a_section_of_a_tower_stands_with_every_method_with_friction() {
    for method in ["springs", "penalty", "micro-collisions"] {
        let mut plane = plane(method, "tower", 1);
        let top = |plane: &Plane| (0..plane.length()).map(|b| plane.world.pose(b).0.y).fold(0.0, f64::max);
        let before = top(&plane);
        seconds(&mut plane, 0.5);
        // The blocks of springs start apart; a fall would be half the height of a block.
        assert!((top(&plane) - before).abs() < 2e-3, "{method}: {} then {}", before, top(&plane));
    }
}

#[test]
fn invalid_options_give_one_line() {
    for options in [
        "",
        r#"{"method": "magic", "setting": "stack", "count": 3}"#,
        r#"{"method": "springs", "setting": "stack", "count": 0}"#,
        r#"{"method": "springs", "setting": "falling", "count": 3, "gap": -1}"#,
        r#"{"method": "springs", "setting": "stack", "count": 3, "stiffness": 1e9}"#,
    ] {
        let line = Plane::new(options).unwrap_err().to_string();
        assert!(!line.is_empty() && !line.contains('\n'), "{line}");
    }
}

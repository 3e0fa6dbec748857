//! Draws a loose block out of a tower by the hand, at 5 cm/s.
//!
//! cargo run --release --example pull_block

use teeter::{DVec3, Grip, Hand, Input, Params, World};

/// Speed of the hand, m/s.
const SPEED: f64 = 0.05;
/// Clearance past the block's own length, m.
const CLEARANCE: f64 = 0.005;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scene = teeter::scene::named("tower").expect("a named scene");
    let mut world = World::new(&scene, Params::default())?;
    world.run_for(2.0);

    let loads = teeter::study::xray(&world, scene.friction);
    let below_top = world.len() - 3;
    let loose = world.bodies().take(below_top).find(|body| loads[body.index()].is_loose());
    let body = loose.ok_or("every block of this tower carries load")?;

    let start = world.pose(body);
    let length = world.size(body).x;
    let anchor = DVec3::X * (0.5 * length);
    let travel = length + CLEARANCE;
    let hand = |distance: f64| {
        let target = start.transform_point(anchor + DVec3::X * distance);
        Hand::slide(body, anchor, target, start.orientation)
    };

    let others: Vec<_> = world.bodies().filter(|other| *other != body).collect();
    let before: Vec<_> = others.iter().map(|&other| world.pose(other).position).collect();
    let frames = world.frames(travel / SPEED);
    let mut max_force: f64 = 0.0;
    for frame in 1..=frames {
        let report = world.step(&Input::hand(hand(travel * frame as f64 / frames as f64)));
        max_force = max_force.max(report.hand.map_or(0.0, |hand| hand.force.length()));
    }
    // the block is out: the hand carries its whole weight now
    world.run_with(1.0, &Input::hand(Hand { grip: Grip::Carry, ..hand(travel) }));

    let displacement = |(&other, from): (&_, &DVec3)| world.pose(other).position.distance(*from);
    let disturbance = others.iter().zip(&before).map(displacement).fold(0.0, f64::max);
    println!("block {body}: drawn out with at most {max_force:.2} N");
    println!("the other blocks moved by at most {:.2} µm", 1e6 * disturbance);
    assert!(disturbance < 1e-3, "the tower was disturbed");
    Ok(())
}

//! Builds a full tower, lets it settle and prints how it stands.
//!
//! cargo run --release --example hello_tower

use teeter::{Params, World};

fn main() -> Result<(), teeter::BuildError> {
    let scene = teeter::scene::named("tower").expect("a named scene");
    let mut world = World::new(&scene, Params::default())?;
    let report = world.run_for(5.0);

    let top = world.bodies().map(|body| world.pose(body).position.z).fold(0.0, f64::max);
    println!("{} blocks, top block at {:.1} mm after {:.1} s", world.len(), 1e3 * top, report.time);
    println!("fastest block: {:.1e} m/s; blocks awake: {}", report.max_speed, report.awake);
    println!("state hash: {:016x}", world.hash());
    assert!(report.max_speed < 1e-3, "the tower does not stand still");
    Ok(())
}

//! Saves a world in mid-collapse, restores it twice, and shows that it continues bit for bit.
//!
//! cargo run --release --example save_and_restore

use teeter::{DVec3, Drive, Input, Params, SnapshotError, World};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scene = teeter::scene::named("tower").expect("a named scene");
    let mut world = World::new(&scene, Params::default())?;
    world.run_for(1.0);

    // sweep a row out from under the others
    let row: Vec<_> = world.bodies().skip(6).take(3).collect();
    let drives = row.iter().map(|&body| Drive::new(body, DVec3::new(2.0, 0.0, 0.0))).collect();
    world.run_with(0.2, &Input::drives(drives));

    let saved = world.snapshot();
    println!("saved {} bytes at {:.2} s", saved.len(), world.time());
    let mut hashes = Vec::new();
    for _ in 0..2 {
        world.restore(&saved)?;
        world.run_for(1.0);
        hashes.push(world.hash());
        println!("{:.2} s: {:016x}", world.time(), world.hash());
    }
    assert_eq!(hashes[0], hashes[1], "a restored world must continue bit for bit");

    // bytes that are no snapshot change nothing
    assert_eq!(world.restore(b"nonsense"), Err(SnapshotError::Header));
    assert_eq!(world.hash(), hashes[1]);
    Ok(())
}

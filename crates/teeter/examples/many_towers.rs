//! Steps towers of different seeds on all cores and prints how many loose blocks each has.
//!
//! cargo run --release --example many_towers

use teeter::{Params, TowerOptions, World};

/// Number of towers.
const TOWERS: u64 = 8;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let seeds: Vec<u64> = (1..=TOWERS).collect();
    let results = teeter::study::par_map(&seeds, |&seed| -> Result<(usize, u64), String> {
        let options = TowerOptions { rows: 12, seed, ..TowerOptions::default() };
        let scene = teeter::scene::tower(&options).map_err(|e| e.to_string())?;
        let mut world = World::new(&scene, Params::default()).map_err(|e| e.to_string())?;
        world.run_for(2.0);
        let loads = teeter::study::xray(&world, scene.friction);
        let below_top = world.len() - 3;
        Ok((loads[..below_top].iter().filter(|load| load.is_loose()).count(), world.hash()))
    });
    for (seed, result) in seeds.iter().zip(results) {
        let (loose, hash) = result?;
        println!("seed {seed}: {loose} of 33 blocks below the top row are loose, state {hash:016x}");
    }
    Ok(())
}

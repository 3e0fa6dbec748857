//! Draws loose blocks of default towers out and pushes them in again, and prints how many others
//! moved. Arguments: the radius of the edges in mm (that of the scene where absent), the number of
//! towers (4), and of loose blocks a tower (6).
//!
//! cargo run --release -p teeter-study --features parallel --example put_back -- 0.5 4 6

use teeter_physics::{BodyId, Params, World};
use teeter_scene::{TowerOptions, tower};
use teeter_study::{PutBack, PutBackOptions, par_map, put_back, settled, xray};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let argument = |index: usize| std::env::args().nth(index).map(|text| text.parse::<f64>()).transpose();
    let (radius, towers, blocks) = (argument(1)?, argument(2)?.unwrap_or(4.0), argument(3)?.unwrap_or(6.0));
    let seeds: Vec<u64> = (1..=towers as u64).collect();
    let worlds = par_map(&seeds, |&seed| -> Result<World, String> {
        let mut scene = tower(&TowerOptions { seed, ..TowerOptions::default() }).map_err(|e| e.to_string())?;
        scene.edge_radius = radius.map_or(scene.edge_radius, |radius| 1e-3 * radius);
        settled(&scene, Params { sleep: false, ..Params::default() }).map_err(|e| e.to_string())
    });
    let worlds = worlds.into_iter().collect::<Result<Vec<World>, _>>()?;
    let loose = |world: &World| -> Vec<BodyId> {
        let loads = xray(world, world.scene().friction);
        let below_top = world.bodies().take(world.len() - 3);
        below_top.filter(|body| loads[body.index()].is_loose()).take(blocks as usize).collect()
    };
    let cases: Vec<(&World, BodyId)> =
        worlds.iter().flat_map(|world| loose(world).into_iter().map(move |body| (world, body))).collect();
    println!("drawn, mm  pulls  others > 1 mm  > 5 mm  fell  worst, mm  force, N");
    for distance in [0.01, 0.02, 0.04, 0.06] {
        let backs = par_map(&cases, |&(world, body)| put_back(world, body, distance, &PutBackOptions::default()));
        let share = |has: fn(&PutBack) -> bool| {
            100.0 * backs.iter().filter(|back| has(back)).count() as f64 / backs.len() as f64
        };
        let mut forces: Vec<f64> = backs.iter().map(|back| back.force_n).collect();
        forces.sort_by(f64::total_cmp);
        println!(
            "{:>9.0}  {:>5}  {:>11.1} %  {:>4.1} %  {:>4}  {:>9.3}  {:>8.3}",
            1e3 * distance,
            backs.len(),
            share(|back| back.moved_1_mm > 0),
            share(|back| back.moved_5_mm > 0),
            backs.iter().filter(|back| back.fell > 0).count(),
            backs.iter().map(|back| back.worst_mm).fold(0.0, f64::max),
            forces.get(forces.len() / 2).copied().unwrap_or(0.0),
        );
    }
    Ok(())
}

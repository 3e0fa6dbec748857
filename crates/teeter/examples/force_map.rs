//! Prints the force that starts each block of a small tower sliding, beside the exact answer of
//! rigid blocks.
//!
//! cargo run --release --example force_map

use teeter::{Params, TowerOptions};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let options = TowerOptions::exact();
    let scene = teeter::scene::config("(1L1)-(111)-(L1L)-(010)", &options)?;
    let map = teeter::study::force_map(&scene, Params::default(), || ())?;

    println!("block  breakaway force, N  rigid blocks, N  load, N");
    for block in &map {
        let measured = block.forward_n.map_or("over 10".to_owned(), |force| format!("{force:.3}"));
        let exact = block.exact.as_ref().map_or("-".to_owned(), |exact| format!("{:.3}", exact.straight_n));
        println!("{:>5}  {measured:>18}  {exact:>15}  {:>7.3}", block.id, block.load.above_n);
    }
    let loose = map.iter().filter(|block| block.load.is_loose()).count();
    println!("{loose} of {} blocks carry nothing", map.len());
    Ok(())
}

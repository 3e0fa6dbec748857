//! `teeter forces`: the force that starts each block sliding, both ways along its long axis.

use serde::Serialize;
use teeter_study::{BlockForces, force_map};

use crate::args::Forces;
use crate::fault::Fault;
use crate::{input, output};

#[derive(Serialize)]
struct Report {
    blocks: Vec<BlockForces>,
}

/// Measures every block of a scene from one settled state, on all cores, and prints the forces.
pub fn main(args: Forces) -> Result<(), Fault> {
    let scene = args.engine.material.applied(input::scene(&args.scene)?);
    let bar = output::progress(scene.blocks.len() as u64, "blocks");
    let blocks = force_map(&scene, args.engine.params(false), || bar.inc(1)).map_err(|e| Fault::at(&scene.name, e))?;
    bar.finish_and_clear();
    if args.json {
        return output::line(&output::json(&Report { blocks }));
    }
    let newtons = |force: Option<f64>| force.map_or("-".into(), |f| format!("{f:.3}"));
    let row = |cells: [String; 7]| {
        let [id, ahead, back, straight, turning, tipping, load] = cells;
        output::line(&format!("{id:>5} {ahead:>10} {back:>10} {straight:>10} {turning:>10} {tipping:>10} {load:>10}"))
    };
    output::line(&format!(
        "{}: forces in N; - is none below {} N, or no exact answer",
        scene.name,
        teeter_study::MAX_BREAKAWAY_FORCE
    ))?;
    row(["block", "forward", "backward", "straight", "turning", "tipping", "load"].map(Into::into))?;
    for b in &blocks {
        let (straight, turning, tipping) =
            (b.exact.map(|e| e.straight_n), b.exact.map(|e| e.turning_n), b.exact.and_then(|e| e.tipping_n));
        let [ahead, back] = b.both().map(newtons);
        row([
            b.id.to_string(),
            ahead,
            back,
            newtons(straight),
            newtons(turning),
            newtons(tipping),
            newtons(Some(b.load.above_n)),
        ])?;
    }
    Ok(())
}

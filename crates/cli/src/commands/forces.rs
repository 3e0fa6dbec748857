//! `teeter forces`: breakaway force of each block, in both directions along its length.

use std::path::PathBuf;

use clap::Args;
use serde::Serialize;
use teeter_report::progress;
use teeter_scene::Scene;
use teeter_study::{BlockForces, MAX_BREAKAWAY_FORCE, force_map_from, settled};

use crate::arguments::EngineArguments;
use crate::error::Error;
use crate::warnings::Warnings;
use crate::{input, output};

/// Arguments of `teeter forces`.
#[derive(Debug, Args)]
#[command(allow_negative_numbers = true)]
pub struct Forces {
    /// File of a scene, `-` for standard input, or the name of a scene of the list.
    scene: PathBuf,
    #[command(flatten)]
    engine: EngineArguments,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct Report {
    blocks: Vec<BlockForces>,
    warnings: Warnings,
}

impl Forces {
    /// Measures every block of a scene from one settled state, on all cores, and prints the forces.
    pub fn run(self) -> Result<(), Error> {
        let scene = self.engine.material.apply(input::scene(&self.scene)?);
        let build = |source| Error::Build { name: scene.name.clone(), source };
        let world = settled(&scene, self.engine.params(false)).map_err(build)?;
        let mut warnings = Warnings::default();
        warnings.add_all_of(&world);
        let bar = progress(scene.blocks.len() as u64, "blocks");
        let blocks = force_map_from(&scene, &world, || bar.inc(1));
        bar.finish_and_clear();
        if self.json { output::json(&Report { blocks, warnings }) } else { print(&scene, &blocks) }
    }
}

fn print(scene: &Scene, blocks: &[BlockForces]) -> Result<(), Error> {
    let row = |cells: [String; 7]| {
        let [id, forward, backward, straight, turning, tipping, load] = cells;
        output::line(&format!(
            "{id:>5} {forward:>10} {backward:>10} {straight:>10} {turning:>10} {tipping:>10} {load:>10}"
        ))
    };
    let newtons = |force: Option<f64>| force.map_or("-".into(), |force| format!("{force:.3}"));
    output::line(&format!("{}: forces in N; - is none below {MAX_BREAKAWAY_FORCE} N, or no exact answer", scene.name))?;
    row(["block", "forward", "backward", "straight", "turning", "tipping", "load"].map(Into::into))?;
    for block in blocks {
        let exact = block.exact;
        row([
            block.id.to_string(),
            newtons(block.forward_n),
            newtons(block.backward_n),
            newtons(exact.map(|exact| exact.straight_n)),
            newtons(exact.map(|exact| exact.turning_n)),
            newtons(exact.and_then(|exact| exact.tipping_n)),
            newtons(Some(block.load.above_n)),
        ])?;
    }
    Ok(())
}

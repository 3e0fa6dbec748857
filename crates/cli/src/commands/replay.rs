//! `teeter replay`: plays the record of a game again, and verifies that it is the same.

use std::path::PathBuf;

use clap::Args;
use serde::Serialize;
use teeter_game::{Divergence, Record, RecordError, Replay as Game, Rules, Verification, engine_id, verify};

use crate::error::Error;
use crate::game_event::GameEvent;
use crate::warnings::Warnings;
use crate::{input, output};

/// Arguments of `teeter replay`.
#[derive(Debug, Args)]
pub struct Replay {
    /// File of a record; `-` for standard input.
    file: PathBuf,
    /// Compare each frame with the checks of the record, and name the frame, the time and the block
    /// where it diverges. Exit code 0 where the replay is the same, 1 where it diverges.
    #[arg(long)]
    verify: bool,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct Verified {
    same: bool,
    diverged_at_s: Option<f64>,
    hash: String,
    frame: Option<u32>,
    block: Option<Block>,
    frames: u32,
    seconds: f64,
    warnings: Warnings,
}

/// Block that is elsewhere than in the record.
#[derive(Serialize)]
struct Block {
    id: u32,
    displacement_mm: f64,
    at_s: f64,
}

#[derive(Serialize)]
struct Played<'a> {
    scene: &'a str,
    players: &'a [String],
    rules: Rules,
    engine: &'a str,
    frames: u32,
    seconds: f64,
    hash: String,
    events: Vec<GameEvent>,
    warnings: Warnings,
}

impl Replay {
    /// Plays a record and prints its events, or whether it is the same.
    pub fn run(self) -> Result<(), Error> {
        let (record, name) = input::record(&self.file)?;
        let refused = |error: RecordError| Error::Record { name: name.clone(), source: error };
        let mut warnings = Warnings::default();
        if record.engine != engine_id() {
            warnings.add_engine(&record.engine, "its bits may differ");
        }
        if self.verify {
            self.verified(&record, verify(&record).map_err(refused)?, warnings)
        } else {
            self.played(&record, Game::new(&record).map_err(refused)?, warnings)
        }
    }

    fn verified(&self, record: &Record, result: Verification, warnings: Warnings) -> Result<(), Error> {
        let divergence = result.divergence;
        let block = divergence.and_then(|divergence| divergence.block).map(|block| Block {
            id: record.scene.blocks[block.body.index()].id,
            displacement_mm: 1e3 * block.distance,
            at_s: block.time_s,
        });
        let report = Verified {
            same: result.same,
            diverged_at_s: divergence.map(|divergence| divergence.time_s),
            hash: format!("{:016x}", result.hash),
            frame: divergence.map(|divergence| divergence.frame),
            block,
            frames: record.frames(),
            seconds: record.seconds(),
            warnings,
        };
        if self.json {
            output::json(&report)?
        } else {
            output::line(&report.text(divergence))?
        }
        if result.same { Ok(()) } else { Err(Error::Diverged) }
    }

    fn played(&self, record: &Record, mut game: Game, warnings: Warnings) -> Result<(), Error> {
        let mut events = Vec::new();
        while let Some(update) = game.step() {
            events.extend(GameEvent::of(&record.scene, &update));
        }
        let report = Played {
            scene: &record.scene.name,
            players: record.players.as_slice(),
            rules: record.rules,
            engine: &record.engine,
            frames: record.frames(),
            seconds: record.seconds(),
            hash: format!("{:016x}", game.game().hash()),
            events,
            warnings,
        };
        if self.json {
            return output::json(&report);
        }
        report.events.iter().try_for_each(|event| output::line(&event.line()))?;
        let Played { scene, players, frames, seconds, hash, .. } = &report;
        let players: String = players.iter().map(|name| format!(", {name}")).collect();
        output::line(&format!("{scene}{players}: {frames} frames, {seconds:.2} s, hash {hash}"))
    }
}

impl Verified {
    fn text(&self, divergence: Option<Divergence>) -> String {
        let Some(Divergence { frame, time_s, .. }) = divergence else {
            return format!("the same: {} frames, {:.2} s, hash {}", self.frames, self.seconds, self.hash);
        };
        let block = self.block.as_ref().map_or("no block is visibly elsewhere".to_owned(), |block| {
            let Block { id, displacement_mm, at_s } = block;
            format!("block {id} is {displacement_mm:.3} mm from where the record has it at {at_s:.2} s")
        });
        format!("diverges in frame {frame}, at {time_s:.2} s: {block}")
    }
}

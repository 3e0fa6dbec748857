//! `teeter record`: plays the commands of a file and writes the record of the game.

use std::path::{Path, PathBuf};

use clap::Args;
use serde::Serialize;
use teeter_game::{Command, PlayerNames, Recorder};
use teeter_physics::Params;
use teeter_scene::MAX_BYTES;

use crate::arguments::RulesArguments;
use crate::error::Error;
use crate::game_event::GameEvent;
use crate::output::Output;
use crate::{input, output};

/// Arguments of `teeter record`.
#[derive(Debug, Args)]
pub struct Record {
    /// File of a scene, `-` for standard input, or the name of a scene of the list.
    scene: PathBuf,
    /// File of the commands of a game, one JSON object a line and a frame; an empty line is a frame
    /// without one; `-` for standard input.
    #[arg(long, value_name = "FILE")]
    commands: PathBuf,
    /// File for the record.
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    #[command(flatten)]
    rules: RulesArguments,
    /// Names of the players in the order of their turns, separated by commas: at most 40 characters
    /// each.
    #[arg(long, value_delimiter = ',')]
    names: Vec<String>,
    /// Frames after which the whole state is stored besides, so that a replay can begin there.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    states_every: Option<u32>,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct Report {
    frames: u32,
    seconds: f64,
    bytes: usize,
    hash: String,
    events: Vec<GameEvent>,
}

impl Record {
    /// Plays the game and writes its record.
    pub fn run(self) -> Result<(), Error> {
        if self.scene == Path::new("-") && self.commands == self.scene {
            return Err(Error::StdinTwiceCommands);
        }
        let scene = input::scene(&self.scene)?;
        let (text, name) = input::text(&self.commands, MAX_BYTES)?;
        let rules = self.rules.rules()?;
        let mut out = Output::create(&self.out)?;
        let game = |source| Error::Record { name: scene.name.clone(), source };
        let mut recorder = Recorder::new(&scene, Params::default(), rules).map_err(game)?;
        if let Some(frames) = self.states_every {
            recorder = recorder.with_states(frames);
        }
        let mut events = Vec::new();
        for (index, line) in text.lines().enumerate() {
            let command =
                parse(line).map_err(|message| Error::Command { name: name.clone(), line: index + 1, message })?;
            let update = recorder.step(&command).map_err(game)?;
            events.extend(GameEvent::of(&scene, &update));
        }
        let hash = format!("{:016x}", recorder.game().hash());
        let mut record = recorder.finish();
        record.players = PlayerNames::new(&self.names);
        let bytes = record.encode();
        out.bytes(&bytes)?;
        let to_stdout = out.is_stdout();
        out.finish()?;
        let (frames, seconds) = (record.frames(), record.seconds());
        let report = Report { frames, seconds, bytes: bytes.len(), hash, events };
        let text = if self.json { output::to_json(&report) } else { report.text(&scene.name) };
        output::report(&text, to_stdout)
    }
}

fn parse(line: &str) -> Result<Command, String> {
    if line.trim().is_empty() {
        return Ok(Command::Idle);
    }
    serde_json::from_str(line).map_err(|error| {
        let message = error.to_string();
        // The line is that of the file.
        let message = message.rsplit_once(" at line ").map_or(message.as_str(), |(start, _)| start);
        format!("{message} (column {})", error.column())
    })
}

impl Report {
    fn text(&self, scene: &str) -> String {
        let summary =
            format!("{scene}: {} frames, {:.2} s, {} bytes, hash {}", self.frames, self.seconds, self.bytes, self.hash);
        self.events.iter().map(GameEvent::line).chain([summary]).collect::<Vec<_>>().join("\n")
    }
}

//! Commands of the shell, a file each.

mod analyse;
mod calibrate;
mod dissertation;
mod forces;
mod play;
mod record;
mod render;
mod replay;
mod run;
mod scene;
mod score;
mod tournament;
mod validate;

use clap::Subcommand;

use crate::error::Error;
use crate::interrupt;

/// Command with its arguments.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Serve the page on this machine and open it: play.
    Play(play::Play),
    /// Print a scene: a tower, a configuration, or one of the list.
    Scene(scene::Scenes),
    /// Simulate a scene and report whether it stands.
    Run(run::Run),
    /// Draw a scene as a picture or a film, without a display.
    Render(render::Render),
    /// Play the commands of a game and write its record.
    Record(record::Record),
    /// Play the record of a game again, and verify that it is the same.
    Replay(replay::Replay),
    /// Find the chance that taking each block fells a tower, or the moves of a recorded game.
    Analyse(analyse::Analyse),
    /// Hold chances of a fall against the outcome of moves that are then played.
    Calibrate(calibrate::Calibrate),
    /// Play opponents against each other, a record a game, with a table of results.
    Tournament(tournament::Tournament),
    /// Predict labelled towers: which fall, or at what tilt.
    Score(score::Score),
    /// Measure the force that starts each block sliding, beside that of rigid blocks.
    Forces(forces::Forces),
    /// Measure the engine against exact mechanics and data of real towers, and write a report.
    Validate(validate::Validate),
    /// The 2003 dissertation: its simulators and results.
    Dissertation(dissertation::Dissertation),
}

impl Command {
    /// Runs the command.
    pub fn run(self) -> Result<(), Error> {
        // The server ends by itself when it is interrupted.
        if !matches!(self, Command::Play(_)) {
            interrupt::watch();
        }
        match self {
            Command::Play(play) => play.run(),
            Command::Scene(scenes) => scenes.run(),
            Command::Run(run) => run.run(),
            Command::Render(render) => render.run(),
            Command::Record(record) => record.run(),
            Command::Replay(replay) => replay.run(),
            Command::Analyse(analyse) => analyse.run(),
            Command::Calibrate(calibrate) => calibrate.run(),
            Command::Tournament(tournament) => tournament.run(),
            Command::Score(score) => score.run(),
            Command::Forces(forces) => forces.run(),
            Command::Validate(validate) => validate.run(),
            Command::Dissertation(dissertation) => dissertation.run(),
        }
    }
}

//! Commands of a game, one a frame, with runs of the same command stored once.

use crate::command::Command;
use crate::record::error::RecordError;

/// Maximum number of frames: a day at sixty a second.
pub const MAX_FRAMES: u32 = 24 * 60 * 60 * 60;

/// A command, and the number of frames in which it is given, one after the other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Run {
    /// The command.
    pub command: Command,
    /// Number of frames, at least 1.
    pub frames: u32,
}

/// Commands of a game.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Tape {
    runs: Vec<Run>,
    frames: u32,
}

impl Tape {
    /// Appends a run.
    pub fn push(&mut self, run: Run) -> Result<(), RecordError> {
        let frames = self.frames.checked_add(run.frames).filter(|frames| *frames <= MAX_FRAMES);
        self.frames = frames.ok_or(RecordError::Full(MAX_FRAMES))?;
        match self.runs.last_mut() {
            Some(last) if is_same(&last.command, &run.command) => last.frames += run.frames,
            _ => self.runs.push(run),
        }
        Ok(())
    }

    /// The runs.
    pub fn runs(&self) -> &[Run] {
        &self.runs
    }

    /// Number of frames.
    pub fn frames(&self) -> u32 {
        self.frames
    }

    /// Drops the commands from a frame on.
    pub fn truncate(&mut self, frames: u32) {
        let Cursor { run, frame } = self.cursor(frames);
        self.runs.truncate(run + usize::from(frame > 0));
        if let Some(last) = self.runs.get_mut(run) {
            last.frames = frame;
        }
        self.frames = self.frames.min(frames);
    }

    /// Position before a frame, counted from 0.
    pub fn cursor(&self, frame: u32) -> Cursor {
        let mut cursor = Cursor { run: 0, frame };
        while let Some(run) = self.runs.get(cursor.run).filter(|run| run.frames <= cursor.frame) {
            cursor = Cursor { run: cursor.run + 1, frame: cursor.frame - run.frames };
        }
        cursor
    }

    /// The next command; none after the last.
    pub fn next(&self, cursor: &mut Cursor) -> Option<Command> {
        let run = self.runs.get(cursor.run)?;
        cursor.frame += 1;
        if cursor.frame >= run.frames {
            *cursor = Cursor { run: cursor.run + 1, frame: 0 };
        }
        Some(run.command)
    }

    /// Commands from a frame on, one a frame.
    pub fn from(&self, frame: u32) -> impl Iterator<Item = Command> + '_ {
        let mut cursor = self.cursor(frame);
        std::iter::from_fn(move || self.next(&mut cursor))
    }
}

/// Position between two commands.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Cursor {
    run: usize,
    /// Frames of the run that are passed.
    frame: u32,
}

/// Returns true if two commands are the same, bit for bit. Those that are rarely given twice in a
/// row are not compared.
fn is_same(a: &Command, b: &Command) -> bool {
    let bits = |command: &Command| match command {
        Command::Move { displacement, slot, toward_viewer } => {
            let viewer = toward_viewer.map(|v| v.to_array().map(f64::to_bits));
            Some((displacement.to_array().map(f64::to_bits), *slot, viewer))
        }
        _ => None,
    };
    match (a, b) {
        (Command::Move { .. }, Command::Move { .. }) => bits(a) == bits(b),
        (Command::Idle, Command::Idle) => true,
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    fn step(displacement: DVec3) -> Command {
        Command::Move { displacement, slot: None, toward_viewer: None }
    }

    #[test]
    fn runs_of_the_same_command_are_one_and_give_back_each_frame() {
        let mut tape = Tape::default();
        let commands = [Command::Idle, Command::Idle, step(DVec3::ONE), step(DVec3::ONE), Command::Poke, Command::Idle];
        for command in commands {
            tape.push(Run { command, frames: 1 }).unwrap();
        }
        assert_eq!((tape.runs().len(), tape.frames()), (4, 6));
        for frame in 0..=6 {
            assert_eq!(tape.from(frame).collect::<Vec<_>>(), commands[frame as usize..], "from {frame}");
        }
    }

    #[test]
    fn a_tape_that_is_cut_has_the_commands_before_the_cut() {
        let mut tape = Tape::default();
        let commands = [Command::Idle, Command::Idle, step(DVec3::ONE), Command::Poke, Command::Idle];
        for command in commands {
            tape.push(Run { command, frames: 1 }).unwrap();
        }
        for cut in 0..=6 {
            let mut tape = tape.clone();
            tape.truncate(cut);
            let left = &commands[..(cut as usize).min(5)];
            assert_eq!((tape.from(0).collect::<Vec<_>>(), tape.frames()), (left.to_vec(), left.len() as u32));
        }
    }

    #[test]
    fn a_tape_ends_after_a_day() {
        let mut tape = Tape::default();
        tape.push(Run { command: Command::Idle, frames: MAX_FRAMES }).unwrap();
        assert!(tape.push(Run { command: Command::Idle, frames: 1 }).is_err());
        assert!(tape.push(Run { command: Command::Idle, frames: u32::MAX }).is_err());
    }

    #[test]
    fn zeros_of_different_sign_are_different_commands() {
        let mut tape = Tape::default();
        for x in [0.0, -0.0] {
            tape.push(Run { command: step(DVec3::new(x, 1.0, 1.0)), frames: 1 }).unwrap();
        }
        let bits: Vec<u64> = tape
            .from(0)
            .map(|command| match command {
                Command::Move { displacement, .. } => displacement.x.to_bits(),
                _ => unreachable!(),
            })
            .collect();
        assert_eq!(bits, [0.0f64.to_bits(), (-0.0f64).to_bits()]);
    }
}

//! A recorded game that goes on.

use crate::game::Game;
use crate::record::error::RecordError;
use crate::record::file::Record;
use crate::record::recorder::RecordWriter;
use crate::record::replay::Replay;

/// Returns the game of a record where the record ends, and the writer that goes on with it. It is
/// the game that was recorded, bit for bit. A state at the end of the record saves the replay.
///
/// # Errors
/// When no game begins like this, or the replay is not the same.
///
/// ```
/// use teeter_game::{Command, Recorder, Rules, resume};
/// use teeter_physics::Params;
///
/// let scene = teeter_scene::named("column").unwrap();
/// let mut recorder = Recorder::new(&scene, Params::default(), Rules::default())?;
/// recorder.step(&Command::Idle)?;
/// let (mut game, mut writer) = resume(recorder.clone().finish())?;
/// game.step(&Command::Idle);
/// writer.write(&Command::Idle, &game)?;
/// recorder.step(&Command::Idle)?;
/// assert_eq!(writer.finish(&game), recorder.finish());
/// # Ok::<(), teeter_game::RecordError>(())
/// ```
pub fn resume(mut record: Record) -> Result<(Game, RecordWriter), RecordError> {
    let frames = record.frames();
    let mut replay = Replay::near(&record, frames)?;
    while replay.step().is_some() {}
    if record.samples.last().is_some_and(|sample| sample.hash != replay.game().state_hash()) {
        return Err(RecordError::Diverged(frames));
    }
    let (game, _) = replay.play_on()?;
    // The state of the end has served: a record that goes on does not carry it along.
    record.states.retain(|state| state.frame < frames);
    Ok((game, RecordWriter::resume(record, frames)))
}

#[cfg(test)]
mod tests {
    use glam::DVec3;
    use teeter_physics::{BodyId, Params};
    use teeter_scene::{TowerOptions, tower};

    use super::*;
    use crate::command::Command;
    use crate::hand::grip::GripMode;
    use crate::record::recorder::Recorder;
    use crate::rules::table::{Rules, Table};

    fn commands() -> Vec<Command> {
        let grasp = Command::Grasp { body: BodyId(10), anchor: DVec3::ZERO, normal: DVec3::Z, grip: GripMode::Auto };
        let up = Command::Move { displacement: DVec3::Z * 0.002, slot: None, toward_viewer: None };
        [vec![Command::Idle; 30], vec![grasp], vec![up; 40], vec![Command::Idle; 60]].concat()
    }

    fn recorder() -> Recorder {
        let scene = tower(&TowerOptions { rows: 4, ..TowerOptions::default() }).unwrap();
        Recorder::new(&scene, Params::default(), Rules::of(Table::Dissertation, 2)).unwrap()
    }

    #[test]
    fn a_game_resumed_at_any_frame_with_or_without_its_state_has_the_record_of_the_whole() {
        let commands = commands();
        let mut whole = recorder();
        let mut writer = RecordWriter::new(&whole.clone().finish().scene, Params::default(), whole.game().rules());
        let mut ends = Vec::new();
        for (k, command) in commands.iter().enumerate() {
            whole.step(command).unwrap();
            writer.write(command, whole.game()).unwrap();
            if [0, 29, 45, 59, 60, 90].contains(&k) {
                ends.push(whole.clone().finish());
                ends.push(Record::decode(&writer.clone().finish_with_state(whole.game()).encode()).unwrap());
            }
        }
        let whole = whole.finish();
        for end in ends {
            let from = end.frames();
            let (mut game, mut writer) = resume(end).unwrap();
            for command in whole.commands(from) {
                game.step(&command);
                writer.write(&command, &game).unwrap();
            }
            assert_eq!(writer.finish(&game), whole, "from frame {from}");
        }
    }

    #[test]
    fn a_state_of_another_instant_does_not_go_on_as_the_game() {
        let mut recorder = recorder();
        let early = recorder.clone();
        commands().iter().for_each(|command| drop(recorder.step(command).unwrap()));
        let mut record = recorder.finish();
        let frame = record.frames();
        let bytes = early.game().snapshot();
        record.states.push(crate::record::file::StateFrame { frame, bytes });
        assert_eq!(resume(record).unwrap_err(), RecordError::Diverged(frame));
    }
}

//! Commands as bytes: a byte for the kind, with flags, and what differs from the command before.

use glam::{DQuat, DVec2, DVec3};
use teeter_physics::BodyId;
use teeter_scene::Form;

use crate::command::Command;
use crate::hand::grip::GripMode;
use crate::record::bytes::{Reader, Writer, multiple};
use crate::record::error::RecordError;
use crate::record::tape::{Run, Tape};
use crate::tower_map::CellId;

/// Displacements that are short: multiples of ten micrometres.
const COARSE: f64 = 1e5;

/// Kinds of commands: the low four bits of a run's first byte.
const IDLE: u8 = 0;
const GRASP: u8 = 1;
const MOVE: u8 = 2;
const TURN: u8 = 3;
const PUT_DOWN: u8 = 4;
const POKE: u8 = 5;
const RELEASE: u8 = 6;
const SET_HAND: u8 = 7;
const SET_BLOCKS: u8 = 8;
const RESIGN: u8 = 9;
const REBUILD: u8 = 10;
/// Flags of any command: it is given in more than one frame; and of a movement: its displacement is
/// a difference of multiples, it has a slot, its direction to the viewer is new.
const REPEATED: u8 = 1 << 4;
const COARSE_MOVE: u8 = 1 << 5;
const SLOT: u8 = 1 << 6;
const VIEWER: u8 = 1 << 7;

/// Values that the next command is coded against.
#[derive(Debug, Default)]
struct Before {
    /// Last displacement, in multiples.
    displacement: [i64; 3],
    /// Direction to the viewer of the last movement.
    viewer: Option<DVec2>,
    slot: Option<CellId>,
}

/// Writes all commands.
pub fn write(tape: &Tape) -> Vec<u8> {
    let (mut writer, mut before) = (Writer::default(), Before::default());
    for run in tape.runs() {
        write_run(&mut writer, run, &mut before);
    }
    writer.0
}

/// Reads all commands.
pub fn read(bytes: &[u8]) -> Result<Tape, RecordError> {
    let (mut reader, mut before) = (Reader::new(bytes, "its commands"), Before::default());
    let mut tape = Tape::default();
    while !reader.is_empty() {
        let run = read_run(&mut reader, &mut before)?;
        tape.push(run)?;
    }
    Ok(tape)
}

fn write_run(writer: &mut Writer, run: &Run, before: &mut Before) {
    let kind = |writer: &mut Writer, kind: u8| write_kind(writer, kind, run.frames);
    match run.command {
        Command::Idle => kind(writer, IDLE),
        Command::Poke => kind(writer, POKE),
        Command::Release => kind(writer, RELEASE),
        Command::Resign => kind(writer, RESIGN),
        Command::Rebuild => kind(writer, REBUILD),
        Command::Grasp { body, anchor, normal, grip } => {
            kind(writer, GRASP);
            writer.unsigned(u64::from(body.0));
            vector(writer, anchor);
            vector(writer, normal);
            writer.byte(grip_code(grip));
        }
        Command::Move { displacement, slot, toward_viewer } => {
            let movement = Movement { displacement, slot, toward_viewer };
            write_move(writer, run.frames, &movement, before);
        }
        Command::Turn { rotation } => {
            kind(writer, TURN);
            rotation.to_array().iter().for_each(|x| writer.number(*x));
        }
        Command::Place { body, slot } => {
            kind(writer, PUT_DOWN);
            write_option(writer, body, |writer, body| writer.unsigned(u64::from(body.0)));
            write_slot(writer, slot);
        }
        Command::SetHand { max_force, careful, can_turn, grip } => {
            kind(writer, SET_HAND);
            write_option(writer, max_force, Writer::number);
            write_option(writer, careful, |writer, x| writer.byte(u8::from(x)));
            write_option(writer, can_turn, |writer, x| writer.byte(u8::from(x)));
            write_option(writer, grip, |writer, grip| writer.byte(grip_code(grip)));
        }
        Command::SetBlocks { form, spring_stiffness } => {
            kind(writer, SET_BLOCKS);
            writer.byte(u8::from(form == Form::Lattice));
            write_option(writer, spring_stiffness, Writer::number);
        }
    }
}

/// Writes the first byte of a run, and its number of frames where there is more than one.
fn write_kind(writer: &mut Writer, kind: u8, frames: u32) {
    writer.byte(if frames > 1 { kind | REPEATED } else { kind });
    if frames > 1 {
        writer.unsigned(u64::from(frames) - 2);
    }
}

/// Fields of a movement.
struct Movement {
    displacement: DVec3,
    slot: Option<CellId>,
    toward_viewer: Option<DVec2>,
}

fn write_move(writer: &mut Writer, frames: u32, movement: &Movement, before: &mut Before) {
    let Movement { displacement, slot, toward_viewer } = *movement;
    let coarse = displacement.to_array().map(|x| multiple(x, COARSE));
    let coarse = if let [Some(x), Some(y), Some(z)] = coarse { Some([x, y, z]) } else { None };
    let is_new = bits(toward_viewer) != bits(before.viewer);
    let flag = |is_set: bool, flag: u8| if is_set { flag } else { 0 };
    let flags = flag(coarse.is_some(), COARSE_MOVE) | flag(slot != before.slot, SLOT) | flag(is_new, VIEWER);
    write_kind(writer, MOVE | flags, frames);
    match coarse {
        Some(now) => {
            now.iter().zip(before.displacement).for_each(|(now, last)| writer.signed(now - last));
            before.displacement = now;
        }
        None => vector(writer, displacement),
    }
    if slot != before.slot {
        write_slot(writer, slot);
        before.slot = slot;
    }
    if is_new {
        write_option(writer, toward_viewer, |writer, v| v.to_array().iter().for_each(|x| writer.number(*x)));
        before.viewer = toward_viewer;
    }
}

fn read_run(reader: &mut Reader, before: &mut Before) -> Result<Run, RecordError> {
    let first = reader.byte()?;
    let frames = if first & REPEATED == 0 { 1 } else { reader.index()?.checked_add(2).ok_or(reader.damaged())? };
    let kind = first & 0xf;
    if kind != MOVE && first & (COARSE_MOVE | SLOT | VIEWER) != 0 {
        return Err(reader.damaged());
    }
    let command = match kind {
        IDLE => Command::Idle,
        POKE => Command::Poke,
        RELEASE => Command::Release,
        RESIGN => Command::Resign,
        REBUILD => Command::Rebuild,
        GRASP => Command::Grasp {
            body: BodyId(reader.index()?),
            anchor: read_vector(reader)?,
            normal: read_vector(reader)?,
            grip: read_grip(reader)?,
        },
        MOVE => read_move(reader, first, before)?,
        TURN => Command::Turn {
            rotation: DQuat::from_array([reader.number()?, reader.number()?, reader.number()?, reader.number()?]),
        },
        PUT_DOWN => {
            Command::Place { body: read_option(reader, |reader| reader.index().map(BodyId))?, slot: read_slot(reader)? }
        }
        SET_HAND => Command::SetHand {
            max_force: read_option(reader, Reader::number)?,
            careful: read_option(reader, read_bool)?,
            can_turn: read_option(reader, read_bool)?,
            grip: read_option(reader, read_grip)?,
        },
        SET_BLOCKS => Command::SetBlocks {
            form: if read_bool(reader)? { Form::Lattice } else { Form::Rigid },
            spring_stiffness: read_option(reader, Reader::number)?,
        },
        _ => return Err(reader.damaged()),
    };
    Ok(Run { command, frames })
}

fn read_move(reader: &mut Reader, first: u8, before: &mut Before) -> Result<Command, RecordError> {
    let displacement = if first & COARSE_MOVE == 0 {
        read_vector(reader)?
    } else {
        for last in &mut before.displacement {
            *last = last.checked_add(reader.signed()?).ok_or(reader.damaged())?;
        }
        DVec3::from(before.displacement.map(|k| k as f64 / COARSE))
    };
    if first & SLOT != 0 {
        before.slot = read_slot(reader)?;
    }
    if first & VIEWER != 0 {
        before.viewer = read_option(reader, |reader| Ok(DVec2::new(reader.number()?, reader.number()?)))?;
    }
    Ok(Command::Move { displacement, slot: before.slot, toward_viewer: before.viewer })
}

fn bits(direction: Option<DVec2>) -> Option<[u64; 2]> {
    direction.map(|v| v.to_array().map(f64::to_bits))
}

fn vector(writer: &mut Writer, vector: DVec3) {
    vector.to_array().iter().for_each(|x| writer.number(*x));
}

fn read_vector(reader: &mut Reader) -> Result<DVec3, RecordError> {
    Ok(DVec3::new(reader.number()?, reader.number()?, reader.number()?))
}

fn write_option<T>(writer: &mut Writer, value: Option<T>, write: impl FnOnce(&mut Writer, T)) {
    writer.byte(u8::from(value.is_some()));
    if let Some(value) = value {
        write(writer, value);
    }
}

fn read_option<'a, T>(
    reader: &mut Reader<'a>,
    read: impl FnOnce(&mut Reader<'a>) -> Result<T, RecordError>,
) -> Result<Option<T>, RecordError> {
    if read_bool(reader)? { read(reader).map(Some) } else { Ok(None) }
}

fn read_bool(reader: &mut Reader) -> Result<bool, RecordError> {
    match reader.byte()? {
        0 => Ok(false),
        1 => Ok(true),
        _ => Err(reader.damaged()),
    }
}

fn write_slot(writer: &mut Writer, slot: Option<CellId>) {
    write_option(writer, slot, |writer, CellId { row, cell }| {
        writer.unsigned(u64::from(row));
        writer.unsigned(u64::from(cell));
    });
}

fn read_slot(reader: &mut Reader) -> Result<Option<CellId>, RecordError> {
    read_option(reader, |reader| Ok(CellId { row: reader.index()?, cell: reader.index()? }))
}

/// Modes of the grip in the order of their codes.
const GRIPS: [GripMode; 4] = [GripMode::Auto, GripMode::Slide, GripMode::Carry, GripMode::Push];

fn grip_code(grip: GripMode) -> u8 {
    match grip {
        GripMode::Auto => 0,
        GripMode::Slide => 1,
        GripMode::Carry => 2,
        GripMode::Push => 3,
    }
}

fn read_grip(reader: &mut Reader) -> Result<GripMode, RecordError> {
    let code = reader.byte()?;
    GRIPS.get(usize::from(code)).copied().ok_or(reader.damaged())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tape(commands: &[Command]) -> Tape {
        let mut tape = Tape::default();
        for command in commands {
            tape.push(Run { command: *command, frames: 1 }).unwrap();
        }
        tape
    }

    #[test]
    fn every_command_survives_with_its_bits() {
        let slot = Some(CellId { row: 18, cell: 2 });
        let step = |displacement, slot, toward_viewer| Command::Move { displacement, slot, toward_viewer };
        let commands = [
            Command::Idle,
            Command::Idle,
            Command::Grasp {
                body: BodyId(7),
                anchor: DVec3::new(0.0405, 0.1 + 0.2, -0.0),
                normal: DVec3::X,
                grip: GripMode::Push,
            },
            step(DVec3::new(0.00123, -0.5, 0.0), slot, None),
            step(DVec3::new(0.00125, -0.5, 0.0), slot, Some(DVec2::NEG_Y)),
            step(DVec3::new(0.1 + 0.2, 1e300, -0.0), None, Some(DVec2::NEG_Y)),
            step(DVec3::new(0.00125, -0.49, 0.0), None, Some(DVec2::new(0.6, f64::MIN_POSITIVE))),
            Command::Turn { rotation: DQuat::from_xyzw(0.0, 0.0, 0.6, 0.8) },
            Command::Place { body: Some(BodyId(u32::MAX)), slot },
            Command::Place { body: None, slot: None },
            Command::Poke,
            Command::Release,
            Command::SetHand {
                max_force: Some(3.0),
                careful: None,
                can_turn: Some(false),
                grip: Some(GripMode::Carry),
            },
            Command::SetBlocks { form: Form::Lattice, spring_stiffness: Some(3e5) },
            Command::Resign,
            Command::Rebuild,
        ];
        let written = write(&tape(&commands));
        let read: Vec<Command> = read(&written).unwrap().from(0).collect();
        assert_eq!(format!("{read:?}"), format!("{commands:?}"));
        for end in 0..written.len() {
            // Cut in the middle of a command the bytes are refused; between two they are fewer.
            if let Ok(shorter) = super::read(&written[..end]) {
                assert!(shorter.frames() < commands.len() as u32);
            }
        }
    }

    #[test]
    fn a_minute_of_nothing_and_a_straight_pull_take_a_few_bytes() {
        let step = Command::Move { displacement: DVec3::new(0.00167, 0.0, 0.0), slot: None, toward_viewer: None };
        let commands = [vec![Command::Idle; 3600], vec![step; 60]].concat();
        assert!(write(&tape(&commands)).len() < 12);
        let tremor = |k: u32| Command::Move {
            displacement: DVec3::new(f64::from(160 + k % 7) / 1e5, f64::from(k % 5) / 1e5, 0.0),
            slot: None,
            toward_viewer: None,
        };
        let moves: Vec<Command> = (0..60).map(tremor).collect();
        assert!(write(&tape(&moves)).len() <= 4 * 60 + 4);
    }

    #[test]
    fn unknown_kinds_and_flags_are_refused() {
        for bytes in
            [&[11][..], &[15], &[IDLE | SLOT], &[GRASP, 0, 1, 1, 1, 1, 1, 1, 9], &[PUT_DOWN, 2], &[SET_BLOCKS, 7]]
        {
            assert_eq!(read(bytes), Err(RecordError::Damaged("its commands")), "{bytes:?}");
        }
    }
}

//! Inputs of a simulation as text: a JSON object a line, each a change of the input at a time.

use std::collections::BTreeMap;

use glam::DVec3;
use serde_json::Value;
use teeter_physics::{AppliedForce, BodyId, Drive, Grip, Hand};
use teeter_scene::Scene;

use crate::json_fields::{FieldError, Fields, Kind, parse};
use crate::timeline::{Change, HandMotion, HandOrientation, Timeline};

/// Maximum time of a change, s.
pub const MAX_CHANGE_TIME: f64 = 86_400.0;
/// Maximum gravity, m/s²: that of a scene.
const MAX_GRAVITY: f64 = 100.0;
/// Maximum force of a drive, N, and torque of a hand, N m: far above any block of a scene.
const MAX_LIMIT: f64 = 1e9;

const CHANGE: Kind = Kind {
    noun: "a change",
    fields: &["time", "gravity", "hand", "forces", "drives"],
    aliases: &[("t", "time"), ("force", "forces"), ("drive", "drives"), ("hands", "hand"), ("g", "gravity")],
};
const HAND: Kind = Kind {
    noun: "a hand",
    fields: &["block", "grip", "anchor", "target", "velocity", "orientation", "axis", "max_force", "max_torque"],
    aliases: &[
        ("body", "block"),
        ("id", "block"),
        ("point", "anchor"),
        ("force", "max_force"),
        ("torque", "max_torque"),
    ],
};
const FORCE: Kind = Kind {
    noun: "a force",
    fields: &["block", "point", "force"],
    aliases: &[("body", "block"), ("id", "block"), ("anchor", "point")],
};
const DRIVE: Kind = Kind {
    noun: "a drive",
    fields: &["block", "velocity", "max_force"],
    aliases: &[("body", "block"), ("id", "block"), ("force", "max_force"), ("speed", "velocity")],
};

/// Text that is not inputs of a scene.
#[derive(Debug, PartialEq, thiserror::Error)]
pub enum InputsError {
    /// Line that is not a change.
    #[error("line {line}: {source}")]
    Line {
        /// Line, from 1.
        line: usize,
        /// Cause.
        source: FieldError,
    },
    /// Text without a line.
    #[error("no inputs, expected one JSON object a line")]
    Empty,
}

/// Blocks of a scene by their ids.
struct Blocks(BTreeMap<u32, BodyId>);

/// Reads the changes of a text, which names the blocks of `scene` by their ids.
///
/// ```
/// let scene = teeter_scene::named("block").unwrap();
/// let push = r#"{"time": 1, "forces": [{"block": 0, "force": [0.2, 0, 0]}]}"#;
/// assert_eq!(teeter_study::read_inputs(push, &scene)?.pending().len(), 1);
/// let error = teeter_study::read_inputs("\n{}", &scene).unwrap_err().to_string();
/// assert!(error.starts_with("line 2: a change lacks `time`"), "{error}");
/// # Ok::<(), teeter_study::InputsError>(())
/// ```
///
/// # Errors
/// When a line is not a change, naming the line and the field, and when there is no line.
pub fn read_inputs(text: &str, scene: &Scene) -> Result<Timeline, InputsError> {
    let blocks = Blocks((0..).map(BodyId).zip(&scene.blocks).map(|(body, block)| (block.id, body)).collect());
    let mut changes = Vec::new();
    for (index, line) in text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty()) {
        let change = parse(line).and_then(|value| change(&value, &blocks));
        changes.push(change.map_err(|source| InputsError::Line { line: index + 1, source })?);
    }
    if changes.is_empty() { Err(InputsError::Empty) } else { Ok(Timeline::new(changes)) }
}

fn change(value: &Value, blocks: &Blocks) -> Result<Change, FieldError> {
    let fields = Fields::new(value, "", &CHANGE)?;
    fields.required("time", "the time from which the change holds, s")?;
    let time = fields.number("time", MAX_CHANGE_TIME, "s")?.unwrap_or_default();
    let gravity = match fields.get("gravity") {
        Some(Value::Null) => Some(None),
        _ => fields.vector("gravity", "m/s²")?.map(Some),
    };
    if gravity.flatten().is_some_and(|gravity| gravity.length() > MAX_GRAVITY) {
        return Err(fields.error("gravity", format!("a vector of at most {MAX_GRAVITY} m/s²")));
    }
    let hand = match fields.get("hand") {
        None => None,
        Some(Value::Null) => Some(None),
        Some(value) => Some(Some(hand(&Fields::new(value, "hand", &HAND)?, blocks)?)),
    };
    let forces = fields.list("forces")?;
    let forces = forces.map(|list| list.iter().map(|(path, value)| force(path, value, blocks)).collect());
    let drives = fields.list("drives")?;
    let drives = drives.map(|list| list.iter().map(|(path, value)| drive(path, value, blocks)).collect());
    Ok(Change { time, gravity, hand, forces: forces.transpose()?, drives: drives.transpose()? })
}

fn hand(fields: &Fields, blocks: &Blocks) -> Result<HandMotion, FieldError> {
    let mut hand = HandMotion::new(blocks.get(fields)?, grip(fields)?);
    hand.anchor = fields.vector("anchor", "m in the block's frame")?.unwrap_or(hand.anchor);
    hand.target = fields.vector("target", "m")?;
    hand.velocity = fields.vector("velocity", "m/s")?.unwrap_or(hand.velocity);
    hand.max_force = fields.number("max_force", Hand::MAX_FORCE, "N")?.unwrap_or(hand.max_force);
    hand.max_torque = fields.number("max_torque", MAX_LIMIT, "N m")?.unwrap_or(hand.max_torque);
    match (fields.get("orientation"), hand.grip) {
        (None, _) => {}
        (Some(Value::Null), _) => hand.orientation = HandOrientation::Free,
        (Some(_), Grip::Push { .. }) => {
            return Err(fields.error("orientation", "none: a fingertip holds no orientation"));
        }
        (Some(_), _) => {
            hand.orientation = fields.orientation("orientation")?.map_or(hand.orientation, HandOrientation::Fixed);
        }
    }
    Ok(hand)
}

fn grip(fields: &Fields) -> Result<Grip, FieldError> {
    let expected = "\"slide\", \"carry\" or \"push\"";
    let grip = match fields.required("grip", expected)?.as_str() {
        Some("slide") => Grip::Slide,
        Some("carry") => Grip::Carry,
        Some("push") => {
            let expected = "the direction of the push, a vector that is not zero";
            fields.required("axis", expected)?;
            let axis = fields.vector("axis", "the direction of the push")?.and_then(DVec3::try_normalize);
            return Ok(Grip::Push { axis: axis.ok_or_else(|| fields.error("axis", expected))? });
        }
        _ => return Err(fields.error("grip", expected)),
    };
    if fields.get("axis").is_some() {
        Err(fields.error("axis", "none: it is the direction of a push"))
    } else {
        Ok(grip)
    }
}

fn force(path: &str, value: &Value, blocks: &Blocks) -> Result<AppliedForce, FieldError> {
    let fields = Fields::new(value, path, &FORCE)?;
    let body = blocks.get(&fields)?;
    fields.required("force", "a list of three numbers, N")?;
    let point = fields.vector("point", "m in the block's frame")?.unwrap_or_default();
    Ok(AppliedForce { body, point, force: fields.vector("force", "N")?.unwrap_or_default() })
}

fn drive(path: &str, value: &Value, blocks: &Blocks) -> Result<Drive, FieldError> {
    let fields = Fields::new(value, path, &DRIVE)?;
    let body = blocks.get(&fields)?;
    fields.required("velocity", "a list of three numbers, m/s")?;
    let drive = Drive::new(body, fields.vector("velocity", "m/s")?.unwrap_or_default());
    Ok(drive.with_max_force(fields.number("max_force", MAX_LIMIT, "N")?.unwrap_or(drive.max_force)))
}

impl Blocks {
    /// Body of the field `block`.
    fn get(&self, fields: &Fields) -> Result<BodyId, FieldError> {
        let id = fields.required("block", "the id of a block of the scene")?.as_u64();
        let body = id.and_then(|id| self.0.get(&u32::try_from(id).ok()?));
        body.copied().ok_or_else(|| fields.error("block", "the id of a block of the scene"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_unknown_field_is_named_in_one_short_line() {
        let scene = teeter_scene::named("block").unwrap();
        let error =
            |name: &str| read_inputs(&format!(r#"{{"time": 0, "{name}": 1}}"#), &scene).unwrap_err().to_string();
        let line = "is not a field of a change, which are time, gravity, hand, forces, drives";
        assert_eq!(error(r"a\u0007\nb\u001b[31m"), format!("line 1: `a  b [31m` {line}"));
        let long = "x".repeat(10_000);
        assert_eq!(error(&long), format!("line 1: `{}…` {line}", &long[..40]));
    }
}

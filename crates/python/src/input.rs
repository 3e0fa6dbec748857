//! Input of a step: hand, forces, drives and gravity, checked.

use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::{Map, Value};
use teeter_physics::{BodyId, Input};

use crate::argument::no_body;
use crate::error::{Kind, unexpected};
use crate::plain::{read, value};

/// Parts of an input, as a step takes them.
#[derive(Debug)]
pub struct Parts<'a, 'py> {
    pub hand: Option<&'a Bound<'py, PyAny>>,
    pub forces: Option<&'a Bound<'py, PyAny>>,
    pub drives: Option<&'a Bound<'py, PyAny>>,
    pub gravity: Option<&'a Bound<'py, PyAny>>,
}

impl Parts<'_, '_> {
    /// Reads the input of a world of `len` bodies.
    pub fn read(&self, len: usize) -> PyResult<Input> {
        let mut fields = Map::new();
        let parts = [("hand", self.hand), ("forces", self.forces), ("drives", self.drives), ("gravity", self.gravity)];
        for (name, part) in parts {
            if let Some(part) = part {
                fields.insert(name.to_owned(), value(Kind::Input, name, part)?);
            }
        }
        if fields.is_empty() {
            return Ok(Input::default());
        }
        parsed(Value::Object(fields), "", len)
    }
}

/// Reads an input from a dict with its parts, or from None.
pub fn input_of(object: &Bound<'_, PyAny>, name: &str, len: usize) -> PyResult<Input> {
    if object.is_none() {
        return Ok(Input::default());
    }
    if !object.is_instance_of::<PyDict>() {
        return Err(unexpected(
            Kind::Input,
            name,
            object.get_type().name()?,
            "a dict with `hand`, `forces`, `drives` or `gravity`, or None",
        ));
    }
    checked(read(Kind::Input, name, object)?, name, len)
}

fn parsed(fields: Value, name: &str, len: usize) -> PyResult<Input> {
    let input = serde_path_to_error::deserialize(fields).map_err(|error| {
        let path = error.path().to_string();
        Kind::Input.error(format_args!("`{path}`: {}", error.inner()))
    })?;
    checked(input, name, len)
}

/// Checks what a step would ignore: bodies that do not exist, negative limits, and directions of no
/// length.
fn checked(input: Input, name: &str, len: usize) -> PyResult<Input> {
    let dot = if name.is_empty() { String::new() } else { format!("{name}.") };
    let exists = |field: &str, body: BodyId| {
        if body.index() < len { Ok(()) } else { Err(no_body(&format!("{dot}{field}"), body, len)) }
    };
    let limit = |field: String, value: f64| {
        if value >= 0.0 { Ok(()) } else { Err(unexpected(Kind::Input, &field, value, "0 or more")) }
    };
    if let Some(hand) = &input.hand {
        exists("hand.body", hand.body)?;
        limit(format!("{dot}hand.max_force"), hand.max_force)?;
        limit(format!("{dot}hand.max_torque"), hand.max_torque)?;
        if hand.orientation.is_some_and(|q| q.length_squared() < 1e-300) {
            return Err(unexpected(
                Kind::Input,
                &format!("{dot}hand.orientation"),
                "0",
                "a quaternion with a direction",
            ));
        }
        if matches!(hand.grip, teeter_physics::Grip::Push { axis } if axis == glam::DVec3::ZERO) {
            return Err(unexpected(Kind::Input, &format!("{dot}hand.axis"), "0", "the direction of the push"));
        }
    }
    for (i, force) in input.forces.iter().enumerate() {
        exists(&format!("forces[{i}].body"), force.body)?;
    }
    for (i, drive) in input.drives.iter().enumerate() {
        exists(&format!("drives[{i}].body"), drive.body)?;
        limit(format!("{dot}drives[{i}].max_force"), drive.max_force)?;
    }
    Ok(input)
}

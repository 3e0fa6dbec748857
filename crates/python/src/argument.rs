//! Arguments of functions: numbers in their ranges, vectors, bodies.

use std::ops::RangeInclusive;

use glam::{DQuat, DVec3};
use pyo3::prelude::*;
use pyo3::types::PyBool;
use teeter_physics::{BodyId, World};

use crate::error::{Kind, unexpected};

/// Reads a finite number.
pub fn number(field: &str, value: &Bound<'_, PyAny>) -> PyResult<f64> {
    let number: f64 = value.extract().map_err(|_| unexpected(Kind::Input, field, shown(value), "a number"))?;
    if number.is_finite() { Ok(number) } else { Err(unexpected(Kind::Input, field, number, "a finite number")) }
}

/// Reads a number of a range.
pub fn within(field: &str, value: &Bound<'_, PyAny>, range: RangeInclusive<f64>) -> PyResult<f64> {
    let number = number(field, value)?;
    if range.contains(&number) {
        return Ok(number);
    }
    let (min, max) = range.into_inner();
    Err(unexpected(Kind::Input, field, number, format_args!("{min} to {max}")))
}

/// Reads an integer of a range.
pub fn count(field: &str, value: &Bound<'_, PyAny>, range: RangeInclusive<u64>) -> PyResult<u64> {
    let is_flag = value.is_instance_of::<PyBool>();
    if let Some(number) = value.extract::<u64>().ok().filter(|number| !is_flag && range.contains(number)) {
        return Ok(number);
    }
    let (min, max) = range.into_inner();
    Err(unexpected(Kind::Input, field, shown(value), format_args!("an integer from {min} to {max}")))
}

/// Reads a seed, any integer of 64 bits without a sign.
pub fn seed(value: &Bound<'_, PyAny>) -> PyResult<u64> {
    count("seed", value, 0..=u64::MAX)
}

/// Reads `N` finite numbers.
pub fn numbers<const N: usize>(field: &str, value: &Bound<'_, PyAny>) -> PyResult<[f64; N]> {
    let wrong = || unexpected(Kind::Input, field, shown(value), format_args!("{N} numbers"));
    let items = value.try_iter().map_err(|_| wrong())?;
    let mut read = [0.0; N];
    let mut len = 0;
    for item in items.take(N + 1) {
        let item = item.map_err(|_| wrong())?;
        *read.get_mut(len).ok_or_else(wrong)? = number(&format!("{field}[{len}]"), &item)?;
        len += 1;
    }
    if len == N { Ok(read) } else { Err(wrong()) }
}

/// Reads a vector.
pub fn vector(field: &str, value: &Bound<'_, PyAny>) -> PyResult<DVec3> {
    numbers(field, value).map(DVec3::from_array)
}

/// Reads a vector with a direction and returns its unit vector.
pub fn direction(field: &str, value: &Bound<'_, PyAny>) -> PyResult<DVec3> {
    let unit = vector(field, value)?.try_normalize();
    unit.ok_or_else(|| unexpected(Kind::Input, field, shown(value), "a vector with a direction"))
}

/// Reads an orientation, x, y, z, w of any length.
pub fn orientation(field: &str, value: &Bound<'_, PyAny>) -> PyResult<DQuat> {
    let quaternion = DQuat::from_array(numbers(field, value)?);
    // The square of a longer one may overflow.
    let length = quaternion.length();
    if length.is_finite() && length > 1e-150 {
        return Ok(quaternion / length);
    }
    Err(unexpected(Kind::Input, field, shown(value), "a quaternion with a direction"))
}

/// Reads the index of a body.
pub fn body(world: &World, value: &Bound<'_, PyAny>) -> PyResult<BodyId> {
    body_of(world.len(), "body", value)
}

/// Reads the index of one of `len` bodies.
pub fn body_of(len: usize, field: &str, value: &Bound<'_, PyAny>) -> PyResult<BodyId> {
    let index = value.extract::<u32>().ok().filter(|index| (*index as usize) < len);
    let is_flag = value.is_instance_of::<PyBool>();
    index.filter(|_| !is_flag).map(BodyId).ok_or_else(|| no_body(field, shown(value), len))
}

/// Exception of a body that does not exist.
pub fn no_body(field: &str, value: impl std::fmt::Display, len: usize) -> PyErr {
    let last = len.saturating_sub(1);
    unexpected(Kind::Body, field, value, format_args!("the index of a body, an integer from 0 to {last}"))
}

/// Text of a value in a message.
pub fn shown(value: &Bound<'_, PyAny>) -> String {
    const MAX: usize = 60;
    let text = value.repr().map_or_else(|_| "an object".to_owned(), |text| text.to_string_lossy().into_owned());
    let text = text.replace(['\n', '\r'], " ").replace('`', "'");
    if text.chars().count() <= MAX { text } else { text.chars().take(MAX).chain("...".chars()).collect() }
}

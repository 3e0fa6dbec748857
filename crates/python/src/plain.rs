//! Plain data: Python's dicts, lists and numbers read as JSON is, and written as dicts.

use pyo3::intern;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyString, PyTuple};
use pythonize::pythonize;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Map, Number, Value};

use crate::error::Kind;

/// Depth of lists and dicts up to which data is read.
const MAX_DEPTH: usize = 32;

/// Object that is not plain data: the path to it, the innermost part first, and the reason.
struct NotPlain {
    path: Vec<String>,
    message: String,
}

impl NotPlain {
    fn new(message: impl Into<String>) -> Self {
        Self { path: Vec::new(), message: message.into() }
    }

    fn within(mut self, part: String) -> Self {
        self.path.push(part);
        self
    }
}

impl From<PyErr> for NotPlain {
    fn from(error: PyErr) -> Self {
        Self::new(format!("cannot be read: {error}"))
    }
}

/// Reads plain data of Python: dicts with text keys, lists, tuples, arrays, dataclasses, texts,
/// finite numbers, booleans and None.
///
/// `name` is that of the argument.
pub fn value(kind: Kind, name: &str, object: &Bound<'_, PyAny>) -> PyResult<Value> {
    plain(object, 0).map_err(|error| {
        let path = error.path.iter().rev().fold(name.to_owned(), |path, part| path + part);
        kind.error(format_args!("`{}` {}", path.trim_start_matches('.'), error.message.replace('`', "'")))
    })
}

/// Reads a value from plain data, with the path of the field in its error.
pub fn read<T: DeserializeOwned>(kind: Kind, name: &str, object: &Bound<'_, PyAny>) -> PyResult<T> {
    let value = value(kind, name, object)?;
    serde_path_to_error::deserialize(value).map_err(|error| {
        let path = error.path().to_string();
        let path = match (name, path.as_str()) {
            (name, ".") => name.to_owned(),
            ("", path) => path.to_owned(),
            (name, path) => format!("{name}.{path}"),
        };
        if path.is_empty() {
            kind.error(error.inner())
        } else {
            kind.error(format_args!("`{path}`: {}", error.inner()))
        }
    })
}

/// Reads keyword arguments; those that are absent have their defaults.
pub fn keywords<T: DeserializeOwned + Default>(kind: Kind, given: Option<&Bound<'_, PyDict>>) -> PyResult<T> {
    given.map_or_else(|| Ok(T::default()), |given| read(kind, "", given))
}

/// Writes a value as plain data of Python: dicts, lists, texts, numbers, booleans and None.
pub fn write<'py>(py: Python<'py>, value: &impl Serialize) -> PyResult<Bound<'py, PyAny>> {
    with_lists(pythonize(py, value)?)
}

/// Turns the tuples of an object into lists, which can be changed and are what JSON reads.
fn with_lists(object: Bound<'_, PyAny>) -> PyResult<Bound<'_, PyAny>> {
    let py = object.py();
    if let Ok(dict) = object.cast::<PyDict>() {
        for (key, entry) in dict.iter() {
            let is_nested = !entry.is_instance_of::<PyString>() && entry.hasattr(intern!(py, "__len__"))?;
            if is_nested {
                dict.set_item(key, with_lists(entry)?)?;
            }
        }
    } else if object.is_instance_of::<PyList>() || object.is_instance_of::<PyTuple>() {
        let items = object.try_iter()?.map(|item| with_lists(item?)).collect::<PyResult<Vec<_>>>()?;
        return Ok(PyList::new(py, items)?.into_any());
    }
    Ok(object)
}

fn plain(object: &Bound<'_, PyAny>, depth: usize) -> Result<Value, NotPlain> {
    if depth > MAX_DEPTH {
        return Err(NotPlain::new(format!("is more than {MAX_DEPTH} lists and dicts deep")));
    }
    if object.is_none() {
        return Ok(Value::Null);
    }
    if let Ok(flag) = object.cast::<PyBool>() {
        return Ok(Value::Bool(flag.is_true()));
    }
    if object.is_instance_of::<PyInt>() {
        return integer(object);
    }
    if object.is_instance_of::<PyFloat>() {
        let number: f64 = object.extract()?;
        let finite = Number::from_f64(number).map(Value::Number);
        return finite.ok_or_else(|| NotPlain::new(format!("is {number}, expected a finite number")));
    }
    if let Ok(text) = object.cast::<PyString>() {
        let text = text.to_cow().map_err(|_| NotPlain::new("is a text with half a character, expected Unicode"))?;
        return Ok(Value::String(text.into_owned()));
    }
    if let Ok(dict) = object.cast::<PyDict>() {
        return fields(dict.iter(), depth);
    }
    if object.is_instance_of::<PyList>() || object.is_instance_of::<PyTuple>() {
        return items(object, depth);
    }
    other(object, depth)
}

fn integer(object: &Bound<'_, PyAny>) -> Result<Value, NotPlain> {
    if let Ok(number) = object.extract::<i64>() {
        return Ok(number.into());
    }
    let number = object.extract::<u64>().map_err(|_| NotPlain::new("is an integer of more than 64 bits"))?;
    Ok(number.into())
}

fn fields<'py>(
    entries: impl Iterator<Item = (Bound<'py, PyAny>, Bound<'py, PyAny>)>,
    depth: usize,
) -> Result<Value, NotPlain> {
    let mut map = Map::new();
    for (key, entry) in entries {
        let key: String = key.extract().map_err(|_| NotPlain::new("has a key that is no text"))?;
        let entry = plain(&entry, depth + 1).map_err(|error| error.within(format!(".{key}")))?;
        map.insert(key, entry);
    }
    Ok(Value::Object(map))
}

fn items(object: &Bound<'_, PyAny>, depth: usize) -> Result<Value, NotPlain> {
    let mut list = Vec::new();
    for (index, item) in object.try_iter()?.enumerate() {
        list.push(plain(&item?, depth + 1).map_err(|error| error.within(format!("[{index}]")))?);
    }
    Ok(Value::Array(list))
}

/// Reads an array or number of NumPy, or a dataclass.
fn other(object: &Bound<'_, PyAny>, depth: usize) -> Result<Value, NotPlain> {
    if let Ok(list) = object.call_method0("tolist") {
        return plain(&list, depth + 1);
    }
    if let Ok(names) = object.getattr("__dataclass_fields__")
        && let Ok(names) = names.cast::<PyDict>()
    {
        let entries: Vec<_> = names
            .keys()
            .iter()
            .map(|name| Ok((name.clone(), object.getattr(name.cast::<PyString>().map_err(PyErr::from)?)?)))
            .collect::<PyResult<_>>()?;
        return fields(entries.into_iter(), depth);
    }
    let name = object.get_type().name().map_or_else(|_| "object".to_owned(), |name| name.to_string());
    Err(NotPlain::new(format!("is of type {name}, expected plain data")))
}

//! A valid scene of two blocks, and the errors of changing it.

use serde_json::{Value, json};
use teeter_scene::Scene;

/// Scene of two blocks, 7 and 9, one upon the other.
pub fn valid_scene() -> Value {
    json!({"name": "two", "gravity": 9.81, "friction": 0.4, "restitution": 0.0, "stiffness": 1e6, "family": "fields of labelled towers are ignored", "blocks": [
        {"id": 7, "size": [0.081, 0.0268, 0.018], "mass": 0.0196, "pos": [0.0, 0.0, 0.009], "yaw": 0.0},
        {"id": 9, "size": [0.081, 0.0268, 0.018], "mass": 0.0196, "pos": [0.0, 0.0, 0.027], "yaw": 0.3}]})
}

/// Returns the error of a text, which is one line.
pub fn error_line(text: &str) -> String {
    let error = Scene::from_json(text).expect_err(text).to_string();
    assert!(!error.contains('\n'), "{error:?}");
    error
}

/// Returns the error of the valid scene with one value changed, or removed.
pub fn error_with(pointer: &str, value: Option<Value>) -> String {
    let mut scene = valid_scene();
    let (parent, key) = pointer.rsplit_once('/').unwrap();
    match (value, scene.pointer_mut(parent).unwrap()) {
        (Some(v), _) => *scene.pointer_mut(pointer).unwrap_or_else(|| panic!("{pointer}")) = v,
        (None, Value::Object(o)) => drop(o.remove(key).unwrap()),
        (None, other) => panic!("{other} has no fields"),
    }
    error_line(&scene.to_string())
}

/// Returns the error of the valid scene with one field added to one of its objects.
pub fn error_with_field(parent: &str, field: &str, value: Value) -> String {
    let mut scene = valid_scene();
    scene.pointer_mut(parent).unwrap().as_object_mut().unwrap().insert(field.to_owned(), value);
    error_line(&scene.to_string())
}

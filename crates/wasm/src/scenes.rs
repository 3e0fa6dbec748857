//! Scenes for the page.

use serde::Serialize;
use teeter_scene::{NAMED, TowerOptions};
use wasm_bindgen::prelude::*;

use crate::Error;

/// A tower as scene JSON. `options` is the JSON of [`TowerOptions`]; a field that is absent has its
/// default.
#[wasm_bindgen(js_name = towerScene)]
pub fn tower_scene(options: &str) -> Result<String, Error> {
    let options: TowerOptions = serde_json::from_str(options).map_err(|e| Error::json("tower options", e))?;
    let scene = teeter_scene::tower(&options).map_err(Error::rejected)?;
    Ok(scene.to_json())
}

/// A scene of the list as scene JSON.
#[wasm_bindgen(js_name = namedScene)]
pub fn named_scene(name: &str) -> Result<String, Error> {
    let scene =
        teeter_scene::named(name).ok_or_else(|| Error::rejected(format!("there is no scene called `{name}`")))?;
    Ok(scene.to_json())
}

#[derive(Serialize)]
struct Entry<'a> {
    name: &'a str,
    title: &'a str,
}

/// The list of named scenes as JSON: `[{"name", "title"}]`.
#[wasm_bindgen(js_name = sceneList)]
pub fn scene_list() -> String {
    let entries: Vec<Entry> = NAMED.iter().map(|s| Entry { name: s.name, title: s.title }).collect();
    serde_json::to_string(&entries).expect("names and titles are plain text")
}

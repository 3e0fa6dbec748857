//! Target: a scene file.

use teeter_scene::{NAMED, Scene, read_text};

/// Size up to which bytes are read.
const MAX_BYTES: u64 = 1_000_000;

/// Reads bytes as a scene. What is accepted is the same after it is written and read again, and an
/// error is one printable line.
pub fn run(bytes: &[u8]) {
    let scene = match read_text(bytes, MAX_BYTES).and_then(|text| Scene::from_json(&text)) {
        Ok(scene) => scene,
        Err(error) => {
            let line = error.to_string();
            assert!(!line.contains(char::is_control) && line.len() < 2000, "{line:?}");
            return;
        }
    };
    let json = scene.to_json();
    assert_eq!(Scene::from_json(&json).as_ref(), Ok(&scene), "{json}");
}

/// Small scenes of the list.
pub fn seeds() -> Vec<Vec<u8>> {
    let scenes = NAMED.iter().filter_map(|entry| teeter_scene::named(entry.name));
    scenes.filter(|scene| scene.blocks.len() < 8).map(|scene| scene.to_json().into_bytes()).collect()
}

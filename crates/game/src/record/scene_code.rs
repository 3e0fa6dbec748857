//! Scenes as bytes: a name where this program has the scene, else its JSON.

use teeter_physics::envelope::checksum;
use teeter_scene::{BlockPreset, Scene, TowerOptions, named, tower};

use crate::record::bytes::{Reader, Writer};
use crate::record::error::RecordError;

/// Kinds of sources.
const JSON: u8 = 0;
const NAME: u8 = 1;

/// Writes a scene: what this program can build again by its name and its checksum.
pub fn write(writer: &mut Writer, scene: &Scene) {
    let json = scene.to_json();
    if of_name(&scene.name).as_ref() == Some(scene) {
        writer.byte(NAME);
        writer.bytes(scene.name.as_bytes());
        writer.0.extend(checksum(json.as_bytes()).to_le_bytes());
    } else {
        writer.byte(JSON);
        writer.bytes(json.as_bytes());
    }
}

/// Reads a scene.
pub fn read(reader: &mut Reader) -> Result<Scene, RecordError> {
    let kind = reader.byte()?;
    let text = std::str::from_utf8(reader.bytes()?).map_err(|_| reader.damaged())?;
    match kind {
        JSON => Scene::from_json(text).map_err(|_| reader.damaged()),
        NAME => {
            let sum = u64::from_le_bytes(reader.array()?);
            let is_same = |scene: &Scene| checksum(scene.to_json().as_bytes()) == sum;
            of_name(text).filter(is_same).ok_or_else(|| RecordError::OtherScene(text.to_owned()))
        }
        _ => Err(reader.damaged()),
    }
}

/// Scene of the list, or full tower of a preset, rows and a seed with default constants.
fn of_name(name: &str) -> Option<Scene> {
    if let Some(scene) = named(name) {
        return Some(scene);
    }
    let mut parts = name.strip_prefix("tower-")?.split('-');
    let (block, rows, seed) = (parts.next()?, parts.next()?.parse().ok()?, parts.next()?.parse().ok()?);
    let block = BlockPreset::ALL.into_iter().find(|preset| preset.to_string() == block)?;
    tower(&TowerOptions { rows, seed, block, ..TowerOptions::default() }).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(scene: &Scene) -> Vec<u8> {
        let mut writer = Writer::default();
        write(&mut writer, scene);
        assert_eq!(read(&mut Reader::new(&writer.0, "its scene")).as_ref(), Ok(scene));
        writer.0
    }

    #[test]
    fn a_tower_is_its_seed_a_named_scene_its_name_and_any_other_its_json() {
        let options =
            TowerOptions { rows: 12, seed: u64::MAX, block: BlockPreset::Official, ..TowerOptions::default() };
        assert!(written(&tower(&options).unwrap()).len() < 60);
        assert!(written(&named("midgame").unwrap()).len() < 24);
        let mut changed = tower(&options).unwrap();
        changed.friction = 0.41;
        assert!(written(&changed).len() > 1000);
    }

    #[test]
    fn a_scene_that_this_program_builds_otherwise_is_refused_by_its_name() {
        let mut bytes = written(&named("midgame").unwrap());
        *bytes.last_mut().unwrap() ^= 1;
        let error = read(&mut Reader::new(&bytes, "its scene")).unwrap_err();
        assert_eq!(error, RecordError::OtherScene("midgame".into()));
    }
}

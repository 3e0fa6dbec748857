//! Scenes as bytes: a name where this program has the scene, else its constants and blocks. Records
//! of version 1 have JSON instead.

use teeter_physics::envelope::checksum;
use teeter_scene::{BlockPreset, Form, Particles, Scene, Springs, TowerOptions, named, tower};

use crate::record::blocks_code;
use crate::record::bytes::{Reader, Writer};
use crate::record::error::RecordError;

/// Kinds of sources.
const JSON: u8 = 0;
const NAME: u8 = 1;
const BLOCKS: u8 = 2;
/// Flags of the form and the springs, and of what a scene may have.
const LATTICE: u8 = 1;
const CORNERS: u8 = 2;
const KINETIC: u8 = 4;
const SPRINGS: u8 = 8;
const LABEL: u8 = 16;
const MARGIN: u8 = 32;
const TILT: u8 = 64;
/// Flag of a tower whose blocks are those of its name, played on.
const PLAYED: u8 = 128;

/// Writes a scene: what this program can build again by its name and its checksum.
pub fn write(writer: &mut Writer, scene: &Scene) {
    let named = of_name(&scene.name).filter(|named| named.blocks.len() == scene.blocks.len());
    let is_named = named.as_ref() == Some(scene);
    writer.byte(if is_named { NAME } else { BLOCKS });
    writer.bytes(scene.name.as_bytes());
    if !is_named {
        write_constants(writer, scene, named.is_some());
    }
    if let Some(named) = &named {
        writer.0.extend(sum_of(named).to_le_bytes());
    }
    if !is_named {
        blocks_code::write(writer, &scene.blocks, named.as_ref().map(|named| &named.blocks[..]));
    }
}

/// Reads a scene.
pub fn read(reader: &mut Reader) -> Result<Scene, RecordError> {
    let kind = reader.byte()?;
    let text = std::str::from_utf8(reader.bytes()?).map_err(|_| reader.damaged())?;
    match kind {
        JSON => Scene::from_json(text).map_err(|_| reader.damaged()),
        NAME => read_named(reader, text),
        BLOCKS => {
            let (constants, is_played) = read_constants(reader, text)?;
            let named = if is_played { Some(read_named(reader, text)?) } else { None };
            let blocks = blocks_code::read(reader, named.as_ref().map(|named| &named.blocks[..]))?;
            let scene = Scene { blocks, ..constants };
            // Names and labels are checked where JSON is read.
            Scene::from_json(&scene.to_json()).map_err(|_| reader.damaged())
        }
        _ => Err(reader.damaged()),
    }
}

/// Scene of a name, by its checksum.
fn read_named(reader: &mut Reader, name: &str) -> Result<Scene, RecordError> {
    let sum = u64::from_le_bytes(reader.array()?);
    let named = of_name(name).filter(|scene| sum_of(scene) == sum);
    named.ok_or_else(|| RecordError::OtherScene(name.to_owned()))
}

fn sum_of(scene: &Scene) -> u64 {
    checksum(scene.to_json().as_bytes())
}

/// Writes all but the name and the blocks.
fn write_constants(writer: &mut Writer, scene: &Scene, is_played: bool) {
    let flag = |is_set: bool, flag: u8| if is_set { flag } else { 0 };
    writer.byte(
        flag(scene.form == Form::Lattice, LATTICE)
            | flag(scene.springs.particles == Particles::Corners, CORNERS)
            | flag(scene.kinetic_friction.is_some(), KINETIC)
            | flag(scene.springs.stiffness.is_some(), SPRINGS)
            | flag(scene.label.is_some(), LABEL)
            | flag(scene.margin.is_some(), MARGIN)
            | flag(scene.tilt_az.is_some(), TILT)
            | flag(is_played, PLAYED),
    );
    let always = [scene.gravity, scene.friction, scene.restitution, scene.stiffness, scene.edge_radius];
    let optional = [scene.kinetic_friction, scene.springs.stiffness, scene.margin, scene.tilt_az];
    let numbers = always.into_iter().chain([scene.springs.damping]).chain(optional.into_iter().flatten());
    numbers.for_each(|number| writer.number(number));
    if let Some(label) = &scene.label {
        writer.bytes(label.as_bytes());
    }
}

/// Reads a scene without blocks; true where the blocks are those of its name, played on.
fn read_constants(reader: &mut Reader, name: &str) -> Result<(Scene, bool), RecordError> {
    let flags = reader.byte()?;
    let [gravity, friction, restitution] = [reader.number()?, reader.number()?, reader.number()?];
    let [stiffness, edge_radius, damping] = [reader.number()?, reader.number()?, reader.number()?];
    let mut number = |flag: u8| if flags & flag == 0 { Ok(None) } else { reader.number().map(Some) };
    let (kinetic_friction, spring_stiffness) = (number(KINETIC)?, number(SPRINGS)?);
    let (margin, tilt_az) = (number(MARGIN)?, number(TILT)?);
    let label = if flags & LABEL == 0 { None } else { Some(reader.bytes()?) };
    let label = label.map(std::str::from_utf8).transpose().map_err(|_| reader.damaged())?;
    let particles = if flags & CORNERS == 0 { Particles::Inside } else { Particles::Corners };
    let scene = Scene {
        name: name.to_owned(),
        gravity,
        friction,
        kinetic_friction,
        restitution,
        stiffness,
        edge_radius,
        form: if flags & LATTICE == 0 { Form::Rigid } else { Form::Lattice },
        springs: Springs { stiffness: spring_stiffness, damping, particles },
        blocks: Vec::new(),
        label: label.map(str::to_owned),
        margin,
        tilt_az,
    };
    Ok((scene, flags & PLAYED != 0))
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
    use teeter_scene::NamedScene;

    use super::*;

    fn written(scene: &Scene) -> Vec<u8> {
        let mut writer = Writer::default();
        write(&mut writer, scene);
        assert_eq!(read(&mut Reader::new(&writer.0, "its scene")).as_ref(), Ok(scene));
        writer.0
    }

    #[test]
    fn a_tower_is_its_seed_a_named_scene_its_name_and_any_other_its_blocks() {
        let options =
            TowerOptions { rows: 12, seed: u64::MAX, block: BlockPreset::Official, ..TowerOptions::default() };
        assert!(written(&tower(&options).unwrap()).len() < 60);
        assert!(written(&named("midgame").unwrap()).len() < 24);
        let mut changed = tower(&options).unwrap();
        changed.friction = 0.41;
        let bytes = written(&changed).len();
        assert!((200..2000).contains(&bytes), "{bytes} bytes");
    }

    #[test]
    fn every_scene_comes_back_from_its_blocks_and_from_its_json() {
        let mut scenes: Vec<Scene> = teeter_scene::NAMED.iter().map(NamedScene::scene).collect();
        let springs = Springs { stiffness: Some(3e7), damping: 0.2, particles: Particles::Corners };
        let soft = Scene { form: Form::Lattice, springs, kinetic_friction: Some(0.1 + 0.2), ..scenes[0].clone() };
        let label = Some("stable".to_owned());
        scenes.push(Scene { label, margin: Some(0.25), tilt_az: Some(1.0), gravity: 1.62, ..soft });
        for scene in scenes {
            let other = Scene { name: format!("{}, played", scene.name), ..scene };
            written(&other);
            let mut json = Writer::default();
            json.byte(JSON);
            json.bytes(other.to_json().as_bytes());
            assert_eq!(read(&mut Reader::new(&json.0, "its scene")), Ok(other));
        }
    }

    #[test]
    fn a_scene_that_this_program_builds_otherwise_is_refused_by_its_name() {
        let mut bytes = written(&named("midgame").unwrap());
        *bytes.last_mut().unwrap() ^= 1;
        let error = read(&mut Reader::new(&bytes, "its scene")).unwrap_err();
        assert_eq!(error, RecordError::OtherScene("midgame".into()));
    }
}

//! Towers with known answers: one scene in JSON a line, packed by gzip or not.

use std::io::{BufRead, BufReader, Read};

use flate2::bufread::MultiGzDecoder;
use serde::Deserialize;
use teeter_scene::{MAX_BYTES, Scene, SceneError};

use crate::error::Error;

/// Most bytes of all lines together, unpacked: a small packed file can hold any number of them.
pub const MAX_TOTAL: u64 = 1_000_000_000;

/// A scene and what is known of it.
#[derive(Debug)]
pub struct Labelled {
    /// The scene.
    pub scene: Scene,
    /// The exact answer to the question of tilt, where the scene asks it and knows it.
    pub truth: Truth,
}

/// What the labels say of a tilted tower.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(default)]
pub struct Truth {
    /// Least angle at which rigid blocks can no longer rest, degrees.
    pub tilt_deg: Option<f64>,
    /// Whether the answer depends on contact between the sides of neighbours.
    pub side_sensitive: bool,
}

#[derive(Default, Deserialize)]
struct Extra {
    #[serde(default)]
    truth: Option<Truth>,
}

/// Reads all scenes of a source; `name` is its name for messages.
pub fn read(reader: impl Read + 'static, name: &str) -> Result<Vec<Labelled>, Error> {
    let mut packed = BufReader::new(reader);
    let start = packed.fill_buf().map_err(|e| Error::at(name, e))?;
    let is_gzip = start.starts_with(&[0x1f, 0x8b]);
    let plain: Box<dyn Read> = if is_gzip { Box::new(MultiGzDecoder::new(packed)) } else { Box::new(packed) };
    let mut lines = BufReader::new(plain.take(MAX_TOTAL + 1));
    let mut scenes = Vec::new();
    let mut total = 0;
    let mut bytes = Vec::new();
    for number in 1.. {
        let at = |message: &dyn std::fmt::Display| Error::at(&format!("{}, line {number}", name), message);
        bytes.clear();
        let length = lines.by_ref().take(MAX_BYTES + 1).read_until(b'\n', &mut bytes).map_err(|e| at(&e))? as u64;
        if length == 0 {
            break;
        }
        total += length;
        if length > MAX_BYTES {
            return Err(at(&SceneError::TooLarge { limit_mb: MAX_BYTES / 1_000_000 }));
        }
        if total > MAX_TOTAL {
            return Err(Error::at(
                name,
                format!("more than {} MB unpacked, the most that is read", MAX_TOTAL / 1_000_000),
            ));
        }
        let text = std::str::from_utf8(&bytes).map_err(|e| at(&SceneError::NotUtf8(e.valid_up_to())))?;
        if text.trim().is_empty() {
            continue;
        }
        scenes.push(parse(text).map_err(|e| at(&e))?);
    }
    if scenes.is_empty() {
        return Err(Error::at(name, "no scenes, expected one JSON object a line"));
    }
    Ok(scenes)
}

/// The scene on a line, and what is known of it; what is wrong with it otherwise.
pub fn parse(text: &str) -> Result<Labelled, String> {
    let scene = Scene::from_json(text).map_err(|e| e.to_string())?;
    let extra: Extra = serde_json::from_str(text).map_err(|e| format!("`truth`: {e}"))?;
    Ok(Labelled { scene, truth: extra.truth.unwrap_or_default() })
}

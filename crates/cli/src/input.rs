//! Input files and scenes named on the command line.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use teeter_game::{Record, RecordError};
use teeter_scene::{MAX_BYTES, Scene, SceneError, Settlement, named, read_text, settle};
use teeter_study::{InputsError, Timeline, read_inputs};

use crate::error::{Error, InputError};

/// Maximum size of a record, bytes.
const MAX_RECORD: u64 = 64_000_000;

/// Opened file or standard input.
pub struct Source {
    /// Name for messages.
    pub name: String,
    /// Bytes.
    pub reader: Box<dyn Read>,
}

/// Opens a file, or standard input for `-`. Refuses a file of more than `limit` bytes without
/// reading it.
pub fn open(path: &Path, limit: u64) -> Result<Source, Error> {
    if path == Path::new("-") {
        return Ok(Source { name: "standard input".into(), reader: Box::new(io::stdin().lock()) });
    }
    let name = path.display().to_string();
    let file = open_file(path, limit).map_err(|source| Error::input(&name, source))?;
    Ok(Source { name, reader: Box::new(file) })
}

/// Reads a text file of at most `limit` bytes, or standard input for `-`: UTF-8 or UTF-16,
/// compressed by gzip or not. Returns its name for messages besides.
pub fn text(path: &Path, limit: u64) -> Result<(String, String), Error> {
    let source = open(path, limit)?;
    match read_text(source.reader, limit) {
        Ok(text) => Ok((text, source.name)),
        // The messages of scenes call the file a scene.
        Err(SceneError::TooLarge { .. }) => Err(Error::input(&source.name, InputError::TooLarge(limit))),
        Err(SceneError::NotUtf8(byte)) => Err(Error::input(&source.name, InputError::NotText(byte))),
        Err(error) => Err(Error::input(&source.name, error)),
    }
}

fn open_file(path: &Path, limit: u64) -> Result<File, InputError> {
    let file = File::open(path).map_err(|error| match error.kind() {
        io::ErrorKind::NotFound => InputError::Missing,
        io::ErrorKind::PermissionDenied => InputError::Denied,
        _ => InputError::Io(error),
    })?;
    let metadata = file.metadata()?;
    if metadata.is_dir() {
        return Err(InputError::Folder);
    }
    if metadata.len() > limit {
        return Err(InputError::TooLarge(limit));
    }
    Ok(file)
}

/// Reads the scene in a file, on standard input, or of that name in the list. A file has priority
/// over a name.
pub fn scene(path: &Path) -> Result<Scene, Error> {
    let (scene, name) = unchecked_scene(path)?;
    scene.validate().map_err(|error| Error::input(&name, error))?;
    Ok(scene)
}

/// Reads a scene as [`scene`] does, and pushes its blocks apart where they overlap.
pub fn settled_scene(path: &Path) -> Result<(Scene, Settlement), Error> {
    let (mut scene, name) = unchecked_scene(path)?;
    let settlement = settle(&mut scene).map_err(|source| Error::Settle { name, source })?;
    Ok((scene, settlement))
}

/// Reads the inputs in a file, or on standard input for `-`, to the blocks of `scene`.
pub fn inputs(path: &Path, scene: &Scene) -> Result<Timeline, Error> {
    let (text, name) = text(path, MAX_BYTES)?;
    read_inputs(&text, scene).map_err(|error| match error {
        InputsError::Line { line, source } => Error::Inputs { name, line, source },
        InputsError::Empty => Error::NoInputs { name },
    })
}

/// Scene, or record of a game with its name for messages.
pub enum Subject {
    /// A scene.
    Scene(Scene),
    /// A record.
    Record(Box<Record>, String),
}

/// Reads the record of a game, or a scene as [`scene`] does.
pub fn record_or_scene(path: &Path) -> Result<Subject, Error> {
    if listed_name(path).is_some() {
        return scene(path).map(Subject::Scene);
    }
    let (bytes, name) = bytes(path, MAX_RECORD)?;
    match Record::decode(&bytes) {
        Ok(record) => Ok(Subject::Record(Box::new(record), name)),
        Err(RecordError::Foreign) => {
            let scene = read_text(&bytes[..], MAX_BYTES).and_then(|text| Scene::parse(&text));
            let scene = scene.and_then(|scene| scene.validate().map(|()| scene));
            scene.map(Subject::Scene).map_err(|error| Error::input(&name, error))
        }
        Err(source) => Err(Error::Record { name, source }),
    }
}

/// Reads the record of a game, and returns its name for messages besides.
pub fn record(path: &Path) -> Result<(Record, String), Error> {
    let (bytes, name) = bytes(path, MAX_RECORD)?;
    match Record::decode(&bytes) {
        Ok(record) => Ok((record, name)),
        Err(source) => Err(Error::Record { name, source }),
    }
}

/// Reads a file of at most `limit` bytes, or standard input for `-`. Returns its name for messages
/// besides.
fn bytes(path: &Path, limit: u64) -> Result<(Vec<u8>, String), Error> {
    let Source { name, reader } = open(path, limit)?;
    let mut bytes = Vec::new();
    reader.take(limit + 1).read_to_end(&mut bytes).map_err(|error| Error::input(&name, error))?;
    if bytes.len() as u64 > limit {
        return Err(Error::input(&name, InputError::TooLarge(limit)));
    }
    Ok((bytes, name))
}

/// Name that a path can only be of a scene of the list: no such file is there.
fn listed_name(path: &Path) -> Option<&str> {
    let is_name = |name: &&str| *name != "-" && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '-');
    path.to_str().filter(is_name).filter(|_| !path.exists())
}

/// Reads a scene that is not validated, and returns its name for messages besides.
fn unchecked_scene(path: &Path) -> Result<(Scene, String), Error> {
    if let Some(name) = listed_name(path) {
        return Ok((named_scene(name)?, name.to_owned()));
    }
    let source = open(path, MAX_BYTES)?;
    let scene = read_text(source.reader, MAX_BYTES).and_then(|text| Scene::parse(&text));
    Ok((scene.map_err(|error| Error::input(&source.name, error))?, source.name))
}

/// Returns the scene of that name in the list.
pub fn named_scene(name: &str) -> Result<Scene, Error> {
    named(name).ok_or_else(|| Error::UnknownScene { name: name.to_owned() })
}

//! Input files and scenes named on the command line.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use teeter_scene::{MAX_BYTES, Scene, SceneError, named};

use crate::error::{Error, InputError};

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
        return Err(SceneError::TooLarge { limit_mb: limit / 1_000_000 }.into());
    }
    Ok(file)
}

/// Reads the scene in a file, on standard input, or of that name in the list. A file has priority
/// over a name.
pub fn scene(path: &Path) -> Result<Scene, Error> {
    if let Some(name) = path.to_str()
        && name != "-"
        && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '-')
        && !path.exists()
    {
        return named_scene(name);
    }
    let source = open(path, MAX_BYTES)?;
    Scene::read(source.reader, MAX_BYTES).map_err(|error| Error::input(&source.name, error))
}

/// Returns the scene of that name in the list.
pub fn named_scene(name: &str) -> Result<Scene, Error> {
    named(name).ok_or_else(|| Error::UnknownScene { name: name.to_owned() })
}

//! Files that the user names, read with care: they may be missing, of any size, and anything.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use teeter_scene::{MAX_BYTES, NAMED, Scene, SceneError, named};

use crate::fault::Fault;

/// A file or standard input, opened, and what to call it.
pub struct Source {
    /// Its name for messages.
    pub name: String,
    /// Its bytes.
    pub reader: Box<dyn Read>,
}

/// Opens a file, or standard input for `-`. A file of more than `limit` bytes is refused before any is read.
pub fn open(path: &Path, limit: u64) -> Result<Source, Fault> {
    if path == Path::new("-") {
        return Ok(Source { name: "standard input".into(), reader: Box::new(io::stdin().lock()) });
    }
    let name = path.display().to_string();
    let file = File::open(path).map_err(|e| match e.kind() {
        io::ErrorKind::NotFound => Fault::at(&name, "there is no such file"),
        io::ErrorKind::PermissionDenied => Fault::at(&name, "this file may not be read"),
        _ => Fault::at(&name, e),
    })?;
    let about = file.metadata().map_err(|e| Fault::at(&name, e))?;
    if about.is_dir() {
        return Err(Fault::at(&name, "this is a folder, expected a file"));
    }
    if about.len() > limit {
        return Err(Fault::at(&name, SceneError::TooLarge { limit_mb: limit / 1_000_000 }));
    }
    Ok(Source { name, reader: Box::new(file) })
}

/// The scene in a file, on standard input, or of that name in the list; a file goes before a name.
pub fn scene(path: &Path) -> Result<Scene, Fault> {
    if let Some(name) = path.to_str()
        && name != "-"
        && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '-')
        && !path.exists()
    {
        return known(name);
    }
    let source = open(path, MAX_BYTES)?;
    Scene::read(source.reader, MAX_BYTES).map_err(|e| Fault::at(&source.name, e))
}

/// The scene of that name in the list.
pub fn known(name: &str) -> Result<Scene, Fault> {
    named(name).ok_or_else(|| {
        let names: Vec<&str> = NAMED.iter().map(|n| n.name).collect();
        Fault::Said(format!("there is no scene `{name}`, neither a file nor one of {}", names.join(", ")))
    })
}

//! Files of golden data.

use std::path::Path;

use crate::error::GoldenError;

/// Reads a file of a folder.
pub fn read(dir: &Path, name: &str) -> Result<String, GoldenError> {
    let path = dir.join(name);
    std::fs::read_to_string(&path).map_err(|e| GoldenError::file(path.display(), e))
}

/// Writes a file of a folder.
pub fn write(dir: &Path, name: &str, text: &str) -> Result<(), GoldenError> {
    let path = dir.join(name);
    std::fs::write(&path, text).map_err(|e| GoldenError::file(path.display(), e))
}

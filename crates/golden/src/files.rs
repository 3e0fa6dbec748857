//! Files of golden data.

use std::path::Path;

use crate::error::GoldenError;

/// Reads a file of a folder.
pub fn read(dir: &Path, name: &str) -> Result<String, GoldenError> {
    let path = dir.join(name);
    std::fs::read_to_string(&path).map_err(|e| GoldenError::file(path.display(), e))
}

/// Writes a file of a folder, as text.
pub fn write(dir: &Path, name: &str, text: &str) -> Result<(), GoldenError> {
    write_bytes(dir, name, text.as_bytes())
}

/// Writes a file of a folder.
pub fn write_bytes(dir: &Path, name: &str, bytes: &[u8]) -> Result<(), GoldenError> {
    let path = dir.join(name);
    std::fs::write(&path, bytes).map_err(|e| GoldenError::file(path.display(), e))
}
